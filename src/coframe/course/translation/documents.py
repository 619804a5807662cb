# SPDX-License-Identifier: Apache-2.0
"""Translate documents paragraph by paragraph: Markdown, and the comments and docstrings of programs.

A unit is a heading, a paragraph, a list item or a table row, written in one line. The code of examples stays as it is.
"""

from __future__ import annotations

import re
import textwrap
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["is_prose", "translate_markdown", "translate_program"]

_WIDTH = 118  # columns of a program
_FENCE = re.compile(r"^```(?P<kind>\w*)\n.*?^```$|^<!--.*?-->$", re.MULTILINE | re.DOTALL)
_TRANSLATED_FENCES = {"console", "text"}
_LIST_ITEM = re.compile(r"\s*(?:[-*]|\d+\.) ")
_SINGLE_LINES = ("#", "|", "    ")  # headings, table rows, and lines of formulas
_NEW_UNIT = re.compile(r"#+ |\||[-*] |\d+\. | {4}")
_LITERAL = re.compile(r"`[^`]*`|\]\([^)]*\)|https?:\S+|@\w+@")
_WORD = re.compile(r"[A-Za-z]{3}")
_COMMENT = re.compile(
    r'"""(?P<docstring>.*?)"""|^(?P<indent> *)# (?P<lines>[^\n]*(?:\n(?P=indent)# [^\n]*)*)$'
    r"|<!-- (?P<xml>.*?) -->",
    re.MULTILINE | re.DOTALL,
)


def is_prose(unit: str) -> bool:
    """Return whether a unit contains words outside of code, addresses and placeholders."""
    return bool(_WORD.search(_LITERAL.sub("", unit)))


def translate_markdown(text: str, translate: Callable[[str], str]) -> str:
    """Return a Markdown document with each of its units translated."""
    parts, end = [], 0
    for fence in _FENCE.finditer(text):
        parts.append(_paragraphs(text[end : fence.start()], translate))
        block = fence[0]
        has_words = fence["kind"] in _TRANSLATED_FENCES and is_prose(block.strip("`"))
        parts.append(translate(block) if has_words else block)
        end = fence.end()
    return "".join([*parts, _paragraphs(text[end:], translate)])


def _paragraphs(text: str, translate: Callable[[str], str]) -> str:
    return "\n".join(translate(unit) if is_prose(unit) else unit for unit in _units(text))


def _units(text: str) -> Iterator[str]:
    """Yield the units of a text and its empty lines, each without a line end."""
    unit = ""
    for line in text.split("\n"):
        if unit and _continues(unit, line):
            unit = f"{unit} {line.strip()}"
            continue
        yield from [unit] if unit else []
        unit = line
        if not line.strip():
            yield line
            unit = ""
    yield from [unit] if unit else []


def _continues(unit: str, line: str) -> bool:
    """Return whether a line belongs to the unit before it."""
    if _LIST_ITEM.match(unit):
        return line.startswith("  ") and bool(line.strip()) and not _LIST_ITEM.match(line)
    return bool(line.strip()) and not _NEW_UNIT.match(line) and not unit.startswith(_SINGLE_LINES)


def translate_program(text: str, translate: Callable[[str], str]) -> str:
    """Return a program or a configuration with its docstrings and comments translated, and wrapped."""

    def replaced(match: re.Match[str]) -> str:
        if match["docstring"] is not None:
            content = match["docstring"]
            column = match.start() - text.rfind("\n", 0, match.start()) - 1
            lines = _paragraphs(content, translate)
            return f'"""{_wrapped(lines, first=column + 3)}"""'
        if match["xml"] is not None:
            content = " ".join(match["xml"].split())
            return textwrap.fill(f"<!-- {translate(content)} -->", _WIDTH, subsequent_indent=" " * 5)
        start = f"{match['indent']}# "
        content = " ".join(line.strip().removeprefix("# ") for line in match["lines"].split("\n"))
        return textwrap.fill(translate(content), _WIDTH, initial_indent=start, subsequent_indent=start)

    return _COMMENT.sub(replaced, text)


def _wrapped(text: str, first: int) -> str:
    """Return lines wrapped to the width of a program, except indented ones, which are tables and formulas."""
    lines = []
    for number, line in enumerate(text.split("\n")):
        if line.startswith("    ") or not line.strip():
            lines.append(line)
            continue
        start = " " * (first if number == 0 else 0)
        lines.append(textwrap.fill(line, _WIDTH, initial_indent=start)[len(start) :])
    return "\n".join(lines)
