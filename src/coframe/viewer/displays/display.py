"""A subscribed display of a tab: the message that it shows, drawn, and where that is in the fixed frame.

A message is shown once the transform of its own time is there: mostly the message comes a little before that. It waits
for a moment, and if that is in vain, the display says why.
"""

from __future__ import annotations

import itertools
import logging
import time
from collections import deque
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from coframe.errors import ConnectivityException, ExtrapolationException, LookupException, TransformException
from coframe.viewer.displays.renderers import artist_for
from coframe.viewer.protocol import binary

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from numpy.typing import NDArray

    from coframe import Buffer
    from coframe.viewer.displays import Drawing, Options
    from coframe.viewer.displays.renderers import Artist, MeshUrl
    from coframe.viewer.sources.messages import Messages, Sighting

__all__ = ["Display", "Status"]

_logger = logging.getLogger("coframe.viewer")

# How long a message waits for its transform, in seconds.
PATIENCE = 1.0
_HOLD = "15s"
_MOST_ENTRIES = 1000
_MOST_LAYERS = 200
_NS = 1_000_000_000
_ANYWHERE = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])


class Status(NamedTuple):
    """What became of a display."""

    state: Literal["ok", "waiting", "error"]
    text: str = ""


class _Drawn(NamedTuple):
    """A message with its drawings, or why there are none."""

    sighting: Sighting
    drawings: list[Drawing] | str


class _Entry:
    """A drawing with the pose of its frame in the fixed frame."""

    def __init__(self, drawing: Drawing, sequence: int, frame: str) -> None:
        self.drawing = drawing
        self._frame = frame
        self.sequence = sequence
        self.sent = False
        self.pose: NDArray[np.float64] | None = None
        self.error: TransformException | None = None
        self._fixed: str | None = None  # what the pose is told in

    def place(self, buffer: Buffer, fixed: str, at: int) -> bool:
        """Looks up where it is, unless that is known; whether it is known now."""
        drawing = self.drawing
        if self._fixed == fixed and self.pose is not None and not drawing.locked:
            return True
        self.pose, self._fixed = None, fixed
        if not drawing.placed:
            self.pose = _ANYWHERE
            return True
        try:
            if drawing.locked:
                found = buffer.lookup(fixed, self._frame, at, extrapolate=_HOLD, hold=True)
            else:
                found = buffer.lookup(fixed, self._frame, drawing.stamp)
        except TransformException as error:
            self.error = error
            return False
        self.pose, self.error = np.array(found.values), None
        return True

    @property
    def is_hopeless(self) -> bool:
        """Whether waiting will hardly help: there is no such frame, no way to it, or that time is forgotten."""
        error = self.error
        if isinstance(error, ExtrapolationException) and error.requested is not None and error.earliest is not None:
            return error.requested < error.earliest
        return isinstance(error, LookupException | ConnectivityException)


class _Layer(NamedTuple):
    """What is drawn of one message."""

    time: int
    entries: list[_Entry]

    def place(self, buffer: Buffer, fixed: str, at: int) -> TransformException | None:
        """Looks up where all of it is; None, or what is missing for some of it."""
        missing = [entry.error for entry in self.entries if not entry.place(buffer, fixed, at)]
        return missing[0] if missing else None

    @property
    def is_hopeless(self) -> bool:
        return all(entry.is_hopeless for entry in self.entries if entry.error is not None)


