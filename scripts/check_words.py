# SPDX-License-Identifier: Apache-2.0
"""Report words in the project's texts and identifiers that banned_words.toml replaces by plain ones.

Example:
    python scripts/check_words.py              check all tracked files
    python scripts/check_words.py README.md    check these files only
"""

from __future__ import annotations

import fnmatch
import re
import sys
from pathlib import Path
from typing import NamedTuple

from tracked_files import chosen

ROOT = Path(__file__).resolve().parents[1]
WORD_LIST = ROOT / "scripts" / "banned_words.toml"
CHECKED = re.compile(r"\.(md|pyi?|cpp|hpp|inc|ts|css|html|toml|sh|cff|ya?ml)$")
SKIPPED = ("scripts/banned_words.toml", "src/coframe/viewer/static/*", "*/generated/*", "interfaces/*", "*.json")


class Word(NamedTuple):
    """An entry of the word list."""

    pattern: re.Pattern[str]
    use: str
    allow: tuple[str, ...]
    unless: re.Pattern[str] | None


def main() -> int:
    words = read_words()
    found = [line for path in chosen(sys.argv[1:]) if is_checked(path) for line in problems(path, words)]
    print(*found, sep="\n", end="\n" if found else "")
    if found:
        print(f"{len(found)} banned words; docs/glossary.md has the terms that coframe uses", file=sys.stderr)
    return 1 if found else 0


def read_words() -> list[Word]:
    """Read the word list.

    The file is read line by line because Python 3.10 has no TOML parser: each value stands on its own line.
    """
    words: list[Word] = []
    for block in WORD_LIST.read_text(encoding="utf-8").split("[[word]]")[1:]:
        entry = dict(re.findall(r"^(\w+) = (.+)$", block, re.MULTILINE))
        text = {name: re.findall(r'"((?:[^"\\]|\\.)*)"', value) for name, value in entry.items()}
        pattern = text["pattern"][0].replace("\\\\", "\\")
        unless = text["unless"][0].replace("\\\\", "\\") if "unless" in text else ""
        words.append(
            Word(
                # An underscore separates words as a blank does: identifiers are checked, too.
                re.compile(rf"(?<![a-z])(?:{pattern})(?![a-z])", re.IGNORECASE),
                text["use"][0],
                tuple(text.get("allow", ())),
                re.compile(unless) if unless else None,
            )
        )
    return words


def is_checked(path: str) -> bool:
    return bool(CHECKED.search(path)) and not any(fnmatch.fnmatch(path, pattern) for pattern in SKIPPED)


def problems(path: str, words: list[Word]) -> list[str]:
    """Return one line per banned word of a file."""
    found = []
    active = [word for word in words if not any(fnmatch.fnmatch(path, pattern) for pattern in word.allow)]
    for number, line in enumerate((ROOT / path).read_text("utf-8", errors="replace").splitlines(), 1):
        for word in active:
            match = word.pattern.search(line)
            if match and not (word.unless and word.unless.search(line)):
                found.append(f"{path}:{number}: {match[0]!r}: write {word.use}")
    return found


if __name__ == "__main__":
    sys.exit(main())
