# SPDX-License-Identifier: Apache-2.0
"""The last messages of a topic as rows of a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.errors import CoframeError
from coframe.viewer.panels.message_fields import message_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.viewer.protocol.panel_messages import InspectedField
    from coframe.viewer.sources.topic_messages import StampedMessage

__all__ = ["TableMessage", "read_rows"]

_MAX_COLUMNS = 40


class TableMessage(NamedTuple):
    """A message as the row of a table.

    Attributes:
        key: The key of the message.
        time: The position on the timeline in nanoseconds.
        cells: The texts of the fields by their columns, each the path and the type of the field.
    """

    key: int
    time: int
    cells: dict[tuple[str, str], str]


def read_rows(messages: Sequence[StampedMessage]) -> list[TableMessage]:
    """Read messages. A message that cannot be read has one cell with the reason."""
    return [TableMessage(one.key, one.time, _cells(one)) for one in messages]


def _cells(message: StampedMessage) -> dict[tuple[str, str], str]:
    try:
        content: Any = message.read()
    except (CoframeError, ValueError) as error:
        return {("error", ""): str(error)}
    if isinstance(content, bytes):
        return {("data", ""): f"{len(content)} bytes"}
    return dict(_columns(message_rows("", content))[:_MAX_COLUMNS])


def _columns(fields: Sequence[InspectedField]) -> list[tuple[tuple[str, str], str]]:
    """Return the fields with a value of their own. A sequence is one column, and its elements have none."""
    found = []
    inside = None  # the depth of the sequence whose elements are skipped
    for field, following in zip(fields, [*fields[1:], None], strict=True):
        depth = field["depth"]
        if inside is not None and depth > inside:
            continue
        inside = None
        is_parent = following is not None and following["depth"] > depth
        if is_parent and field["text"]:
            inside = depth
        if field["path"] and (field["text"] or not is_parent):
            found.append(((field["path"].removeprefix("."), field["type"]), field["text"]))
    return found
