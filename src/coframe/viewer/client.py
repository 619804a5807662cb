"""One tab: what it looks at, and what it is sent.

The newest wins: a tick is made only when the tab has drawn the last one and the connection has taken it, so a tab that is
slow or stuck skips ticks. What it asks is answered in order; who asks without reading is not listened to any more.
"""

from __future__ import annotations

import asyncio
import contextlib
import math
import time
from typing import TYPE_CHECKING, Any

from websockets.exceptions import ConnectionClosed

from coframe.viewer import protocol
from coframe.viewer.clock import Playhead
from coframe.viewer.requests import BadRequestError, parse
from coframe.viewer.scene import LocalOrigin
from coframe.viewer.statistics import frame_rows

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection

    from coframe.viewer.stage import Stage

__all__ = ["Client"]

# Who asks more than this without reading the answers waits.
MOST_ANSWERS = 64
STATISTICS_PERIOD = 1.0
# Where nothing changes, a tick comes all the same once in a while.
IDLE_PERIOD = 1.0
_FRAME_TIMEOUT = 15.0
_RATE = 30.0


class Client:
    """A tab.

    Args:
        socket: Its connection.
        stage: What all tabs see.
    """

    def __init__(self, socket: ServerConnection, stage: Stage) -> None:
        self._socket = socket
        self._stage = stage
        self.playhead = Playhead()
        self.frame_timeout = _FRAME_TIMEOUT
        self.rate = _RATE
        self.wanted_fixed = stage.fixed
        self.bad_requests = 0
        self._origin = LocalOrigin()
        self._answers: asyncio.Queue[str] = asyncio.Queue(MOST_ANSWERS)
        self._ready = True
        self._told_origin: int | None = None
        self._told_tree: tuple[int, str] | None = None
        self._told_topics: object = None
        self._told_statistics = -math.inf
        self._last_tick: tuple[Any, ...] | None = None
        self._ticked = -math.inf

    @property
    def fixed(self) -> str:
        """The frame that everything is told in."""
        return self.wanted_fixed or self._stage.scene.structure.largest

    @property
    def origin(self) -> int:
        """What the times of this tab are relative to."""
        return self._stage.origin if self._told_origin is None else self._told_origin

    async def run(self) -> None:
        """Until the connection ends."""
        sending = asyncio.create_task(self._send_all())
        try:
            with contextlib.suppress(ConnectionClosed):
                async for message in self._socket:
                    await self._take(message)
        finally:
            sending.cancel()
            with contextlib.suppress(asyncio.CancelledError, ConnectionClosed):
                await sending

    async def answer(self, kind: str, **fields: Any) -> None:
        """Sends something that was asked for; waits where the tab does not read."""
        await self._answers.put(protocol.text(kind, **fields))

    async def _take(self, message: str | bytes) -> None:
        try:
            request = parse(message)
            await request.run(self)
        except BadRequestError as error:
            self.bad_requests += 1
            await self.answer("problem", text=str(error), hint=error.hint)

    def is_ready(self) -> None:
        """The tab has drawn the last tick."""
        self._ready = True

    async def _send_all(self) -> None:
        due = time.monotonic()
        while True:
            while not self._answers.empty():
                await self._socket.send(self._answers.get_nowait())
            if self._ready:
                await self._send_news()
            due = max(due + 1.0 / self.rate, time.monotonic())
            await asyncio.sleep(due - time.monotonic())

    async def _send_news(self) -> None:
        self._stage.refresh()
        if self._told_origin != self._stage.origin:
            await self._send_hello()
        if self._told_tree != (self._stage.scene.revision, self.fixed):
            await self._send_tree()
        now = time.monotonic()
        if now - self._told_statistics >= STATISTICS_PERIOD:
            self._told_statistics = now
            await self._send_statistics()
        await self._send_tick()

    async def _send_hello(self) -> None:
        stage = self._stage
        self._told_origin, self._told_tree, self._last_tick = stage.origin, None, None
        self._told_topics = topics = stage.topics
        await self._socket.send(
            protocol.text(
                "hello",
                version=protocol.VERSION,
                mode=stage.source.mode,
                title=stage.source.title,
                origin=str(stage.origin),
                span=stage.relative_span(),
                fixed=self.fixed,
                rviz=stage.rviz,
                topics=[topic._asdict() for topic in topics],
                can_publish=stage.can_publish,
            )
        )

    async def _send_tree(self) -> None:
        scene = self._stage.scene
        structure = scene.structure
        self._told_tree = (scene.revision, self.fixed)
        sizes = [0] * len(structure.roots)
        for component in structure.components:
            sizes[component] += 1
        frames = zip(structure.names, structure.parents, structure.static, structure.components, strict=True)
        await self._socket.send(
            protocol.text(
                "tree",
                revision=scene.revision,
                fixed=self.fixed,
                frames=[
                    {"name": name, "parent": parent, "static": static, "component": component}
                    for name, parent, static, component in frames
                ],
                components=[
                    {"root": root, "size": size} for root, size in zip(structure.roots, sizes, strict=True)
                ],
            )
        )

    async def _send_statistics(self) -> None:
        stage = self._stage
        if self._told_topics != stage.topics:
            self._told_topics = stage.topics
            await self._socket.send(protocol.text("topics", topics=[topic._asdict() for topic in stage.topics]))
        rows = frame_rows(stage.scene, stage.origin, self.frame_timeout)
        revision = stage.scene.revision
        await self._socket.send(
            protocol.text("stats", revision=revision, span=stage.relative_span(), frames=rows)
        )

    async def _send_tick(self) -> None:
        scene, fixed = self._stage.scene, self.fixed
        live = self.playhead.live
        at = 0 if live else self.playhead.at(scene.span)
        shown = scene.span[1] if live and scene.span is not None else at
        now = time.monotonic()
        state = (scene.revision, fixed, at, self._stage.source.buffer.changes)
        if state == self._last_tick and now - self._ticked < IDLE_PERIOD:
            return
        self._last_tick, self._ticked = state, now
        placed = scene.place(fixed, at, self.frame_timeout)
        names = scene.structure.names
        origin = self._origin.follow(placed, names.index(fixed) if fixed in names else None)
        nothing = live and scene.span is None
        moment = math.nan if nothing else float(shown - self._stage.origin)
        self._ready = False
        await self._socket.send(protocol.tick(scene.revision, moment, origin, placed.poses, placed.states, []))
