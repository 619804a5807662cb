# SPDX-License-Identifier: Apache-2.0
"""Text from outside for terminals and tables: names, messages and problems can contain any characters."""

from __future__ import annotations

__all__ = ["csv_cell", "printable"]

_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def printable(text: str) -> str:
    r"""Return a text without control characters and marks that change its direction; line ends and tabs stay.

    Example:
        >>> printable("arm\x1b[2J")
        'arm\ufffd[2J'
    """
    return "".join(c if c.isprintable() or c in "\n\t" else "\N{REPLACEMENT CHARACTER}" for c in text)


def csv_cell(value: object) -> object:
    """Return the value of a cell that a spreadsheet does not take for a formula; numbers stay as they are.

    Example:
        >>> csv_cell("=1+1"), csv_cell(-1.5)
        ("'=1+1", -1.5)
    """
    return f"'{value}" if isinstance(value, str) and value.startswith(_FORMULA) else value
