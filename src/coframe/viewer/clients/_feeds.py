# SPDX-License-Identifier: Apache-2.0
"""The feeds of a client: each produces the newest message about one subject.

A feed yields updates. An update has a key, which names its subject, and a version. The client encodes and sends an
update only if its version differs from the last one with the same key, and only when it can receive more: a slow client
skips versions instead of queueing them. The only state about sent messages is one version per key.
"""

from __future__ import annotations

import math
import time
from functools import partial
from typing import TYPE_CHECKING

from coframe._output.formatting import rounded_duration
from coframe.viewer._findings import finding_rows
from coframe.viewer.clients._history_feeds import StatesFeed, TableFeed
from coframe.viewer.clients._panel_feeds import panel_feeds
from coframe.viewer.clients._scripting import NodesFeed, WidgetsFeed
from coframe.viewer.clients._update import Feed, Update
from coframe.viewer.displays.display import Status
from coframe.viewer.protocol.encoding import encode, encode_frames
from coframe.viewer.protocol.server_messages import (
    DisplayStatus,
    DisplayTopics,
    FindingEntries,
    Hello,
    ProblemReport,
    Stats,
    Tree,
    TreeComponent,
    TreeFrame,
)
from coframe.viewer.protocol.version import PROTOCOL_VERSION
from coframe.viewer.scene.scene import LocalOrigin
from coframe.viewer.scene.statistics import frame_rows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.viewer._findings import FindingsReport
    from coframe.viewer.clients._state import ClientState, Subscription
    from coframe.viewer.protocol.encoding import EntryPose
    from coframe.viewer.robots.descriptions import Description, DescriptionProblem

__all__ = ["FRAMES", "HELLO", "TOPICS", "make_feeds"]

# Keys with special handling in the client.
HELLO, TOPICS, FRAMES = "hello", "topics", "frames"
# Seconds between checks for new robots, findings and topics of displays.
SLOW_PERIOD = 0.25
# Seconds between statistics. For large trees they are sent less often, so that they take at most the given share of the
# time.
STATISTICS_PERIOD, STATISTICS_SHARE = 1.0, 0.003
# Seconds between frame updates while nothing changes.
IDLE_PERIOD = 1.0


class _Feed:
    def __init__(self, client: ClientState) -> None:
        self.due = 0.0
        self._client = client
        self._viewer = client.viewer


class HelloFeed(_Feed):
    """The first message, sent again when the source, its title or the origin changes."""

    def __init__(self, client: ClientState) -> None:
        super().__init__(client)
        self._restarts = client.viewer.restarts

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the message."""
        del now
        viewer = self._viewer
        yield Update(HELLO, (viewer.origin, viewer.edition), self._encode)
        self._restarts = viewer.restarts

    def _encode(self) -> str:
        viewer, client = self._viewer, self._client
        return encode(
            Hello(
                type="hello",
                version=PROTOCOL_VERSION,
                mode=viewer.source.mode,
                title=viewer.source.title,
                origin=str(viewer.origin),
                span=viewer.relative_span(),
                fixed=client.fixed,
                fixed_is_given=viewer.fixed_is_given,
                rviz=None if client.rviz is None else client.rviz.description(),
                topics=viewer.topics,
                can_publish=viewer.can_publish,
                can_open=viewer.can_open,
                can_control=viewer.control is not None,
                recent=viewer.recent_sources(),
                restart=viewer.restart_reason if viewer.restarts != self._restarts else None,
            )
        )


class TreeFeed(_Feed):
    """The tree structure and the fixed frame."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the tree."""
        del now
        fixed = self._client.fixed
        yield Update("tree", (self._viewer.scene.revision, fixed), partial(self._encode, fixed))

    def _encode(self, fixed: str) -> str:
        scene = self._viewer.scene
        structure = scene.structure
        sizes = [0] * len(structure.roots)
        for component in structure.components:
            sizes[component] += 1
        frames = zip(structure.names, structure.parents, structure.static, structure.components, strict=True)
        return encode(
            Tree(
                type="tree",
                revision=scene.revision,
                fixed=fixed,
                frames=[
                    TreeFrame(name=name, parent=parent, static=static, component=component)
                    for name, parent, static, component in frames
                ],
                components=[
                    TreeComponent(root=root, size=size) for root, size in zip(structure.roots, sizes, strict=True)
                ],
            )
        )


class TopicsFeed(_Feed):
    """The topics that can be displayed."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the topics."""
        self.due = now + STATISTICS_PERIOD
        topics = self._viewer.topics
        yield Update(TOPICS, topics, lambda: encode(DisplayTopics(type="topics", topics=topics)))


class StatisticsFeed(_Feed):
    """The statistics of all frames."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the statistics."""
        begin = time.thread_time()
        yield Update("stats", now, self._encode)
        spent = time.thread_time() - begin
        self.due = now + max(STATISTICS_PERIOD, spent / STATISTICS_SHARE)

    def _encode(self) -> str:
        viewer = self._viewer
        rows = frame_rows(viewer.scene, viewer.origin, self._client.frame_timeout)
        return encode(Stats(type="stats", revision=viewer.scene.revision, span=viewer.relative_span(), frames=rows))


