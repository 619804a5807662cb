# SPDX-License-Identifier: Apache-2.0
"""A display to which a client has subscribed: the drawing of one message, and its pose in the fixed frame.

Messages usually arrive a little before the transforms at their stamps. A message is therefore shown when its transform
is available; after a short wait without success, the status of the display gives the reason.
"""

from __future__ import annotations

import itertools
import time
from collections import deque
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe._output.formatting import count, error_text
from coframe.errors import ConnectivityException, ExtrapolationException, LookupException, TransformException
from coframe.time import SECOND
from coframe.viewer._failures import report_failure
from coframe.viewer.displays._drawing import FIXED_FRAME
from coframe.viewer.displays._renderers import UnfinishedError
from coframe.viewer.displays.rows import make_renderer, row_of
from coframe.viewer.protocol.encoding import EntryPose, set_owner
from coframe.viewer.sources.topic_messages import StampedMessage

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from numpy.typing import NDArray

    from coframe.buffer.buffer import Buffer
    from coframe.viewer.displays import Drawing, Options
    from coframe.viewer.displays._renderers import Renderer
    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.protocol.common import DisplayState
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["Display", "Status"]

# How long a message waits for its transform, in seconds.
TRANSFORM_TIMEOUT = 1.0
_CACHE_LENGTH = "15s"
MAX_DRAWINGS = 1000  # maximum per message
MAX_LAYER_BYTES = 256 << 20
"""The drawings that stay visible for a decay time or as history may take this much memory in the page."""
_ENTRY_BYTES = 4096  # what a drawing takes there besides its data


class Status(NamedTuple):
    """The status of a display."""

    state: DisplayState
    text: str = ""
    note: str = ""


class _Rendered(NamedTuple):
    """A message with its drawings, or with the status that says why there are none."""

    message: StampedMessage
    drawings: list[Drawing] | Status


class _Entry:
    """A drawing with the pose of its frame in the fixed frame."""

    def __init__(self, drawing: Drawing, sequence: int, frame: str) -> None:
        self.drawing = drawing
        self.frame = frame
        self.sequence = sequence
        self.sent = False
        self.size = len(drawing.data) + _ENTRY_BYTES
        self.pose: NDArray[np.float64] | None = None
        self.error: TransformException | None = None
        self._fixed_frame: str | None = None  # The fixed frame of the pose.

    def place(self, buffer: Buffer, fixed: str, at: int) -> bool:
        """Look up the pose unless it is already known, and return whether it is known."""
        drawing = self.drawing
        if self._fixed_frame == fixed and self.pose is not None and not drawing.locked:
            return True
        self.pose, self._fixed_frame = None, fixed
        if not drawing.placed or self.frame == FIXED_FRAME:
            self.pose = np.array([*drawing.offset, 0.0, 0.0, 0.0, 1.0])
            return True
        try:
            if drawing.locked:
                found = buffer.lookup(fixed, self.frame, at, extrapolate=_CACHE_LENGTH, hold=True)
            else:
                found = buffer.lookup(fixed, self.frame, drawing.stamp)
        except TransformException as error:
            self.error = error
            return False
        self.pose, self.error = np.array(found.values), None
        if any(drawing.offset):
            self.pose[:3] = found.transform_point(drawing.offset)
        return True

    @property
    def is_hopeless(self) -> bool:
        """Whether waiting is unlikely to help: a frame or a connection is missing, or the data was already dropped."""
        error = self.error
        if isinstance(error, ExtrapolationException) and error.requested is not None and error.earliest is not None:
            return error.requested < error.earliest
        return isinstance(error, LookupException | ConnectivityException)


class _Layer(NamedTuple):
    """The drawings of one message."""

    time: int
    entries: list[_Entry]

    def place(self, buffer: Buffer, fixed: str, at: int) -> TransformException | None:
        """Look up the poses of all drawings, and return the first error."""
        missing = [entry.error for entry in self.entries if not entry.place(buffer, fixed, at)]
        return missing[0] if missing else None

    @property
    def size(self) -> int:
        """The memory that the drawings use in the page, in bytes."""
        return sum(entry.size for entry in self.entries)

    @property
    def is_hopeless(self) -> bool:
        return all(entry.is_hopeless for entry in self.entries if entry.error is not None)


