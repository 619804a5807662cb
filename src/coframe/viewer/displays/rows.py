# SPDX-License-Identifier: Apache-2.0
"""All displays: the rows of the modules in `coframe.viewer.displays.kinds`, which are found automatically."""

from __future__ import annotations

import importlib
import pkgutil
from functools import partial
from typing import TYPE_CHECKING

from coframe.viewer.displays import kinds
from coframe.viewer.displays._drawing import CannotDrawError
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import DisplayRow
from coframe.viewer.protocol.server_messages import DisplayTopic

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from coframe.viewer.displays._drawing import Drawing, Options
    from coframe.viewer.displays._renderers import MeshUrl, Renderer
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["DISPLAYS", "DISPLAY_OF_TYPE", "MAX_AUTOMATIC_DISPLAYS", "displayable", "make_renderer"]

MAX_AUTOMATIC_DISPLAYS = 12
"""How many topics are displayed if neither the user nor a file chooses the displays."""


def _rows() -> Iterator[DisplayRow]:
    for module in pkgutil.iter_modules(kinds.__path__):
        content = vars(importlib.import_module(f"{kinds.__name__}.{module.name}"))
        yield from (value for value in content.values() if isinstance(value, DisplayRow))


DISPLAYS: dict[str, DisplayRow] = {row.name: row for row in sorted(_rows(), key=lambda row: row.name)}
"""Each display by its class in RViz."""

DISPLAY_OF_TYPE: dict[str, DisplayRow] = {
    ros_type: row for row in DISPLAYS.values() if row.selectable for ros_type in row.messages
}
"""The display of each message type."""


def displayable(topics: Iterable[tuple[str, str]]) -> list[DisplayTopic]:
    """Return the topics of a source that can be displayed, with their types."""
    return [
        DisplayTopic(topic=topic, type=ros_type, display=DISPLAY_OF_TYPE[ros_type].name)
        for topic, ros_type in topics
        if ros_type in DISPLAY_OF_TYPE
    ]


def make_renderer(messages: TopicMessages, options: Options, mesh_url: MeshUrl) -> Renderer:
    """Return what draws the messages on a topic; drawing messages of other types raises CannotDrawError."""
    row = DISPLAY_OF_TYPE.get(messages.type)
    draw = (
        draw_each_message(partial(_raise_unknown_type, messages.type)) if row is None else row.messages[messages.type]
    )
    return draw(messages, options, mesh_url)


def _raise_unknown_type(ros_type: str, _message: object, _options: Options) -> Drawing:
    raise CannotDrawError(f"the viewer has no display for {ros_type}")
