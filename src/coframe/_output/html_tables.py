# SPDX-License-Identifier: Apache-2.0
"""Small HTML tables, as notebooks show values.

Names of frames, topics and nodes come from the network, so all text is escaped and shortened. The styles set no
colors: the tables are readable on light and on dark backgrounds.
"""

from __future__ import annotations

import base64
from itertools import islice
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import count

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

__all__ = ["MAX_ROWS", "image", "paragraph", "preformatted", "record", "section", "table"]

MAX_ROWS = 50
_MAX_TEXT_LENGTH = 1000  # characters per cell or paragraph
_BORDER = "1px solid rgba(128, 128, 128, 0.4)"
_CELL = "text-align: left; padding: 0.15em 0.8em; font-variant-numeric: tabular-nums"


def section(title: str, *parts: str) -> str:
    """Return HTML parts below a title.

    Args:
        title: The title as text.
        parts: HTML, as the other functions return it; empty parts are skipped.
    """
    heading = f'<div style="font-weight: bold; margin-bottom: 0.3em">{_escape(title)}</div>'
    return '<div style="color: inherit">' + heading + "".join(parts) + "</div>"


def table(titles: Sequence[str], rows: Iterable[Sequence[object]], total: int, noun: str = "row") -> str:
    """Return a table with at most `MAX_ROWS` rows, followed by the number of omitted rows.

    Args:
        titles: The titles of the columns.
        rows: The cells of each row; only the first rows are read.
        total: The number of all rows.
        noun: What a row represents, in the singular.

    Returns:
        HTML, or "" if there are no rows.
    """
    if total == 0:
        return ""
    head = "".join(f'<th style="{_CELL}; border-bottom: {_BORDER}">{_escape(title)}</th>' for title in titles)
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in islice(rows, MAX_ROWS))
    more = paragraph(_omitted_rows_text(total, noun)) if total > MAX_ROWS else ""
    return (
        '<table style="border-collapse: collapse; color: inherit; background: transparent">'
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"
    )


def _cell(value: object) -> str:
    return f'<td style="{_CELL}">{_escape(str(value))}</td>'


def paragraph(text: str) -> str:
    """Return text as a paragraph, or "" for an empty text."""
    return f'<div style="margin: 0.3em 0">{_escape(text)}</div>' if text else ""


def preformatted(lines: Sequence[str]) -> str:
    """Return at most `MAX_ROWS` lines in a fixed-width font, followed by the number of omitted lines."""
    shown = "\n".join(_escape(line) for line in lines[:MAX_ROWS])
    more = paragraph(_omitted_rows_text(len(lines), "line")) if len(lines) > MAX_ROWS else ""
    return f'<pre style="margin: 0; color: inherit; background: transparent">{shown}</pre>{more}'


def image(data: bytes, description: str) -> str:
    """Return a JPEG or PNG file as an image, with a description for screen readers."""
    kind = "png" if data.startswith(b"\x89PNG") else "jpeg"
    source = f"data:image/{kind};base64,{base64.b64encode(data).decode()}"
    return f'<img alt="{_escape(description)}" style="display: block; max-width: 100%" src="{source}">'


def record(title: str, fields: Iterable[tuple[str, object]]) -> str:
    """Return the fields of a report: a table of single values, followed by a table for each list that is not empty.

    Args:
        title: The title as text.
        fields: Names and values; the elements of lists are named tuples or single values.
    """
    pairs = list(fields)
    single = [(name, value) for name, value in pairs if not isinstance(value, list)]
    lists = [_list_table(name, value) for name, value in pairs if isinstance(value, list)]
    return section(title, table(("", ""), single, len(single)), *lists)


def _list_table(name: str, values: list[Any]) -> str:
    columns = getattr(values[0], "_fields", None) if values else None
    rows = values if columns else ((value,) for value in values)
    titles = (f"{name}: {columns[0]}", *columns[1:]) if columns else (name,)
    return table(titles, rows, len(values))


def _omitted_rows_text(total: int, noun: str) -> str:
    return "and " + count(total - MAX_ROWS, f"more {noun}")


def _escape(text: str) -> str:
    """Return text escaped for HTML and shortened, without control characters and bidirectional marks."""
    short = text if len(text) <= _MAX_TEXT_LENGTH else f"{text[:_MAX_TEXT_LENGTH]}..."
    import html  # noqa: PLC0415 - only notebooks need it

    return html.escape("".join(c if c.isprintable() else ascii(c)[1:-1] for c in short))