class RobotsFeed(_Feed):
    """The robots, and the problems with published descriptions."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield all robots and problems."""
        self.due = now + SLOW_PERIOD
        descriptions = self._viewer.descriptions
        for number, description in list(descriptions.known.items()):
            yield Update(("robot", number), description.version, partial(_encode_robot, description))
        for topic, problem in list(descriptions.problems.items()):
            yield Update(("problem", topic), problem, partial(_encode_problem, problem))


class FindingsFeed(_Feed):
    """The findings of the doctor."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the findings."""
        self.due = now + SLOW_PERIOD
        watcher = self._viewer.findings
        watcher.watch(self._viewer.source)
        yield Update("findings", watcher.report, partial(self._encode, watcher.report))

    def _encode(self, report: FindingsReport) -> str:
        rows = finding_rows(report, self._client.origin)
        return encode(FindingEntries(type="findings", state=report.state, text=report.text, findings=rows))


class FramesFeed(_Feed):
    """Frame updates, with the drawings and statuses of the displays before them."""

    def __init__(self, client: ClientState) -> None:
        super().__init__(client)
        self._origin = LocalOrigin()
        self._late_due = 0.0
        self._sent = -math.inf
        self._idle_updates = 0

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the drawings and statuses of all displays, and the poses of all frames."""
        client, viewer = self._client, self._viewer
        if now >= self._late_due:
            self._late_due = now + SLOW_PERIOD
            client.open_late_displays()
        fixed, at = client.fixed, client.at
        entries: list[EntryPose] = []
        if client.subscriptions:
            yield from self._display_updates(fixed, at, entries)
        if now - self._sent >= IDLE_PERIOD:
            self._idle_updates += 1
        scene = viewer.scene
        listed = [(entry.display, entry.sequence) for entry in entries]
        # The page confirms frame updates, so that it receives no more nodes before it has drawn the last ones.
        nodes = client.nodes.count
        version = (scene.revision, fixed, at, scene.buffer._changes, listed, self._idle_updates, nodes)
        yield Update(FRAMES, version, partial(self._encode, now, fixed, at, entries))

    def _display_updates(self, fixed: str, at: int, entries: list[EntryPose]) -> Iterator[Update]:
        """Yield the drawings that the client does not have, and the statuses; add the poses to `entries`."""
        viewer = self._viewer
        buffer, span = viewer.scene.buffer, viewer.span
        now = 0 if span is None else span[1]
        for number, subscription in self._client.subscriptions.items():
            display = subscription.display
            if display is not None:
                try:
                    display.update(buffer, fixed, at, now)
                    drawings, poses = display.take_unsent(), display.poses()
                except Exception as error:  # noqa: BLE001 - one failure must not stop the others
                    self._client.fail(subscription, error)
                else:
                    for _, drawing in drawings:
                        yield Update(None, None, partial(_keep_data, drawing))
                    entries += poses
            status = self._status(subscription)
            yield Update(("display", number), (subscription.serial, status), partial(_encode_status, number, status))

    def _status(self, subscription: Subscription) -> Status:
        if subscription.problem:
            return Status("error", subscription.problem)
        if subscription.display is None:
            return Status("waiting", f"no node publishes {subscription.topic}")
        status = subscription.display.status
        if status.state == "ok" and self._client.clock.live:
            silence = self._viewer.topic_silence(subscription.display.messages)
            if silence is not None:
                return Status("waiting", f"no message for {rounded_duration(silence)}")
        return status

    def _encode(self, now: float, fixed: str, at: int, entries: list[EntryPose]) -> bytes:
        self._sent = now
        scene = self._viewer.scene
        placed = scene.place(fixed, at, self._client.frame_timeout)
        local = self._origin.localize(placed, scene.structure.indices.get(fixed))
        indices, time_shown = scene.structure.indices, self._time(at)
        return encode_frames(scene.revision, time_shown, self._origin.xyz, local, placed.states, entries, indices)

    def _time(self, at: int) -> float:
        """Return the displayed time relative to the origin; NaN while there is no data."""
        if at == 0:
            span = self._viewer.span
            if span is None:
                return math.nan
            at = span[1]
        return float(at - self._viewer.origin)


def make_feeds(client: ClientState) -> list[Feed]:
    """Return the feeds of a client, in the order in which their messages are sent."""
    return [
        HelloFeed(client),
        TreeFeed(client),
        TopicsFeed(client),
        StatisticsFeed(client),
        RobotsFeed(client),
        FindingsFeed(client),
        *panel_feeds(client),
        TableFeed(client),
        StatesFeed(client),
        WidgetsFeed(client),
        NodesFeed(client),
        FramesFeed(client),
    ]


def _encode_robot(description: Description) -> str:
    return encode(description.message)


def _encode_problem(problem: DescriptionProblem) -> str:
    return encode(ProblemReport(type="problem", text=problem.text, hint=problem.hint))


def _encode_status(number: int, status: Status) -> str:
    message = DisplayStatus(type="display", id=number, state=status.state, text=status.text)
    if status.note:
        message["note"] = status.note
    return encode(message)


def _keep_data(data: bytearray) -> bytearray:
    return data
