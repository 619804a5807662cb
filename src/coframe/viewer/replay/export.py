# SPDX-License-Identifier: Apache-2.0
"""Create replays without a browser: the contents of the page as one HTML file."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from coframe.time import SECOND
from coframe.viewer._page_files import STATIC
from coframe.viewer.displays import Options
from coframe.viewer.displays.rows import DISPLAYS, displayable
from coframe.viewer.replay.displays import ImmediateExecutor, ReplayDisplay
from coframe.viewer.replay.page import (
    FRAME_TIMEOUT,
    MAX_POSES,
    ReplayContent,
    ReplayRequest,
    ReplaySettings,
    replay_page,
)
from coframe.viewer.robots.descriptions import ROBOT_DESCRIPTION, RobotDescriptions
from coframe.viewer.scene.scene import Scene

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from coframe.robots import Robot
    from coframe.viewer.protocol.client_messages import ReplayRviz
    from coframe.viewer.protocol.common import RvizDisplay
    from coframe.viewer.protocol.server_messages import DisplayTopic
    from coframe.viewer.replay.displays import Progress
    from coframe.viewer.robots.meshes import MeshTable
    from coframe.viewer.rviz.config import RvizConfig
    from coframe.viewer.scripting.nodes import NodeRecord
    from coframe.viewer.sources.source import ViewerSource
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["export_replay"]

_DEFAULT_RATE, _LOWEST_RATE = 30.0, 1.0
_FIRST_MESSAGE_TIMEOUT = 2.0  # seconds


def export_replay(
    source: ViewerSource,
    meshes: MeshTable,
    *,
    rviz: RvizConfig | None = None,
    robot: Robot | None = None,
    fixed: str = "",
    nodes: Callable[[], Sequence[NodeRecord]] = tuple,
    first: int | None = None,
    last: int | None = None,
    rate: float | None = None,
    progress: Progress | None = None,
) -> bytes:
    """Return the HTML file of a replay of a recording, or of the current contents of a buffer or a connection.

    Args:
        source: The recording, the buffer or the connection.
        meshes: The meshes that may be included.
        rviz: The displays and the view, or None for the page's own choice.
        robot: A robot that is shown in addition to recorded ones.
        fixed: The fixed frame, or "" for the one in `rviz` or the root of the largest tree.
        nodes: Return the scene nodes of a program.
        first: The first time in nanoseconds, or None for the start of the source.
        last: The last time in nanoseconds, or None for the end of the source.
        rate: Frames per second, or None for 30, or fewer if a long span has too many poses.
        progress: Called with a task, the completed amount and the total.

    Raises:
        ViewerError: The span is empty or too large.
    """
    displays = _displays(rviz, displayable(source.topics()))
    topics = [ROBOT_DESCRIPTION, *(rviz.description_topics if rviz is not None else [])]
    descriptions = RobotDescriptions(robot, dict.fromkeys(topics), meshes)
    descriptions.refresh(source, ImmediateExecutor())
    enabled = _enabled_displays(displays, 0)
    topics_shown = dict.fromkeys(topic for display in enabled for topic in display.topics)
    opened = {topic: messages for topic in topics_shown if (messages := source.open(topic)) is not None}
    try:
        if source.connection is not None:
            _await_messages([opened[display.topic] for display in enabled if display.topic in opened])
        for _ in ("read", "store"):
            descriptions.refresh(source, ImmediateExecutor())
        scene = Scene(source.buffer, ages=False)
        scene.refresh()
        now = time.time_ns()
        span = source.span or scene.span or (now, now)  # static frames are the same at all times
        first, last = max(span[0], first or span[0]), min(span[1], last or span[1])
        frames = max(len(scene.structure.names), 1)
        rate = rate or _choose_rate(frames, (last - first) / SECOND)
        shown = _enabled_displays(displays, last)
        look: ReplayRviz = {
            "displays": displays,
            "global": {},
            "view": None if rviz is None else rviz.description()["view"],
        }
        content = ReplayContent(source.buffer, opened, list(descriptions.known.values()), meshes, nodes())
        fixed = fixed or (rviz.fixed_frame if rviz is not None else "") or scene.structure.largest
        settings = ReplaySettings(tuple(shown), look)
        request = ReplayRequest(first, last, rate, fixed, FRAME_TIMEOUT, source.title, last, settings)
        return replay_page(STATIC, content, request, progress)
    finally:
        descriptions.close()
        for messages in opened.values():
            messages.close()


def _choose_rate(frames: int, seconds: float) -> float:
    most = MAX_POSES / (frames * max(seconds, 1.0 / SECOND) + frames)
    return max(min(_DEFAULT_RATE, most), _LOWEST_RATE)


def _await_messages(subscriptions: Collection[TopicMessages]) -> None:
    """Wait until each topic of a live graph has a message, but not longer than the timeout."""
    deadline = time.monotonic() + _FIRST_MESSAGE_TIMEOUT
    while time.monotonic() < deadline and any(messages.at(0) is None for messages in subscriptions):
        time.sleep(0.02)


def _displays(rviz: RvizConfig | None, topics: Sequence[DisplayTopic]) -> list[RvizDisplay]:
    """Return the displays of a configuration, or those that the page would choose."""
    if rviz is not None:
        return rviz.description()["displays"]
    chosen = [topic for topic in topics if topic["automatic"]]
    return [
        *(_display(name, name, None) for name in ("Grid", "TF")),
        *(_display(topic["display"], topic["topic"], topic["topic"]) for topic in chosen),
    ]


def _display(kind: str, name: str, topic: str | None) -> RvizDisplay:
    return {"class": kind, "name": name, "enabled": True, "topic": topic, "options": {}}


def _shows_topic(display: RvizDisplay) -> bool:
    return bool(display["enabled"] and display["topic"] and DISPLAYS[display["class"]].messages)


def _enabled_displays(displays: Sequence[RvizDisplay], origin: int) -> list[ReplayDisplay]:
    """Return the topics of enabled displays, with the options with which the page would subscribe to them."""
    return [
        ReplayDisplay(
            display["topic"] or "",
            Options.from_message(DISPLAYS[display["class"]].server_options(display["options"]), origin),
        )
        for display in displays
        if _shows_topic(display)
    ]
