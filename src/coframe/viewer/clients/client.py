"""One tab: what it looks at, and what it is sent.

The newest wins: a tick is made only when the tab has drawn the last one and the connection has taken it, so a tab that
is slow or stuck skips ticks. What it asks is answered in order; who asks without reading is not listened to any more.
Ticks are made by plain calls, without tasks and locks, which would cost more than the rest of most of them.
"""

from __future__ import annotations

import asyncio
import contextlib
import dataclasses
import logging
import math
import time
from collections import deque
from typing import TYPE_CHECKING, Any, TypeVar

from coframe.errors import WireError
from coframe.viewer.clients.playback import Playhead
from coframe.viewer.clients.requests import READY, BadRequestError, Request, parse
from coframe.viewer.displays.display import Display, Status
from coframe.viewer.findings import Told, rows
from coframe.viewer.protocol import binary
from coframe.viewer.scene.scene import LocalOrigin
from coframe.viewer.scene.statistics import frame_rows
from coframe.viewer.state import FRAME_TIMEOUT

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.viewer.displays import Options
    from coframe.viewer.robots.descriptions import Description
    from coframe.viewer.robots.joints import JointPublisher
    from coframe.viewer.server.websocket import WebSocket
    from coframe.viewer.state import Stage

__all__ = ["Client"]

_logger = logging.getLogger("coframe.viewer")
T = TypeVar("T")

# Who asks so much without reading the answers is not listened to until they are read.
MOST_REQUESTS = 64
# How often, in seconds; of large trees as often as that share of the time allows.
STATISTICS_PERIOD, STATISTICS_SHARE = 1.0, 0.003
# How often a topic that nobody publishes yet is looked for.
LATE_PERIOD = 0.25
# Where nothing changes, a tick comes all the same once in a while.
IDLE_PERIOD = 1.0
# Ticks a second: RViz's usual rate, and the highest that can be asked for.
FRAME_RATE, FASTEST_RATE = 30.0, 60.0
_MOST_DISPLAYS = 100


class _Wanted:
    """A display that the tab has subscribed to; open once its topic is there."""

    def __init__(self, topic: str, options: Options) -> None:
        self.topic = topic
        self.options = options
        self.display: Display | None = None
        self.told: Status | None = None


