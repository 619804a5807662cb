# SPDX-License-Identifier: Apache-2.0
"""The state that all clients share: the source with its scene, the topics, and the origin of times."""

from __future__ import annotations

import contextlib
import itertools
import logging
import secrets
import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from coframe.errors import ViewerError, WireError
from coframe.time import SECOND
from coframe.viewer._findings import FindingsWatcher
from coframe.viewer._uploads import Uploads
from coframe.viewer.displays.rows import displayable
from coframe.viewer.panels import Panels
from coframe.viewer.protocol.server_messages import RecentSource
from coframe.viewer.replay.page import DEFAULT_SETTINGS, FRAME_TIMEOUT, ReplayRequest, ReplaySettings
from coframe.viewer.robots.descriptions import ROBOT_DESCRIPTION, RobotDescriptions
from coframe.viewer.robots.joints import JOINT_STATES, JointPublisher
from coframe.viewer.robots.meshes import MeshTable
from coframe.viewer.scene.scene import Scene
from coframe.viewer.scripting.callbacks import CallbackThread
from coframe.viewer.scripting.nodes import NodeStore
from coframe.viewer.scripting.widgets import WidgetStore
from coframe.viewer.sources.requested_quality import AUTOMATIC, RequestedQuality
from coframe.viewer.sources.topic_messages import LiveMessages
from coframe.viewer.tools.publisher import ToolPublisher

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from coframe.robots import Robot
    from coframe.viewer.protocol.server_messages import DisplayTopic
    from coframe.viewer.rviz.config import RvizConfig
    from coframe.viewer.sources.source import ViewerSource
    from coframe.viewer.sources.topic_messages import TopicMessages
    from coframe.viewer.tools.control import GraphControl

__all__ = ["FRAME_TIMEOUT", "ViewerState"]

_logger = logging.getLogger("coframe.viewer")

# Seconds between refreshes of the tree structure and of the topics. Large trees are refreshed less often, so that
# refreshing takes at most the given share of the time.
STRUCTURE_PERIOD, TOPICS_PERIOD = 0.2, 1.0
STRUCTURE_SHARE = 0.005
# A topic is silent after this many of its periods without a message, and at least this many seconds.
SILENT_PERIODS, MIN_SILENCE = 10, 3.0
# A float64 is exact up to 2**53 nanoseconds, which is 104 days.
_MAX_OFFSET = 2**52
_MAX_PREPARED_REPLAYS = 8
MAX_RECENT = 8
"""The number of sources that a page can show again."""


