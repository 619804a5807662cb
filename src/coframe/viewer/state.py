"""What all tabs share: the source with its scene, the topics, and the origin of times."""

from __future__ import annotations

import secrets
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING

from coframe.errors import ViewerError
from coframe.viewer.findings import Findings
from coframe.viewer.replay.page import NO_LOOKS, ReplayLooks, ReplayRequest
from coframe.viewer.robots.descriptions import ROBOT_DESCRIPTION, Descriptions
from coframe.viewer.robots.joints import JOINT_STATES, JointPublisher
from coframe.viewer.robots.meshes import MeshTable
from coframe.viewer.scene.scene import Scene

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from coframe.robots import Robot
    from coframe.viewer.rviz.config import RvizConfig
    from coframe.viewer.sources.messages import Messages
    from coframe.viewer.sources.source import Source, Topic

__all__ = ["Stage"]

# How often the structure is looked at, and the topics; of large trees as often as that share of the time allows.
STRUCTURE_PERIOD, TOPICS_PERIOD = 0.2, 1.0
STRUCTURE_SHARE = 0.005
# A float64 is exact up to 2**53 nanoseconds, 104 days.
_FARTHEST = 2**52
# For how many seconds a frame is shown that is not heard of any more, as in RViz.
FRAME_TIMEOUT = 15.0
# How many replays may be announced and not fetched.
_MOST_LOOKS = 8


