# SPDX-License-Identifier: Apache-2.0
"""Diagnostics as a table next to the scene: the newest status of each component."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypedDict

from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import NO_NUMBERS, Drawing, Options, drawing_of_shapes
from coframe.viewer.displays._renderers import NewMessages
from coframe.viewer.displays._row import ChoiceOption, DisplayRow, NumberOption

if TYPE_CHECKING:
    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["DIAGNOSTIC_ARRAY", "DiagnosticItem", "DiagnosticsShape"]

MAX_EARLIER_ARRAYS = 100
MAX_COMPONENTS = 1000
MAX_VALUES = 100
MAX_TEXT_LENGTH = 300


class DiagnosticItem(TypedDict):
    """The status of a component: 0 is ok, 1 a warning, 2 an error, 3 stale; and its values as pairs of texts."""

    level: int
    name: str
    message: str
    hardware: str
    stamp: float
    values: list[list[str]]


class DiagnosticsShape(TypedDict):
    """The newest status of each component."""

    kind: Literal["diagnostics"]
    frame: str
    stamp: float
    items: list[DiagnosticItem]


class DiagnosticsRenderer:
    """Maintains the newest status of each component, because a message contains only some of them."""

    def __init__(self, messages: TopicMessages, options: Options, _resources: Resources) -> None:
        self._new_messages = NewMessages(messages, MAX_EARLIER_ARRAYS)
        self._options = options
        self._items: dict[str, DiagnosticItem] = {}

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the table."""
        del time, at
        continues, new = self._new_messages.until(message)
        if not continues:
            self._items.clear()
        for one in new:
            array = one.read()
            stamp = float(stamp_ns(array.header.stamp) - self._options.origin)
            for status in array.status:
                if status.name in self._items or len(self._items) < MAX_COMPONENTS:
                    self._items[status.name] = _item(status, stamp)
        newest = message.read()
        rows = sorted(self._items.values(), key=lambda item: (-item["level"], item["name"]))
        stamp = float(stamp_ns(newest.header.stamp) - self._options.origin)
        description = DiagnosticsShape(kind="diagnostics", frame=newest.header.frame_id, stamp=stamp, items=rows)
        drawing = drawing_of_shapes(newest, description, NO_NUMBERS)
        drawing.placed = False
        return [drawing]

    def has_changed(self, time: int, at: int) -> bool:
        """Return False."""
        del time, at
        return False


def _item(status: Any, stamp: float) -> DiagnosticItem:
    level = status.level
    return DiagnosticItem(
        level=int(level[0] if isinstance(level, bytes | bytearray) else level),
        name=status.name[:MAX_TEXT_LENGTH],
        message=status.message[:MAX_TEXT_LENGTH],
        hardware=status.hardware_id[:MAX_TEXT_LENGTH],
        stamp=stamp,
        values=[[one.key[:MAX_TEXT_LENGTH], one.value[:MAX_TEXT_LENGTH]] for one in status.values[:MAX_VALUES]],
    )


DIAGNOSTIC_ARRAY = DisplayRow(
    name="DiagnosticArray",
    messages={"diagnostic_msgs/msg/DiagnosticArray": DiagnosticsRenderer},
    options=(
        NumberOption("Width", 360.0, 120.0, 1600.0, 20.0, "px"),
        ChoiceOption("Show", "All", ("All", "Warnings and errors", "Errors")),
    ),
    shapes=(DiagnosticsShape,),
    automatic=False,
    has_surfaces=False,
    guide="DiagnosticArray as a table in a corner: the newest status of each component, errors first, with its values",
)
