# SPDX-License-Identifier: Apache-2.0
"""The last messages of a topic as rows of a table."""

from __future__ import annotations

import logging
from itertools import islice
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from coframe.errors import CoframeError
from coframe.viewer.panels.message_fields import value_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.viewer.sources.topic_messages import StampedMessage

__all__ = ["Column", "TableMessage", "read_rows"]

_logger = logging.getLogger("coframe.viewer")

Column: TypeAlias = "tuple[str, str]"
"""The path and the type of a field."""


class TableMessage(NamedTuple):
    """A message as the row of a table.

    Attributes:
        key: The key of the message.
        time: The position on the timeline in nanoseconds.
        cells: The texts of the fields by their columns.
        problem: Why the message cannot be read, or "".
    """

    key: int
    time: int
    cells: dict[Column, str]
    problem: str = ""


def read_rows(messages: Sequence[StampedMessage], max_cells: int) -> list[TableMessage]:
    """Read the first fields of messages, which may contain anything."""
    return [_read_row(one, max_cells) for one in messages]


def _read_row(message: StampedMessage, max_cells: int) -> TableMessage:
    row = TableMessage(message.key, message.time, {})
    try:
        return row._replace(cells=_cells(message.read(), max_cells))
    except (CoframeError, ValueError) as error:
        return row._replace(problem=f"the message cannot be read: {error}")
    except Exception as error:
        _logger.exception("a message could not be read for a table")
        return row._replace(problem=f"the message cannot be read: {type(error).__name__}: {error}")


def _cells(content: Any, max_cells: int) -> dict[Column, str]:
    if isinstance(content, bytes):
        return {("data", ""): f"{len(content)} bytes"}
    fields = islice(value_rows(content), max_cells)
    return {(field["path"].removeprefix("."), field["type"]): field["text"] for field in fields}
