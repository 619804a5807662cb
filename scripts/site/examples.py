# SPDX-License-Identifier: Apache-2.0
"""The gallery: a picture of each example, from the table of examples/README.md, and the source of each program."""

from __future__ import annotations

import re
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]
_FOLDER = _ROOT / "examples"
ANCHORS = {file.name: file.stem.lower().replace("_", "-") for file in sorted(_FOLDER.glob("*.py"))}
_ROW = re.compile(r"^\| \[(?P<name>[^\]]+)\]\([^)]+\) \| (?P<text>.+) \|$", re.MULTILINE)


def pages() -> dict[str, str]:
    """Return the page, by its path."""
    text = (_FOLDER / "README.md").read_text("utf-8")
    rows = list(_ROW.finditer(text))
    cards = "".join(_card(row["name"], row["text"]) for row in rows)
    table = text[text.index("| file |") : rows[-1].end()]
    text = text.replace("# Examples", "# Gallery of examples", 1)
    text = text.replace(table, f'<div class="grid cards gallery" markdown>\n\n{cards}</div>')
    return {"examples.md": text + "".join(f"\n{_section(name)}\n" for name in ANCHORS)}


def picture(name: str) -> Path:
    """Return the picture of an example."""
    folder = _ROOT / "docs" / "images" / "gallery"
    return next(folder.glob(f"{Path(name).stem}.*"))


def _card(name: str, text: str) -> str:
    image = f"![{text}](images/gallery/{picture(name).name})"
    title = text[0].upper() + text[1:]
    if name not in ANCHORS:
        return f"- {image}\n\n    **{title}**: `{name}`\n\n"
    return f"- [{image}](#{ANCHORS[name]})\n\n    [{title}](#{ANCHORS[name]})\n\n"


def _section(name: str) -> str:
    source = (_FOLDER / name).read_text("utf-8").strip()
    return f"## {name} {{ #{ANCHORS[name]} }}\n\n```python\n{source}\n```"
