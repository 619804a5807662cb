# SPDX-License-Identifier: Apache-2.0
"""One connection to the server: an HTTP request that is answered, or a WebSocket.

The library websockets implements the protocol; input and output are implemented here. Received messages are passed on
immediately. Messages are passed to the operating system as far as it accepts them, and the remaining bytes when it is
ready.
"""

from __future__ import annotations

import asyncio
import logging
import struct
from collections import deque
from http import HTTPStatus
from typing import TYPE_CHECKING, Protocol, TypeAlias, cast

from websockets.frames import Frame, Opcode
from websockets.http11 import Request
from websockets.protocol import CLOSING, OPEN
from websockets.server import ServerProtocol

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterator

    from websockets.http11 import Response

    from coframe.viewer.server._connections import Connections

    Answer: TypeAlias = Callable[[Request], Awaitable[Response | None]]
    MakeListener: TypeAlias = "Callable[[WebSocket], Listener]"
    _MessagePart: TypeAlias = tuple[int, bytes | bytearray | memoryview, bool]

__all__ = ["MAX_REQUEST_BYTES", "Listener", "WebSocket"]

_logger = logging.getLogger("coframe.viewer")

MAX_REQUEST_BYTES = 1 << 20
# Long messages are sent in parts, so that they do not block other connections and are not copied completely.
_PART = 1 << 18
# A connection is closed if nothing is sent or received for this many seconds; a WebSocket is pinged once first.
_IDLE_TIMEOUT = 20.0
_CLOSE_TIMEOUT = 2.0


class Listener(Protocol):
    """Receives the messages of a WebSocket."""

    def receive(self, message: str | bytes) -> None:
        """Process a message."""

    def disconnected(self) -> None:
        """Process the end of the connection."""


