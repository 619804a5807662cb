# SPDX-License-Identifier: Apache-2.0
"""The documents with examples, and their code blocks."""

import re
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "benchmarks" / "README.md"]
DOCUMENTS += sorted((ROOT / "docs").rglob("*.md")) + sorted((ROOT / "src/coframe/doctor/code_pages").glob("*.md"))
# A block may be in a list or a tab. A comment above a block says why it is not run.
BLOCK = re.compile(
    r"(?:^[ \t]*<!-- not run: (?P<reason>[^\n]+?) -->\n)?"
    r"^(?P<indent>[ \t]*)```(?P<language>\w*)[^\n]*\n(?P<text>.*?)^(?P=indent)```[ \t]*$",
    re.MULTILINE | re.DOTALL,
)


class Block(NamedTuple):
    """A code block of a document, without its indentation; `reason` says why it is not run, and is "" if it is."""

    language: str
    text: str
    reason: str


def blocks(document, languages):
    """Return the blocks of some languages that are run or checked."""
    return [block for block in all_blocks(document) if block.language in languages and not block.reason]


def all_blocks(document):
    for match in BLOCK.finditer(document.read_text(encoding="utf-8")):
        text = re.sub(rf"^{match['indent']}", "", match["text"], flags=re.MULTILINE)
        yield Block(match["language"], text, match["reason"] or "")


def name_of(document):
    return str(document.relative_to(ROOT))