class Display:
    """What a tab has subscribed to; used by the server's thread.

    Args:
        number: The page's number for it.
        messages: The topic's.
        options: How it draws.
        mesh_url: The address of a mesh that a marker names, or why there is none.
        executor: Where drawings are made, so that large messages keep nobody waiting.
    """

    def __init__(
        self, number: int, messages: Messages, options: Options, mesh_url: MeshUrl, executor: Executor
    ) -> None:
        self.number = number
        self.messages = messages
        self.status = Status("waiting", "no message yet")
        self._options = options
        self._executor = executor
        self._artist: Artist = artist_for(messages, options, mesh_url)
        self._sequences = itertools.count(1)
        self._asked: int | None = None  # the key of the last message that was drawn
        self._work: Future[_Drawn | None] | None = None
        self._incoming: _Layer | None = None
        self._incoming_since = 0.0
        self._layers: deque[_Layer] = deque(maxlen=_MOST_LAYERS)

    def advance(self, buffer: Buffer, fixed: str, at: int, now: int) -> None:
        """Goes on to what is to be seen at a time in nanoseconds; 0 is the newest, and lifetimes end by ``now``."""
        self._collect()
        if self._work is None and self._incoming is None:
            self._start_drawing(at, at or now)
        if self._incoming is not None:
            self._place_incoming(self._incoming, buffer, fixed, at)
        elif self._layers:
            self._place_again(buffer, fixed, at)

    def take_unsent(self) -> list[tuple[int, bytearray]]:
        """The drawings that the page has not got yet, with their numbers, which are given away."""
        drawings = []
        for entry in self._entries():
            if not entry.sent:
                entry.sent = True
                data = entry.drawing.take_data()
                binary.stamp_drawing(data, self.number, entry.sequence)
                drawings.append((entry.sequence, data))
        return drawings

    def poses(self) -> list[binary.EntryPose]:
        """Where everything is that is to be seen."""
        return [binary.EntryPose(self.number, entry.sequence, entry.pose) for entry in self._entries()]

    def stamps(self) -> list[int | None]:
        """When each of those was where it is, in nanoseconds; None for what moves on, or was told without a stamp."""
        drawings = [entry.drawing for entry in self._entries()]
        return [None if drawing.locked or drawing.stamp == 0 else drawing.stamp for drawing in drawings]

    def close(self) -> None:
        """Ends it; a drawing that is being made is thrown away."""
        if self._work is not None:
            self._work.cancel()

    def _entries(self) -> list[_Entry]:
        return [entry for layer in self._layers for entry in layer.entries]

    def _start_drawing(self, at: int, now: int) -> None:
        if self.messages.pending():
            self._work = self._executor.submit(self._look_and_draw, at, now)
            return
        sighting = self.messages.at(at)
        if sighting is None:
            self._show_nothing(at)
        elif self._is_news(sighting, now):
            self._work = self._executor.submit(_draw, self._artist, sighting, now)

    def _look_and_draw(self, at: int, now: int) -> _Drawn | None:
        """Where looking for the message takes a while, too; None where there is nothing new."""
        sighting = self.messages.at(at)
        return _draw(self._artist, sighting, now) if sighting is not None and self._is_news(sighting, now) else None

    def _is_news(self, sighting: Sighting, now: int) -> bool:
        return self._asked != sighting.key or self._artist.fades(now)

    def _show_nothing(self, at: int) -> None:
        self._layers.clear()
        self._asked = None
        self.status = Status("waiting", "no message yet" if at == 0 else "no message so early")

    def _collect(self) -> None:
        if self._work is None or not self._work.done():
            return
        drawn, self._work = self._work.result(), None
        if drawn is None:
            return
        self._asked = drawn.sighting.key
        if isinstance(drawn.drawings, str):
            self.status = Status("error", drawn.drawings)
            return
        # Groups of markers that have not changed are there already.
        known = {id(entry.drawing): entry for entry in self._entries()}
        entries = [
            known.get(id(drawing)) or _Entry(drawing, next(self._sequences), self.messages.frame(drawing.frame))
            for drawing in drawn.drawings[:_MOST_ENTRIES]
        ]
        self._incoming = _Layer(drawn.sighting.time, entries)
        self._incoming_since = time.monotonic()

    def _place_incoming(self, layer: _Layer, buffer: Buffer, fixed: str, at: int) -> None:
        missing = layer.place(buffer, fixed, at)
        if missing is None:
            self._show(layer)
            self.status = Status("ok")
            return
        waited = time.monotonic() - self._incoming_since
        if at == 0 and waited < PATIENCE and not layer.is_hopeless:
            return
        self._show(_Layer(layer.time, [entry for entry in layer.entries if entry.pose is not None]))
        self.status = Status("error", _sentence(missing))

    def _place_again(self, buffer: Buffer, fixed: str, at: int) -> None:
        """The fixed frame may be another one by now."""
        missing = [error for layer in self._layers if (error := layer.place(buffer, fixed, at)) is not None]
        if missing:
            self.status = Status("error", _sentence(missing[0]))

    def _show(self, layer: _Layer) -> None:
        self._incoming = None
        if self._layers and (layer.time < self._layers[-1].time or self._options.decay == 0.0):
            self._layers.clear()
        while self._layers and self._layers[0].time < layer.time - self._options.decay * _NS:
            self._layers.popleft()
        self._layers.append(layer)


def _draw(artist: Artist, sighting: Sighting, now: int) -> _Drawn:
    """The drawings, or why there are none: a message may hold anything."""
    try:
        return _Drawn(sighting, artist.draw(sighting, now))
    except ValueError as error:
        return _Drawn(sighting, f"the message cannot be drawn: {error}")
    except Exception as error:  # whatever a message makes of us, the display tells
        _logger.exception("a message could not be drawn")
        return _Drawn(sighting, f"the message cannot be drawn: {type(error).__name__}: {error}")


def _sentence(error: TransformException) -> str:
    return f"{error} {error.hint}".strip()