class WebSocket(asyncio.Protocol):
    """A connection, which becomes a WebSocket if ``answer`` returns no response.

    Args:
        answer: Return the response to an HTTP request; None opens the WebSocket.
        make_listener: Return the listener of an opened WebSocket.
        connections: Contains the connection as long as it exists.
    """

    def __init__(self, answer: Answer, make_listener: MakeListener, connections: Connections) -> None:
        self._answer = answer
        self._connections = connections
        self._make_listener = make_listener
        self._protocol = ServerProtocol(max_size=MAX_REQUEST_BYTES, logger=_quiet_logger())
        self._transport: asyncio.Transport | None = None
        self._listener: Listener | None = None
        self._answer_task: asyncio.Task[None] | None = None
        self._idle_timer: asyncio.TimerHandle | None = None
        self._is_alive = True
        self._unwritten = 0  # Bytes that the operating system had not accepted at the last check.
        self._message = bytearray()  # The parts of an incomplete message.
        self._is_text = True
        self._unsent_parts: deque[_MessagePart] = deque()
        self._clear_event = asyncio.Event()
        self._clear_event.set()
        self._is_writable = True
        self._pause_reasons: set[str] = set()  # The reasons why reading is paused.

    @property
    def has_ended(self) -> bool:
        """Whether the connection is closed or closing."""
        return self._protocol.state is not OPEN

    @property
    def is_clear(self) -> bool:
        """Whether the operating system has accepted nearly everything that was sent."""
        return self._is_writable and not self._unsent_parts

    async def cleared(self) -> None:
        """Wait until the connection is clear or has ended."""
        await self._clear_event.wait()

    def send(self, message: str | bytes | bytearray) -> None:
        """Send a message as soon as possible. Do nothing if the connection has ended."""
        opcode = Opcode.TEXT if isinstance(message, str) else Opcode.BINARY
        data = message.encode() if isinstance(message, str) else message
        if len(data) <= _PART:
            self._unsent_parts.append((opcode, data, True))
        else:
            self._unsent_parts.extend(_parts(opcode, memoryview(data)))
        self._send_unsent()

    def pause(self) -> None:
        """Stop receiving."""
        self._pause("listener")

    def resume(self) -> None:
        """Receive again."""
        self._resume("listener")

    def close(self) -> None:
        """Close the connection with a closing handshake."""
        if self._transport is None:
            return
        if self._protocol.state is OPEN:
            self._protocol.send_close(1001)
            self._flush()
            asyncio.get_running_loop().call_later(_CLOSE_TIMEOUT, self.abort)
        else:
            self.abort()

    def abort(self) -> None:
        """Close the connection immediately."""
        if self._transport is not None:
            self._transport.abort()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Start to receive. See asyncio.Protocol."""
        self._transport = cast("asyncio.Transport", transport)
        if self._connections.add(self):
            self._start_idle_timer()
        else:
            self._transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        """Release everything. See asyncio.Protocol."""
        del exc
        self._transport = None
        self._connections.discard(self)
        self._protocol.receive_eof()
        self._unsent_parts.clear()
        self._clear_event.set()
        if self._idle_timer is not None:
            self._idle_timer.cancel()
        if self._answer_task is not None:
            self._answer_task.cancel()
        if self._listener is not None:
            self._listener.disconnected()

    def data_received(self, data: bytes) -> None:
        """Process received bytes. See asyncio.Protocol."""
        self._protocol.receive_data(data)
        for event in self._protocol.events_received():
            if isinstance(event, Request):
                self._pause("response")  # A client must not send more before it receives the response.
                self._answer_task = asyncio.get_running_loop().create_task(self._respond(event))
            else:
                self._is_alive = True
                self._receive(cast("Frame", event))
        self._flush()
        if self._protocol.state is CLOSING:
            asyncio.get_running_loop().call_later(_CLOSE_TIMEOUT, self.abort)

    def eof_received(self) -> None:
        """Process the end of the received bytes. See asyncio.Protocol."""
        self._protocol.receive_eof()
        self._flush()

    def pause_writing(self) -> None:
        """Stop sending. See asyncio.Protocol."""
        self._is_writable = False
        self._clear_event.clear()
        self._pause("unwritten")  # A client that only sends pings would fill the memory with pongs.

    def resume_writing(self) -> None:
        """Send again. See asyncio.Protocol."""
        self._is_writable = self._is_alive = True
        self._resume("unwritten")
        self._send_unsent()
        if self.is_clear:
            self._clear_event.set()

    async def _respond(self, request: Request) -> None:
        try:
            response = await self._answer(request)
        except Exception:
            _logger.exception("the request %s failed", request.path.partition("?")[0])  # without the token
            response = self._protocol.reject(
                HTTPStatus.INTERNAL_SERVER_ERROR, "The server failed to answer this request.\n"
            )
        if self._protocol.close_expected():  # The client sent more than a request.
            self.abort()
        if self._transport is None or self._transport.is_closing():
            return
        self._protocol.send_response(self._protocol.accept(request) if response is None else response)
        self._flush()
        self._is_alive = True
        if self._protocol.state is OPEN:
            self._listener = self._make_listener(self)
        self._resume("response")

    def _receive(self, frame: Frame) -> None:
        if self._listener is None or frame.opcode not in {Opcode.TEXT, Opcode.BINARY, Opcode.CONT}:
            return  # The protocol has answered it.
        if frame.opcode is not Opcode.CONT:
            self._is_text = frame.opcode is Opcode.TEXT
        self._message += frame.data
        if not frame.fin:
            return
        message, self._message = bytes(self._message), bytearray()
        try:
            self._listener.receive(message.decode() if self._is_text else message)
        except UnicodeDecodeError:
            self._protocol.fail(1007, "not UTF-8")

    def _send_unsent(self) -> None:
        while self._unsent_parts and self._is_writable:
            frame = _frame(*self._unsent_parts.popleft())
            if self._transport is not None and self._protocol.state is OPEN:
                self._transport.write(frame)

    def _pause(self, reason: str) -> None:
        self._pause_reasons.add(reason)
        if self._transport is not None:
            self._transport.pause_reading()

    def _resume(self, reason: str) -> None:
        self._pause_reasons.discard(reason)
        if self._transport is not None and not self._pause_reasons:
            self._transport.resume_reading()

    def _flush(self) -> None:
        """Write the pending bytes of the protocol."""
        for data in self._protocol.data_to_send():
            if self._transport is None or self._transport.is_closing():
                return
            if data:
                self._transport.write(data)
            else:
                self._transport.write_eof()

    def _start_idle_timer(self) -> None:
        self._idle_timer = asyncio.get_running_loop().call_later(_IDLE_TIMEOUT, self._check_idle)

    def _check_idle(self) -> None:
        """Close the connection if it is idle and does not answer a ping."""
        if self._transport is None:
            return
        before, self._unwritten = self._unwritten, self._transport.get_write_buffer_size()
        is_answering = self._answer_task is not None and not self._answer_task.done()
        if not (self._is_alive or is_answering or self._unwritten < before):
            self.abort()
            return
        self._is_alive = False
        if self._protocol.state is OPEN:
            self._protocol.send_ping(b"")
            self._flush()
        self._start_idle_timer()


def _parts(opcode: int, data: memoryview) -> Iterator[_MessagePart]:
    """Yield the parts of a long message."""
    for start in range(0, len(data), _PART):
        yield opcode if start == 0 else Opcode.CONT, data[start : start + _PART], start + _PART >= len(data)


def _frame(opcode: int, data: bytes | bytearray | memoryview, is_last: bool) -> bytes:
    """Return a frame as in RFC 6455, 5.2. With the library, this would double the time of a small update."""
    first, length = opcode | (0x80 if is_last else 0), len(data)
    if length < 126:
        head = struct.pack("!BB", first, length)
    elif length < 1 << 16:
        head = struct.pack("!BBH", first, 126, length)
    else:
        head = struct.pack("!BBQ", first, 127, length)
    return b"".join((head, data))


def _quiet_logger() -> logging.Logger:
    """Return a logger for the library, which would log every client that aborts a handshake."""
    logger = logging.getLogger("coframe.viewer.websockets")
    logger.setLevel(logging.CRITICAL)
    return logger