class Client:
    """A tab.

    Args:
        socket: Its connection.
        stage: What all tabs see.
    """

    def __init__(self, socket: WebSocket, stage: Stage) -> None:
        self._socket = socket
        self._stage = stage
        self.playhead = Playhead()
        self.frame_timeout = FRAME_TIMEOUT
        self.rviz = stage.rviz
        self.wanted_rate: float | None = None if stage.rviz is None else stage.rviz.frame_rate
        self.wanted_fixed = stage.fixed
        self.due = 0.0
        self._displays: dict[int, _Wanted] = {}
        self._joints: dict[int, JointPublisher] = {}
        self._told_robots: dict[int, Description] = {}
        self._told_problems: dict[str, tuple[str, str]] = {}
        self._origin = LocalOrigin()
        self._requests: deque[Request | BadRequestError] = deque()
        self._answering: asyncio.Task[None] | None = None
        self._ready = True
        self._told_origin: int | None = None
        self._told_edition = 0
        self._told_tree: tuple[int, str] | None = None
        self._told_topics: object = None
        self._told_findings: Told | None = None
        self._statistics_due = 0.0
        self._late_due = 0.0
        self._last_tick: tuple[Any, ...] | None = None
        self._ticked = -math.inf

    @property
    def frame_rate(self) -> float:
        """Ticks a second, at most."""
        return min(self.wanted_rate or FRAME_RATE, FASTEST_RATE)

    @property
    def fixed(self) -> str:
        """The frame that everything is told in."""
        return self.wanted_fixed or self._stage.scene.structure.largest

    @property
    def origin(self) -> int:
        """What the times of this tab are relative to."""
        return self._stage.origin if self._told_origin is None else self._told_origin

    def hear(self, message: str | bytes) -> None:
        """Takes a message. That the last tick is drawn is noted at once; all else is done in order."""
        try:
            request: Request | BadRequestError = parse(message)
        except BadRequestError as error:
            request = error
        if isinstance(request, Request) and request.kind == READY:
            self._ready = True
            return
        self._requests.append(request)
        if len(self._requests) >= MOST_REQUESTS:
            self._socket.pause()
        if self._answering is None:
            self._answering = asyncio.get_running_loop().create_task(self._do_all())

    def leave(self) -> None:
        """The connection has ended."""
        if self._answering is not None:
            self._answering.cancel()
        for number in list(self._displays):
            self.unsubscribe(number)
        for number in list(self._joints):
            self.stop_joints(number)

    async def answer(self, kind: str, **fields: Any) -> None:
        """Sends something that was asked for; waits where the tab does not read."""
        await self._socket.cleared()
        self._socket.send(binary.text(kind, **fields))

    async def work(self, deed: Callable[..., T], *args: Any) -> T:
        """Does what takes long where it keeps nobody waiting."""
        return await asyncio.get_running_loop().run_in_executor(self._stage.executor, deed, *args)

    async def _do_all(self) -> None:
        try:
            while self._requests:
                request = self._requests.popleft()
                if len(self._requests) < MOST_REQUESTS // 2:
                    self._socket.resume()
                await self._do(request)
            self._answering = None
        except Exception:
            _logger.exception("a tab's request failed; the others go on")
            self._socket.abort()

    async def _do(self, request: Request | BadRequestError) -> None:
        try:
            if isinstance(request, BadRequestError):
                raise request
            await request.run(self)
        except BadRequestError as error:
            await self.answer("problem", text=str(error), hint=error.hint)

    @property
    def stage(self) -> Stage:
        """What all tabs see."""
        return self._stage

    @property
    def at(self) -> int:
        """The time that the tab looks at, in nanoseconds; 0 is the newest."""
        return 0 if self.playhead.live else self.playhead.at(self._stage.span)

    def displays(self) -> list[Display]:
        """What is open."""
        return [wanted.display for wanted in self._displays.values() if wanted.display is not None]

    def subscribe(self, number: int, topic: str, options: Options) -> None:
        """Displays a topic from now on; under a number that is in use, instead of what that was.

        Raises:
            BadRequestError: There are too many.
        """
        self.unsubscribe(number)
        if len(self._displays) >= _MOST_DISPLAYS:
            raise BadRequestError(f"a tab has {_MOST_DISPLAYS} displays at most", "Remove one.")
        self._displays[number] = _Wanted(topic, options)
        self._open_display(number, self._displays[number])

    def unsubscribe(self, number: int) -> None:
        """Displays it no longer; whether it was there or not."""
        wanted = self._displays.pop(number, None)
        if wanted is not None:
            self._close_display(wanted)

    def publish_joints(self, number: int, positions: dict[str, Any]) -> None:
        """Sends the positions of a robot's joints from now on.

        Raises:
            ValueError: There is no such robot or joint, or a position is no number.
            WireError: They cannot be sent.
        """
        known = self._stage.descriptions.known.get(number)
        if known is None:
            raise ValueError(f"there is no robot with the number {number}")
        publisher = self._joints.get(number)
        if publisher is None:
            publisher = self._joints[number] = self._stage.joint_publisher(known.robot)
        publisher.set(positions)

    def stop_joints(self, number: int) -> None:
        """Sends them no longer."""
        publisher = self._joints.pop(number, None)
        if publisher is not None:
            publisher.close()

    def _open_display(self, number: int, wanted: _Wanted) -> None:
        messages = self._stage.open(wanted.topic)
        if messages is not None:
            wanted.display = Display(
                number, messages, wanted.options, self._stage.meshes.url_or_problem, self._stage.executor
            )

    def _close_display(self, wanted: _Wanted) -> None:
        wanted.told = None
        if wanted.display is not None:
            wanted.display.close()
            wanted.display = None
            self._stage.release(wanted.topic)

    def tick(self, now: float) -> None:
        """Sends what is new, where the tab can take it; to be called when it is ``due``, by the monotonic clock."""
        # All tabs of a rate are due at the same moments.
        rate = self.frame_rate
        self.due = (math.floor(now * rate) + 1) / rate
        self._send_joints()
        if self._ready and self._socket.is_clear:
            self._send_news(now)

    def _send_news(self, now: float) -> None:
        stage, fixed = self._stage, self.fixed
        stage.refresh()
        if self._told_origin != stage.origin or self._told_edition != stage.edition:
            self._send_hello()
        if self._told_tree != (stage.scene.revision, fixed):
            self._send_tree(fixed)
        if now >= self._statistics_due:
            begin = time.thread_time()
            self._send_statistics()
            spent = time.thread_time() - begin
            self._statistics_due = now + max(STATISTICS_PERIOD, spent / STATISTICS_SHARE)
        if now >= self._late_due:
            self._late_due = now + LATE_PERIOD
            self._open_late_displays()
            self._send_robots()
            self._send_findings()
        at = self.at
        entries = self._send_displays(fixed, at) if self._displays else []
        self._send_tick(now, fixed, at, entries)

    def _send_joints(self) -> None:
        for publisher in self._joints.values():
            with contextlib.suppress(WireError):  # somebody who listens to them hangs
                publisher.send_if_due()

    def _send_robots(self) -> None:
        descriptions = self._stage.descriptions
        for number, known in list(descriptions.known.items()):
            if self._told_robots.get(number) is not known:
                self._told_robots[number] = known
                self._socket.send(binary.text("robot", **known.told))
        for topic, problem in list(descriptions.problems.items()):
            if self._told_problems.get(topic) != problem:
                self._told_problems[topic] = problem
                self._socket.send(binary.text("problem", text=problem[0], hint=problem[1]))

    def _send_findings(self) -> None:
        findings = self._stage.findings
        findings.watch(self._stage.source)
        told = findings.told
        if told != self._told_findings:
            self._told_findings = told
            listed = rows(told, self.origin)
            self._socket.send(binary.text("findings", state=told.state, text=told.text, findings=listed))

    def _send_hello(self) -> None:
        stage = self._stage
        # All begins anew for the page.
        self._told_origin, self._told_edition, self._told_tree = stage.origin, stage.edition, None
        self._last_tick, self._late_due = None, 0.0
        self._told_robots.clear()
        self._told_findings = None
        for wanted in self._displays.values():
            self._close_display(wanted)
            wanted.options = dataclasses.replace(wanted.options, origin=stage.origin)
        self._told_topics = topics = stage.topics
        self._socket.send(
            binary.text(
                "hello",
                version=binary.VERSION,
                mode=stage.source.mode,
                title=stage.source.title,
                origin=str(stage.origin),
                span=stage.relative_span(),
                fixed=self.fixed,
                rviz=None if self.rviz is None else self.rviz.description(),
                topics=[topic._asdict() for topic in topics],
                can_publish=stage.can_publish,
            )
        )

    def _send_tree(self, fixed: str) -> None:
        scene = self._stage.scene
        structure = scene.structure
        self._told_tree = (scene.revision, fixed)
        sizes = [0] * len(structure.roots)
        for component in structure.components:
            sizes[component] += 1
        frames = zip(structure.names, structure.parents, structure.static, structure.components, strict=True)
        self._socket.send(
            binary.text(
                "tree",
                revision=scene.revision,
                fixed=fixed,
                frames=[
                    {"name": name, "parent": parent, "static": static, "component": component}
                    for name, parent, static, component in frames
                ],
                components=[{"root": root, "size": size} for root, size in zip(structure.roots, sizes, strict=True)],
            )
        )

    def _send_statistics(self) -> None:
        stage = self._stage
        if self._told_topics != stage.topics:
            self._told_topics = stage.topics
            self._socket.send(binary.text("topics", topics=[topic._asdict() for topic in stage.topics]))
        rows = frame_rows(stage.scene, stage.origin, self.frame_timeout)
        revision = stage.scene.revision
        self._socket.send(binary.text("stats", revision=revision, span=stage.relative_span(), frames=rows))

    def _open_late_displays(self) -> None:
        for number, wanted in self._displays.items():
            if wanted.display is None:
                self._open_display(number, wanted)

    def _send_displays(self, fixed: str, at: int) -> list[binary.EntryPose]:
        """What is new of the displays, one message each, and what became of them; where it is all to be seen."""
        buffer = self._stage.scene.buffer
        now = self._stage.span[1] if self._stage.span is not None else 0
        entries: list[binary.EntryPose] = []
        for number, wanted in self._displays.items():
            display = wanted.display
            if display is None:
                status = Status("waiting", f"nobody publishes {wanted.topic}")
            else:
                display.advance(buffer, fixed, at, now)
                for _, drawing in display.take_unsent():
                    self._socket.send(drawing)
                entries += display.poses()
                status = display.status
            if status != wanted.told:
                wanted.told = status
                self._socket.send(binary.text("display", id=number, **status._asdict()))
        return entries

    def _send_tick(self, now: float, fixed: str, at: int, entries: list[binary.EntryPose]) -> None:
        scene = self._stage.scene
        listed = [(entry.display, entry.sequence) for entry in entries]
        state = (scene.revision, fixed, at, scene.buffer._changes, listed)
        if state == self._last_tick and now - self._ticked < IDLE_PERIOD:
            return
        self._last_tick, self._ticked = state, now
        placed = scene.place(fixed, at, self.frame_timeout)
        near = self._origin.bring_near(placed, scene.structure.places.get(fixed))
        self._ready = False
        self._socket.send(binary.tick(scene.revision, self._moment(at), self._origin.xyz, near, placed.states, entries))

    def _moment(self, at: int) -> float:
        """The time that is shown, relative to the origin; NaN where there is nothing yet."""
        if at == 0:
            span = self._stage.span
            if span is None:
                return math.nan
            at = span[1]
        return float(at - self._stage.origin)
