# SPDX-License-Identifier: Apache-2.0
"""Text from outside for terminals and tables: names, messages and problems can contain any characters."""

from __future__ import annotations

__all__ = ["LONGEST_LINE", "LONGEST_NAME", "csv_cell", "one_line", "printable", "shown"]

LONGEST_NAME = 60
LONGEST_LINE = 2000
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def printable(text: str) -> str:
    r"""Return a text without control characters and marks that change its direction; line ends and tabs stay.

    Example:
        >>> printable("arm\x1b[2J")
        'arm\ufffd[2J'
    """
    return "".join(c if c.isprintable() or c in "\n\t" else "\N{REPLACEMENT CHARACTER}" for c in text)


def one_line(text: str) -> str:
    r"""Return a sentence with names from outside as one printable line; the end of a very long one is left out.

    Without its middle, a shell command could end a quotation and run what a name contains; a first part cannot.

    Example:
        >>> one_line("no frame 'two\nlines'")
        "no frame 'two\\nlines'"
    """
    short = text if len(text) <= LONGEST_LINE else f"{text[: LONGEST_LINE - 1]}\N{HORIZONTAL ELLIPSIS}"
    return printable(short.replace("\n", r"\n").replace("\t", r"\t"))


def shown(name: str) -> str:
    r"""Return a name for a drawing or a table: printable and not too long, for any name that was received.

    Example:
        >>> shown("base_link"), shown("two\nlines"), len(shown("x" * 10_000))
        ('base_link', 'two\\nlines', 60)
    """
    # A long name is shortened first, so that the rest of it costs nothing.
    short = _shortened(name, LONGEST_NAME)
    return _shortened("".join(c if c.isprintable() else repr(c)[1:-1] for c in short), LONGEST_NAME)


def _shortened(text: str, longest: int) -> str:
    half = longest // 2
    return text if len(text) <= longest else f"{text[: half - 1]}\N{HORIZONTAL ELLIPSIS}{text[-half:]}"


def csv_cell(value: object) -> object:
    """Return the value of a cell that a spreadsheet does not take for a formula; numbers stay as they are.

    Example:
        >>> csv_cell("=1+1"), csv_cell(-1.5)
        ("'=1+1", -1.5)
    """
    return f"'{value}" if isinstance(value, str) and value.startswith(_FORMULA) else value
