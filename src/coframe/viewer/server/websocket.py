"""One connection to the server: a request that is answered over HTTP, or a WebSocket.

The protocol is the library's, without its input and output. What comes is handed on as it comes; what goes is handed to
the system at once, as much as it takes, and the rest when it asks for more.
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

    Answer: TypeAlias = Callable[[Request], Awaitable[Response | None]]
    Welcome: TypeAlias = "Callable[[WebSocket], Listener]"
    _Part: TypeAlias = tuple[int, bytes | bytearray | memoryview, bool]

__all__ = ["LARGEST_REQUEST", "Listener", "WebSocket"]

_logger = logging.getLogger("coframe.viewer")

LARGEST_REQUEST = 1 << 20
# Long messages go in parts, so that one that is sent keeps no other connection waiting, and is not held twice.
_PART = 1 << 18
# Who neither sends nor takes anything for so long is gone, in seconds; a WebSocket is asked once before.
_PATIENCE = 20.0
_CLOSING_PATIENCE = 2.0


class Listener(Protocol):
    """Whom a WebSocket tells what comes."""

    def hear(self, message: str | bytes) -> None:
        """Takes a message."""

    def leave(self) -> None:
        """The connection has ended."""


class WebSocket(asyncio.Protocol):
    """A connection, of which one becomes a WebSocket where ``answer`` has nothing to say.

    Args:
        answer: The answer to a request over HTTP; None lets the WebSocket be opened.
        welcome: Makes the listener of an opened one.
        all_of_them: Holds the connection for as long as it lasts.
    """

    def __init__(self, answer: Answer, welcome: Welcome, all_of_them: set[WebSocket]) -> None:
        self._answer = answer
        self._all = all_of_them
        self._welcome = welcome
        self._protocol = ServerProtocol(max_size=LARGEST_REQUEST, logger=_quiet_logger())
        self._transport: asyncio.Transport | None = None
        self._listener: Listener | None = None
        self._answering: asyncio.Task[None] | None = None
        self._patience: asyncio.TimerHandle | None = None
        self._is_alive = True
        self._left = 0  # bytes that the system had not taken when that was last looked at
        self._message = bytearray()  # one that is not there as a whole
        self._is_text = True
        self._unsent: deque[_Part] = deque()
        self._clear = asyncio.Event()
        self._clear.set()
        self._takes_more = True

    @property
    def has_ended(self) -> bool:
        """Whether nothing can be sent any more."""
        return self._protocol.state is not OPEN

    @property
    def is_clear(self) -> bool:
        """Whether all that was sent has been taken by the system, or nearly."""
        return self._takes_more and not self._unsent

    async def cleared(self) -> None:
        """Waits until all that was sent has been taken, or the connection ends."""
        await self._clear.wait()

    def send(self, message: str | bytes | bytearray) -> None:
        """Sends a message as soon as there is room; nothing once the connection has ended."""
        opcode = Opcode.TEXT if isinstance(message, str) else Opcode.BINARY
        data = message.encode() if isinstance(message, str) else message
        if len(data) <= _PART:
            self._unsent.append((opcode, data, True))
        else:
            self._unsent.extend(_parts(opcode, memoryview(data)))
        self._send_on()

    def pause(self) -> None:
        """Listens no more."""
        if self._transport is not None:
            self._transport.pause_reading()

    def resume(self) -> None:
        """Listens again."""
        if self._transport is not None:
            self._transport.resume_reading()

    def close(self) -> None:
        """Says goodbye to the other side, and ends."""
        if self._transport is None:
            return
        if self._protocol.state is OPEN:
            self._protocol.send_close(1001)
            self._flush()
            asyncio.get_running_loop().call_later(_CLOSING_PATIENCE, self.abort)
        else:
            self.abort()

    def abort(self) -> None:
        """Ends without a word."""
        if self._transport is not None:
            self._transport.abort()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """As of asyncio.Protocol."""
        self._transport = cast("asyncio.Transport", transport)
        self._all.add(self)
        self._wait()

    def connection_lost(self, exc: Exception | None) -> None:
        """As of asyncio.Protocol."""
        del exc
        self._transport = None
        self._all.discard(self)
        self._protocol.receive_eof()
        self._unsent.clear()
        self._clear.set()
        if self._patience is not None:
            self._patience.cancel()
        if self._answering is not None:
            self._answering.cancel()
        if self._listener is not None:
            self._listener.leave()

    def data_received(self, data: bytes) -> None:
        """As of asyncio.Protocol."""
        self._protocol.receive_data(data)
        for event in self._protocol.events_received():
            if isinstance(event, Request):
                self.pause()  # nobody may say more before the answer
                self._answering = asyncio.get_running_loop().create_task(self._respond(event))
            else:
                self._is_alive = True
                self._take(cast("Frame", event))
        self._flush()
        if self._protocol.state is CLOSING:
            asyncio.get_running_loop().call_later(_CLOSING_PATIENCE, self.abort)

    def eof_received(self) -> None:
        """As of asyncio.Protocol."""
        self._protocol.receive_eof()
        self._flush()

    def pause_writing(self) -> None:
        """As of asyncio.Protocol."""
        self._takes_more = False
        self._clear.clear()

    def resume_writing(self) -> None:
        """As of asyncio.Protocol."""
        self._takes_more = self._is_alive = True
        self._send_on()
        if self.is_clear:
            self._clear.set()

    async def _respond(self, request: Request) -> None:
        try:
            response = await self._answer(request)
        except Exception:
            _logger.exception("a request could not be answered: %s", request.path)
            response = self._protocol.reject(HTTPStatus.INTERNAL_SERVER_ERROR, "This could not be answered.\n")
        if self._protocol.close_expected():  # it said more than a request
            self.abort()
        if self._transport is None or self._transport.is_closing():
            return
        self._protocol.send_response(self._protocol.accept(request) if response is None else response)
        self._flush()
        self._is_alive = True
        if self._protocol.state is OPEN:
            self._listener = self._welcome(self)
        self.resume()

    def _take(self, frame: Frame) -> None:
        if self._listener is None or frame.opcode not in {Opcode.TEXT, Opcode.BINARY, Opcode.CONT}:
            return  # the protocol has answered it
        if frame.opcode is not Opcode.CONT:
            self._is_text = frame.opcode is Opcode.TEXT
        self._message += frame.data
        if not frame.fin:
            return
        message, self._message = bytes(self._message), bytearray()
        try:
            self._listener.hear(message.decode() if self._is_text else message)
        except UnicodeDecodeError:
            self._protocol.fail(1007, "no UTF-8")

    def _send_on(self) -> None:
        while self._unsent and self._takes_more:
            frame = _frame(*self._unsent.popleft())
            if self._transport is not None and self._protocol.state is OPEN:
                self._transport.write(frame)

    def _flush(self) -> None:
        """Hands over what the protocol has to say."""
        for data in self._protocol.data_to_send():
            if self._transport is None or self._transport.is_closing():
                return
            if data:
                self._transport.write(data)
            else:
                self._transport.write_eof()

    def _wait(self) -> None:
        self._patience = asyncio.get_running_loop().call_later(_PATIENCE, self._lose_patience)

    def _lose_patience(self) -> None:
        """Ends what does not live any more."""
        if self._transport is None:
            return
        before, self._left = self._left, self._transport.get_write_buffer_size()
        is_at_work = self._answering is not None and not self._answering.done()
        if not (self._is_alive or is_at_work or self._left < before):
            self.abort()
            return
        self._is_alive = False
        if self._protocol.state is OPEN:
            self._protocol.send_ping(b"")
            self._flush()
        self._wait()


def _parts(opcode: int, data: memoryview) -> Iterator[_Part]:
    """A long message as frames."""
    for start in range(0, len(data), _PART):
        yield opcode if start == 0 else Opcode.CONT, data[start : start + _PART], start + _PART >= len(data)


def _frame(opcode: int, data: bytes | bytearray | memoryview, is_last: bool) -> bytes:
    """As of RFC 6455, 5.2; the library's way to it would cost as much as all else of a tick of a few frames."""
    first, length = opcode | (0x80 if is_last else 0), len(data)
    if length < 126:
        head = struct.pack("!BB", first, length)
    elif length < 1 << 16:
        head = struct.pack("!BBH", first, 126, length)
    else:
        head = struct.pack("!BBQ", first, 127, length)
    return b"".join((head, data))


def _quiet_logger() -> logging.Logger:
    """The library tells of every stranger that breaks off a handshake."""
    logger = logging.getLogger("coframe.viewer.websockets")
    logger.setLevel(logging.CRITICAL)
    return logger