class Display:
    """A subscribed display. Use only on the server's thread.

    Args:
        number: The id that the page chose.
        messages: The messages on the topic.
        options: The drawing options.
        resources: What renderers need besides these messages.
        executor: Runs the rendering, so that large messages do not block the server.

    Attributes:
        status: What the page shows about the display.
        is_unfinished: Whether the next updates continue to draw the same message.
    """

    def __init__(
        self, number: int, messages: TopicMessages, options: Options, resources: Resources, executor: Executor
    ) -> None:
        self.number = number
        self.messages = messages
        self.status = Status("waiting", "no message yet")
        self._options = options
        self._executor = executor
        self._resources = resources
        self._renderer: Renderer = make_renderer(messages, options, resources)
        self.is_unfinished = False
        row = row_of(messages.type, options)
        draws = row is not None and row.draws_without_messages and resources.connection is not None
        self._first = StampedMessage(0, 0, lambda: None) if draws else None
        self._sequences = itertools.count(1)
        self._last_key: int | None = None  # The key of the message that was drawn last.
        self._render_task: Future[_Rendered | None] | None = None
        self._incoming: _Layer | None = None
        self._incoming_since = 0.0
        self._left_out = 0  # drawings of the pending layer
        self._layers: deque[_Layer] = deque()
        self._layer_bytes = 0

    def update(self, buffer: Buffer, fixed: str, at: int, now: int) -> None:
        """Update the drawing to the messages visible at a time.

        Args:
            buffer: The transforms.
            fixed: The fixed frame.
            at: The time in nanoseconds; 0 selects the newest message.
            now: The time in nanoseconds at which lifetimes end if `at` is 0.
        """
        self._collect()
        if self._render_task is None and self._incoming is None:
            self._start_drawing(at, at or now)
        if self._incoming is not None:
            self._place_incoming(self._incoming, buffer, fixed, at)
        elif self._layers:
            self._place_again(buffer, fixed, at)

    def take_unsent(self) -> list[tuple[int, bytearray]]:
        """Return the drawings that the client does not have, with their sequence numbers, and release them."""
        drawings = []
        for entry in self._entries():
            if not entry.sent:
                entry.sent = True
                data = entry.drawing.take_data()
                set_owner(data, self.number, entry.sequence)
                drawings.append((entry.sequence, data))
            changes = entry.drawing.changes
            while changes:
                change = changes.pop(0)
                set_owner(change, self.number, entry.sequence)
                drawings.append((entry.sequence, change))
        return drawings

    def poses(self) -> list[EntryPose]:
        """Return the poses of all visible drawings."""
        return [EntryPose(self.number, entry.sequence, entry.pose, entry.frame) for entry in self._entries()]

    def stamps(self) -> list[int | None]:
        """Return the stamps of these poses in nanoseconds; None for drawings without a stamp or locked to a frame."""
        drawings = [entry.drawing for entry in self._entries()]
        return [None if drawing.locked or drawing.stamp == 0 else drawing.stamp for drawing in drawings]

    def picked(self, sequence: int) -> tuple[Drawing, StampedMessage | None] | None:
        """Return a drawing with the newest message of its layer, or None if the drawing no longer exists."""
        for layer in self._layers:
            for entry in layer.entries:
                if entry.sequence == sequence:
                    return entry.drawing, self.messages.at(layer.time)
        return None

    def close(self) -> None:
        """Stop drawing."""
        if self._render_task is not None:
            self._render_task.cancel()

    def _entries(self) -> list[_Entry]:
        return [entry for layer in self._layers for entry in layer.entries]

    def _start_drawing(self, at: int, now: int) -> None:
        if self.messages.pending():
            self._render_task = self._executor.submit(self._find_and_render, at, now)
            return
        message = self.messages.at(at) or self._first
        if message is None:
            self._show_nothing(at)
        elif self._has_changed(message, now, at):
            self._render_task = self._executor.submit(_render, self._renderer, message, now, at)

    def _find_and_render(self, at: int, now: int) -> _Rendered | None:
        """Find the message outside the server's thread, because this is slow, or None if nothing changed."""
        message = self.messages.at(at) or self._first
        if message is None or not self._has_changed(message, now, at):
            return None
        return _render(self._renderer, message, now, at)

    def _has_changed(self, message: StampedMessage, now: int, at: int) -> bool:
        return self._last_key != message.key or self._renderer.has_changed(now, at)

    def _show_nothing(self, at: int) -> None:
        self._clear_layers()
        if self._last_key is not None:  # A new renderer, because the page no longer has the drawings of this one.
            self._renderer = make_renderer(self.messages, self._options, self._resources)
        self._last_key = None
        self.status = Status("waiting", "no message yet" if at == 0 else "no message before this time")

    def _collect(self) -> None:
        if self._render_task is None or not self._render_task.done():
            return
        rendered, self._render_task = self._render_task.result(), None
        if rendered is None:
            return
        self.is_unfinished = isinstance(rendered.drawings, Status) and rendered.drawings.state == "waiting"
        if isinstance(rendered.drawings, Status):
            self.status = rendered.drawings
            if rendered.drawings.state == "error":
                self._last_key = rendered.message.key
            return
        self._last_key = rendered.message.key
        # Unchanged groups of markers return the same drawing, which the client already has.
        known = {id(entry.drawing): entry for entry in self._entries()}
        entries = [
            known.get(id(drawing)) or _Entry(drawing, next(self._sequences), self._frame(drawing))
            for drawing in rendered.drawings[:MAX_DRAWINGS]
        ]
        self._left_out = len(rendered.drawings) - len(entries)
        self._incoming = _Layer(rendered.message.time, entries)
        self._incoming_since = time.monotonic()

    def _frame(self, drawing: Drawing) -> str:
        return FIXED_FRAME if drawing.frame == FIXED_FRAME else self.messages.frame(drawing.frame)

    def _place_incoming(self, layer: _Layer, buffer: Buffer, fixed: str, at: int) -> None:
        missing = layer.place(buffer, fixed, at)
        if missing is None:
            self._show(layer)
            self.status = Status("ok", note=self._omission_note(layer))
            if self._left_out:
                left_out = count(self._left_out, "group")
                self.status = Status(
                    "error", f"not drawn: {left_out} of markers; the maximum per message is {MAX_DRAWINGS}"
                )
            return
        waited = time.monotonic() - self._incoming_since
        if at == 0 and waited < TRANSFORM_TIMEOUT and not layer.is_hopeless:
            return
        placed = [entry for entry in layer.entries if entry.pose is not None]
        self._incoming = None
        if placed or not self._layers:  # Otherwise the previous message stays, as in RViz.
            self._show(_Layer(layer.time, placed))
        self.status = Status("error", _with_hint(missing))

    def _place_again(self, buffer: Buffer, fixed: str, at: int) -> None:
        """Look up the poses again, because the fixed frame may have changed."""
        missing = [error for layer in self._layers if (error := layer.place(buffer, fixed, at)) is not None]
        if missing:
            self.status = Status("error", _with_hint(missing[0]))

    def _show(self, layer: _Layer) -> None:
        """Add the drawings of a message, and remove those that are too old or do not fit into the memory."""
        self._incoming = None
        decay, history = self._options.decay, self._options.history
        if self._layers and layer.time < self._layers[-1].time:
            self._clear_layers()
        self._layers.append(layer)
        self._layer_bytes += layer.size
        oldest = layer.time - decay * SECOND
        while len(self._layers) > 1 and (
            self._layer_bytes > MAX_LAYER_BYTES
            or (len(self._layers) > history and (decay == 0.0 or self._layers[0].time < oldest))
        ):
            self._layer_bytes -= self._layers.popleft().size

    def _clear_layers(self) -> None:
        self._layers.clear()
        self._layer_bytes = 0

    def _omission_note(self, layer: _Layer) -> str:
        """Return what the display omits, or how its subscription differs from what the user requests."""
        if self._layer_bytes + layer.size > MAX_LAYER_BYTES and len(self._layers) > 1:
            shown = (self._layers[-1].time - self._layers[0].time) / SECOND
            return f"the last {shown:.0f} s, because the drawings take at most {MAX_LAYER_BYTES >> 20} MiB"
        return next((entry.drawing.note for entry in layer.entries if entry.drawing.note), self.messages.shortfall)


def _render(renderer: Renderer, message: StampedMessage, now: int, at: int) -> _Rendered:
    """Return the drawings, or the reason why there are none, because a message may contain anything."""
    try:
        return _Rendered(message, renderer.draw(message, now, at))
    except UnfinishedError as progress:
        return _Rendered(message, Status("waiting", str(progress)))
    except ValueError as error:
        return _Rendered(message, Status("error", f"the message cannot be drawn: {error}"))
    except Exception as error:  # noqa: BLE001 - an unexpected error in one message must not stop the viewer
        report_failure("a message could not be drawn", error)
        return _Rendered(message, Status("error", f"the message cannot be drawn: {type(error).__name__}: {error}"))


def _with_hint(error: TransformException) -> str:
    return error_text(error)
