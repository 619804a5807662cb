# SPDX-License-Identifier: Apache-2.0
"""Escape untrusted text for terminals and tables: names, messages and problems can contain any characters."""

from __future__ import annotations

__all__ = ["MAX_LINE_LENGTH", "MAX_NAME_LENGTH", "csv_cell", "display_name", "one_line", "printable"]

MAX_NAME_LENGTH = 60
MAX_LINE_LENGTH = 2000
_FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")


def printable(text: str) -> str:
    r"""Return text without control characters and bidirectional marks. Newlines and tabs are kept.

    Example:
        >>> printable("arm\x1b[2J")
        'arm\ufffd[2J'
    """
    return "".join(c if c.isprintable() or c in "\n\t" else "\N{REPLACEMENT CHARACTER}" for c in text)


def one_line(text: str) -> str:
    r"""Return a message that contains untrusted names as one printable line, truncated if it is very long.

    The end is cut, not the middle: without its middle, a suggested shell command could close a quotation and run what a
    name contains.

    Example:
        >>> one_line("no frame 'two\nlines'")
        "no frame 'two\\nlines'"
    """
    short = text if len(text) <= MAX_LINE_LENGTH else f"{text[: MAX_LINE_LENGTH - 1]}\N{HORIZONTAL ELLIPSIS}"
    return printable(short.replace("\n", r"\n").replace("\t", r"\t"))


def display_name(name: str) -> str:
    r"""Return a received name for a drawing or a table: printable and shortened.

    Example:
        >>> display_name("base_link"), display_name("two\nlines"), len(display_name("x" * 10_000))
        ('base_link', 'two\\nlines', 60)
    """
    # A long name is shortened first, so that the rest of it costs nothing.
    short = _truncate_middle(name, MAX_NAME_LENGTH)
    return _truncate_middle("".join(c if c.isprintable() else repr(c)[1:-1] for c in short), MAX_NAME_LENGTH)


def _truncate_middle(text: str, max_length: int) -> str:
    half = max_length // 2
    return text if len(text) <= max_length else f"{text[: half - 1]}\N{HORIZONTAL ELLIPSIS}{text[-half:]}"


def csv_cell(value: object) -> object:
    """Return a cell value that a spreadsheet does not interpret as a formula. Numbers are unchanged.

    Example:
        >>> csv_cell("=1+1"), csv_cell(-1.5)
        ("'=1+1", -1.5)
    """
    return f"'{value}" if isinstance(value, str) and value.startswith(_FORMULA_STARTS) else value