class Stage:
    """What all tabs see; used by one thread.

    Args:
        source: What is viewed.
        fixed: The fixed frame that was asked for; "" for the root of the largest tree.
        rviz: What a tab shows at first.
        robot: One that is shown besides those that topics tell of.
        meshes: Where meshes may come from; None: from nowhere.
        joint_states: Where the positions of a robot's joints are sent.
    """

    def __init__(
        self,
        source: Source,
        *,
        fixed: str = "",
        rviz: RvizConfig | None = None,
        robot: Robot | None = None,
        meshes: MeshTable | None = None,
        joint_states: str = JOINT_STATES,
    ) -> None:
        self.edition = 0
        self.source = source
        self.meshes = MeshTable(lambda _name: None) if meshes is None else meshes
        self.descriptions = Descriptions(robot, _description_topics(rviz), self.meshes)
        self.scene = Scene(source.buffer, ages=source.mode == "live")
        self.findings = Findings()
        self.rviz = rviz
        self._joint_states = joint_states
        self.fixed = fixed or (rviz.fixed_frame if rviz is not None else "")
        self.saved_rviz: str | None = None
        self.topics: list[Topic] = []
        self.origin = time.time_ns()
        self.executor = ThreadPoolExecutor(2, "coframe-viewer-work")
        self._open: dict[str, _Shared] = {}
        self._looks: dict[str, ReplayLooks] = {}
        self._structure_due = self._topics_due = 0.0
        self.refresh()

    def show(self, source: Source) -> None:
        """Shows something else from now on: all tabs begin anew."""
        self.source = source
        self.scene = Scene(source.buffer, ages=source.mode == "live")
        self.origin = time.time_ns()
        self._structure_due = self._topics_due = 0.0
        self.refresh()
        self.edition += 1

    def entitle(self, title: str) -> None:
        """Calls what is shown otherwise."""
        self.source.title = title
        self.edition += 1

    @property
    def can_publish(self) -> bool:
        """Whether joint states can be sent."""
        return self.source.connection is not None

    def refresh(self) -> None:
        """Takes in what has changed, now and then."""
        now = time.monotonic()
        if now >= self._structure_due:
            self.scene.refresh()
            spent = time.monotonic() - now
            self._structure_due = now + max(STRUCTURE_PERIOD, spent / STRUCTURE_SHARE)
            self._choose_origin()
            self.descriptions.refresh(self.source, self.executor)
        if now >= self._topics_due:
            self._topics_due = now + TOPICS_PERIOD
            self.source.refresh()
            self.topics = self.source.topics()

    @property
    def span(self) -> tuple[int, int] | None:
        """From when until when there is something to be seen, in nanoseconds; None while there is nothing."""
        return self.source.span or self.scene.span

    def relative_span(self) -> list[int] | None:
        """From when until when there are dynamic transforms, relative to the origin."""
        return None if self.span is None else [end - self.origin for end in self.span]

    def open(self, topic: str) -> Messages | None:
        """The messages of a topic, which all tabs share; None while there is none of that name."""
        shared = self._open.get(topic)
        if shared is None:
            messages = self.source.open(topic)
            if messages is None:
                return None
            shared = self._open[topic] = _Shared(messages)
        shared.users += 1
        return shared.messages

    def release(self, topic: str) -> None:
        """Gives back what `open` gave."""
        shared = self._open[topic]
        shared.users -= 1
        if shared.users == 0:
            del self._open[topic]
            shared.messages.close()

    @contextmanager
    def opened(self, topics: Iterable[str]) -> Iterator[dict[str, Messages]]:
        """The messages of those of the topics that are there, while one needs them."""
        found = {topic: messages for topic in dict.fromkeys(topics) if (messages := self.open(topic)) is not None}
        try:
            yield found
        finally:
            for topic in found:
                self.release(topic)

    def close(self) -> None:
        """Ends what is still at work for tabs that have gone."""
        for topic in list(self._open):
            self._open.pop(topic).messages.close()
        self.findings.close()
        self.executor.shutdown(wait=True, cancel_futures=True)
        self.descriptions.close()

    def joint_publisher(self, robot: Robot) -> JointPublisher:
        """Who sends the positions of a robot's joints.

        Raises:
            ViewerError: There is no ROS graph to send them to.
            WireError: DDS refuses.
        """
        if self.source.connection is None:
            raise ViewerError("only a live viewer sends joint states", hint="Start it by `coframe view live`.")
        return JointPublisher(self.source.connection, robot, self._joint_states)

    def announce_replay(self, looks: ReplayLooks) -> str:
        """Notes how a replay is to look; the name under which it is asked for then."""
        name = secrets.token_urlsafe(12)
        self._looks[name] = looks
        while len(self._looks) > _MOST_LOOKS:
            del self._looks[next(iter(self._looks))]
        return name

    def replay_request(self, told: Mapping[str, str]) -> ReplayRequest:
        """What is to be replayed, from a query; by default all that there is.

        Raises:
            ViewerError: It is nothing that can be.
        """
        span = self.span
        if span is None:
            raise ViewerError("there are no moving frames to be replayed yet")
        try:
            first = round(float(told["from"])) + self.origin if "from" in told else span[0]
            last = round(float(told["to"])) + self.origin if "to" in told else span[1]
            rate = float(told.get("rate", 30.0))
        except (ValueError, OverflowError):
            raise ViewerError("a replay's from, to and rate are numbers") from None
        looks = self._looks.get(told["looks"]) if "looks" in told else NO_LOOKS
        if looks is None:
            raise ViewerError("it is forgotten by now what was to be replayed", hint="Save the replay again.")
        fixed = told.get("fixed") or self.fixed or self.scene.structure.largest
        first, last = max(first, span[0]), min(last, span[1])
        return ReplayRequest(first, last, rate, fixed, FRAME_TIMEOUT, self.source.title, self.origin, looks)

    def _choose_origin(self) -> None:
        span = self.span
        if span is not None and abs(span[1] - self.origin) > _FARTHEST:
            self.origin = span[1]


def _description_topics(rviz: RvizConfig | None) -> list[str]:
    """The usual one, and those that a configuration names."""
    named = [] if rviz is None else rviz.description_topics
    return list(dict.fromkeys([ROBOT_DESCRIPTION, *named]))


class _Shared:
    """The messages of a topic, and how many displays look at them."""

    def __init__(self, messages: Messages) -> None:
        self.messages = messages
        self.users = 0