class ViewerState:
    """The state that all clients share; used by one thread, apart from the nodes and widgets.

    Args:
        source: The source of transforms and messages.
        fixed: The requested fixed frame; "" selects the root of the largest tree.
        rviz: The initial configuration of each client.
        robot: A robot that is shown in addition to published ones.
        meshes: The meshes that may be fetched, or None for none.
        joint_states: The topic on which positions of joints are published.
        can_open: Whether the pages may open files, which then replace the source.
    """

    def __init__(
        self,
        source: ViewerSource,
        *,
        fixed: str = "",
        rviz: RvizConfig | None = None,
        robot: Robot | None = None,
        meshes: MeshTable | None = None,
        joint_states: str = JOINT_STATES,
        can_open: bool = False,
    ) -> None:
        self.edition = 0  # Increases when the source or its title changes, and when everything starts again.
        self.restart_reason = ""  # Why everything started again last.
        self.restarts = 0
        self.source = source
        self.meshes = MeshTable(lambda _name: None) if meshes is None else meshes
        self.descriptions = RobotDescriptions(robot, _description_topics(rviz), self.meshes)
        self.scene = _scene_of(source)
        self.findings = FindingsWatcher()
        self.panels = Panels(source)
        self.callbacks = CallbackThread()
        self.can_open = can_open
        self.control: GraphControl | None = None
        self.uploads = Uploads()
        self._recent_sources: dict[int, ViewerSource] = {}
        self._recent_ids = itertools.count(1)
        self._opened_sources: set[ViewerSource] = set()
        self.nodes, self.widgets = NodeStore(self.callbacks), WidgetStore(self.callbacks)
        self.rviz = rviz.with_fixed_frame(fixed) if rviz is not None and fixed else rviz
        self._joint_states = joint_states
        self.fixed = fixed or (rviz.fixed_frame if rviz is not None else "")
        self.fixed_is_given = bool(self.fixed)
        self.saved_rviz: str | None = None
        self.topics: list[DisplayTopic] = []
        self.origin = time.time_ns()
        self.executor = ThreadPoolExecutor(2, "coframe-viewer-work")
        self._tools: ToolPublisher | None = None
        # Of the source, by topic and requested quality of service.
        self._open_topics: dict[tuple[str, RequestedQuality], _SharedMessages] = {}
        self._users: dict[int, _SharedMessages] = {}  # Also of previous sources, by the identity of their messages.
        self._prepared_replays: dict[str, ReplaySettings] = {}
        self._structure_due = self._topics_due = 0.0
        self.refresh()

    def set_source(self, source: ViewerSource) -> None:
        """Show another source. All clients start from scratch."""
        self._remember(source)
        self._close_tools()
        self.panels.close()
        self.panels = Panels(source)
        self.source = source
        self._open_topics = {}  # Clients release the messages of the previous source when they start from scratch.
        self.descriptions.restart()
        self.scene = _scene_of(source)
        self.origin = time.time_ns()
        self._structure_due = self._topics_due = 0.0
        self.refresh()
        self.edition += 1

    def _remember(self, source: ViewerSource) -> None:
        """Keep a source, so that it can be shown again; close the oldest one that the page has opened."""
        if not self.can_open or source in self._recent_sources.values():
            return
        self._recent_sources[next(self._recent_ids)] = source
        for number, known in list(self._recent_sources.items())[: max(0, len(self._recent_sources) - MAX_RECENT)]:
            del self._recent_sources[number]
            if known in self._opened_sources:
                self._opened_sources.discard(known)
                known.close()

    def show_opened(self, source: ViewerSource) -> None:
        """Show a source that a page has opened. The viewer closes it."""
        self._opened_sources.add(source)
        self.set_source(source)

    def show_recent(self, number: int) -> None:
        """Show a source again.

        Raises:
            ViewerError: It is no longer open.
        """
        source = self._recent_sources.get(number)
        if source is None:
            raise ViewerError("this source is no longer open", hint="Open its file again.")
        if source is not self.source:
            self.set_source(source)

    def recent_sources(self) -> list[RecentSource]:
        """Return the sources that can be shown again, the newest first."""
        return [
            RecentSource(id=number, name=source.title, is_shown=source is self.source)
            for number, source in reversed(self._recent_sources.items())
        ]

    def restart(self, reason: str) -> None:
        """Start again without the data received so far, for example after time has jumped back.

        Args:
            reason: What the pages show.
        """
        _logger.info("%s; the viewer starts again", reason)
        self.source.restart()
        self.scene.restart()
        self.panels.restart()
        self._open_topics = {}
        self.restart_reason = reason
        self.restarts += 1
        self.edition += 1

    def set_title(self, title: str) -> None:
        """Change the title of the page."""
        self.source.title = title
        self.edition += 1

    def set_control(self, control: GraphControl) -> None:
        """Permit the pages to act on the graph. The viewer closes the control."""
        self.control = control
        self.edition += 1

    @property
    def can_publish(self) -> bool:
        """Whether the pages may publish."""
        return self.source.connection is not None

    def refresh(self) -> None:
        """Update from the source, rate-limited."""
        now = time.monotonic()
        if now >= self._structure_due:
            self.scene.refresh()
            spent = time.monotonic() - now
            self._structure_due = now + max(STRUCTURE_PERIOD, spent / STRUCTURE_SHARE)
            if reason := self.source.watch(self.scene.newest):
                self.restart(reason)
            self._choose_origin()
            self.descriptions.refresh(self.source, self.executor)
        if now >= self._topics_due:
            self._topics_due = now + TOPICS_PERIOD
            self.source.refresh()
            self.topics = displayable(self.source.topics())

    @property
    def span(self) -> tuple[int, int] | None:
        """The first and the last stamp in nanoseconds; None while there is no data."""
        return self.source.span or self.scene.span

    def silence(self) -> float | None:
        """Return how many seconds ago the last data arrived; None if nothing arrives regularly."""
        if self.source.mode != "live" or self.source.clock == "paused":
            return None
        now = time.monotonic_ns()
        silences = [] if (moving := self.scene.silence()) is None else [moving]
        for shared in self._users.values():
            messages = shared.messages
            if isinstance(messages, LiveMessages) and messages.period:
                silences.append((now - messages.received_at) / SECOND)
        return min(silences, default=None)

    def topic_silence(self, messages: TopicMessages) -> float | None:
        """Return for how many seconds a topic with regular messages has had none; None while they arrive."""
        if not isinstance(messages, LiveMessages) or not messages.period or self.source.clock == "paused":
            return None
        silence = (time.monotonic_ns() - messages.received_at) / SECOND
        return silence if silence > max(MIN_SILENCE, SILENT_PERIODS * messages.period / SECOND) else None

    def relative_span(self) -> tuple[int, int] | None:
        """Return the first and the last stamp relative to the origin."""
        span = self.span
        return None if span is None else (span[0] - self.origin, span[1] - self.origin)

    def open(self, topic: str, quality: RequestedQuality = AUTOMATIC) -> TopicMessages | None:
        """Return the messages on a topic, which all clients share, or None if the topic does not exist.

        Args:
            topic: The name of the topic.
            quality: The quality of service to request from publishers.

        Raises:
            ViewerError: The name of the topic is not valid.
            WireError: The middleware cannot create the subscription.
        """
        topic = self.source.resolve(topic)
        key = (topic, quality if self.source.mode == "live" else AUTOMATIC)
        shared = self._open_topics.get(key)
        if shared is None:
            messages = self.source.open(*key)
            if messages is None:
                return None
            shared = self._open_topics[key] = self._users[id(messages)] = _SharedMessages(messages)
        shared.users += 1
        return shared.messages

    def release(self, messages: TopicMessages) -> None:
        """Release what `open` returned."""
        shared = self._users[id(messages)]
        shared.users -= 1
        if shared.users == 0:
            del self._users[id(messages)]
            self._open_topics = {key: one for key, one in self._open_topics.items() if one is not shared}
            messages.close()

    @contextlib.contextmanager
    def opened(self, topics: Iterable[str]) -> Iterator[dict[str, TopicMessages]]:
        """Open the messages of those topics that exist, and release them at the end."""
        found: dict[str, TopicMessages] = {}
        try:
            for topic in dict.fromkeys(topics):
                # A topic that cannot be opened is missing in a replay; the others are recorded.
                with contextlib.suppress(ViewerError, WireError):
                    if (messages := self.open(topic)) is not None:
                        found[topic] = messages
            yield found
        finally:
            for messages in found.values():
                self.release(messages)

    def close(self) -> None:
        """Stop all work and release the resources of disconnected clients."""
        self.callbacks.close()
        for shared in self._users.values():
            shared.messages.close()
        self._users.clear()
        self.findings.close()
        self.panels.close()
        self.executor.shutdown(wait=True, cancel_futures=True)
        self._close_tools()
        self.descriptions.close()
        if self.control is not None:
            self.control.close()
        for source in self._opened_sources:
            source.close()
        self.uploads.close()

    def _close_tools(self) -> None:
        if self._tools is not None:
            self._tools.close()
            self._tools = None

    def joint_publisher(self, robot: Robot) -> JointPublisher:
        """Return a publisher of the positions of a robot's joints.

        Raises:
            ViewerError: The source is not the ROS graph.
            WireError: The middleware cannot create the publisher.
        """
        if self.source.connection is None:
            raise ViewerError(
                "joint states can only be published on a live ROS graph",
                hint="Start the viewer with `coframe view live`.",
            )
        return JointPublisher(self.source.connection, robot, self._joint_states)

    @property
    def static_topic(self) -> str:
        """The topic of static transforms."""
        return "" if self.source.connection is None else self.source.connection.config.tf_static_topic

    def tool_publisher(self) -> ToolPublisher:
        """Return the publisher for the pages' tools.

        Raises:
            ViewerError: The source is not the ROS graph.
        """
        connection = self.source.connection
        if connection is None:
            raise ViewerError("publishing requires a live ROS graph", hint="Start the viewer with `coframe view live`.")
        if self._tools is None:
            self._tools = ToolPublisher(connection)
        return self._tools

    def prepare_replay(self, settings: ReplaySettings) -> str:
        """Store the settings of a replay, and return the token with which it is requested."""
        token = secrets.token_urlsafe(12)
        self._prepared_replays[token] = settings
        while len(self._prepared_replays) > _MAX_PREPARED_REPLAYS:
            del self._prepared_replays[next(iter(self._prepared_replays))]
        return token

    def replay_request(self, query: Mapping[str, str]) -> ReplayRequest:
        """Return the request for a replay in a URL query; by default, everything is included.

        Raises:
            ViewerError: The query is invalid.
        """
        span = self.span
        if span is None:
            raise ViewerError("there are no moving frames to replay yet")
        try:
            first = round(float(query["from"])) + self.origin if "from" in query else span[0]
            last = round(float(query["to"])) + self.origin if "to" in query else span[1]
            rate = float(query.get("rate", 30.0))
        except (ValueError, OverflowError):
            raise ViewerError("from, to and rate of a replay must be numbers") from None
        settings = self._prepared_replays.get(query["settings"]) if "settings" in query else DEFAULT_SETTINGS
        if settings is None:
            raise ViewerError("the settings of this replay are no longer available", hint="Save the replay again.")
        fixed = query.get("fixed") or self.fixed or self.scene.structure.largest
        first, last = max(first, span[0]), min(last, span[1])
        return ReplayRequest(first, last, rate, fixed, FRAME_TIMEOUT, self.source.title, self.origin, settings)

    def _choose_origin(self) -> None:
        span = self.span
        if span is not None and abs(span[1] - self.origin) > _MAX_OFFSET:
            self.origin = span[1]


def _scene_of(source: ViewerSource) -> Scene:
    return Scene(source.buffer, ages=source.mode == "live", clock=source.running)


def _description_topics(rviz: RvizConfig | None) -> list[str]:
    """Return the default topic and the topics of a configuration."""
    named = [] if rviz is None else rviz.description_topics
    return list(dict.fromkeys([ROBOT_DESCRIPTION, *named]))


class _SharedMessages:
    """The messages on a topic, and the number of displays that use them."""

    def __init__(self, messages: TopicMessages) -> None:
        self.messages = messages
        self.users = 0
