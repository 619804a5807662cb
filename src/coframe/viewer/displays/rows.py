# SPDX-License-Identifier: Apache-2.0
"""All displays: the rows of the modules in `coframe.viewer.displays.kinds`, which are found automatically."""

from __future__ import annotations

import importlib
import pkgutil
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from coframe.viewer.displays import kinds
from coframe.viewer.displays._drawing import CannotDrawError
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import QUALITY_OPTIONS, DisplayRow
from coframe.viewer.protocol.server_messages import DisplayTopic

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from coframe.viewer.displays._drawing import Drawing, Options
    from coframe.viewer.displays._renderers import Renderer
    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.protocol.client_messages import DisplayOptions
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["DISPLAYS", "DISPLAY_OF_TYPE", "MAX_AUTOMATIC_DISPLAYS", "displayable", "make_renderer", "row_of"]

MAX_AUTOMATIC_DISPLAYS = 12
"""How many topics are displayed if neither the user nor a file chooses the displays."""


def _rows() -> Iterator[DisplayRow]:
    for module in pkgutil.iter_modules(kinds.__path__):
        content = vars(importlib.import_module(f"{kinds.__name__}.{module.name}"))
        for value in content.values():
            if isinstance(value, DisplayRow):
                has_quality = value.has_quality and value.messages
                yield replace(value, options=(*value.options, *QUALITY_OPTIONS)) if has_quality else value


DISPLAYS: dict[str, DisplayRow] = {row.name: row for row in sorted(_rows(), key=lambda row: row.name)}
"""Each display by its class in RViz."""

DISPLAY_OF_TYPE: dict[str, DisplayRow] = {
    ros_type: row for row in DISPLAYS.values() if row.selectable for ros_type in row.messages
}
"""The display of each message type."""


def displayable(topics: Iterable[tuple[str, str]]) -> list[DisplayTopic]:
    """Return the topics of a source with their types and displays, the most useful topics first.

    The page shows the first topic of each type automatically, then the second one of each type, and so on, up to the
    maximum of each display and of the page. Topics without a display come last.
    """
    of_row: dict[str, list[tuple[str, str]]] = {}
    for topic, ros_type in topics:
        row = DISPLAY_OF_TYPE.get(ros_type)
        of_row.setdefault("" if row is None else row.name, []).append((topic, ros_type))
    plain = of_row.pop("", [])
    places = [
        (place, DISPLAYS[name], topic, ros_type)
        for name, found in of_row.items()
        for place, (topic, ros_type) in enumerate(sorted(found, key=_simplicity_key))
    ]
    places.sort(key=lambda one: (one[0], one[1].rank, one[1].name, one[2]))
    chosen = [topic for place, row, topic, _ in places if row.automatic and place < row.max_automatic]
    shown = set(chosen[:MAX_AUTOMATIC_DISPLAYS])
    return [
        DisplayTopic(topic=topic, type=ros_type, display=row.name, automatic=topic in shown)
        for _, row, topic, ros_type in places
    ] + [DisplayTopic(topic=topic, type=ros_type, display="", automatic=False) for topic, ros_type in sorted(plain)]


def _simplicity_key(topic: tuple[str, str]) -> tuple[int, int, str]:
    """Return a sort key: /scan comes before /front/scan and /scan_filtered."""
    return topic[0].count("/"), len(topic[0]), topic[0]


def row_of(ros_type: str, options: DisplayOptions) -> DisplayRow | None:
    """Return the display that draws messages of a type with these options, or None if there is none."""
    chosen = DISPLAYS.get(options.display)
    return chosen if chosen is not None and ros_type in chosen.messages else DISPLAY_OF_TYPE.get(ros_type)


def make_renderer(messages: TopicMessages, options: Options, resources: Resources) -> Renderer:
    """Return what draws the messages on a topic; drawing messages of other types raises CannotDrawError."""
    row = row_of(messages.type, options)
    draw = (
        draw_each_message(partial(_raise_unknown_type, messages.type)) if row is None else row.messages[messages.type]
    )
    return draw(messages, options, resources)


def _raise_unknown_type(ros_type: str, _message: object, _options: Options) -> Drawing:
    raise CannotDrawError(f"the viewer has no display for {ros_type}")
