# SPDX-License-Identifier: Apache-2.0
"""Log messages on /rosout and of the viewer itself, with a limit, for all clients."""

from __future__ import annotations

import time
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from itertools import islice
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import error_text
from coframe.errors import CoframeError, DecodeError, WireError
from coframe.messages import deserialize, find
from coframe.time import SECOND
from coframe.viewer.panels.own_messages import LEVELS, MAX_LINES, MAX_TEXT, LogLine, OwnMessages
from coframe.viewer.sources.adaptive_subscription import AdaptiveSubscription
from coframe.viewer.sources.requested_quality import RequestedQuality

if TYPE_CHECKING:
    from concurrent.futures import Future

    from coframe.bags import Recording
    from coframe.connection.connection import Connection
    from coframe.viewer.protocol.common import LogLevel
    from coframe.viewer.sources.source import ViewerSource
    from coframe.wire.endpoints import Subscription
    from coframe.wire.qos import QoS

__all__ = ["ROSOUT", "Log"]

ROSOUT = "/rosout"
_TYPE = "rcl_interfaces/msg/Log"
_DEPTH = 1000  # the depth that nodes offer
_MAX_RECORDED = 20_000
_PERIOD, _FOLLOW_PERIOD = 0.2, 1.0  # seconds
_MAX_MESSAGES_PER_POLL = 2_000  # maximum number of messages per poll
_ROS1_LEVELS: dict[int, LogLevel] = {1: "debug", 2: "info", 4: "warning", 8: "error", 16: "fatal"}


class Log:
    """The log messages of one source. Use only on the server's thread.

    Messages on /rosout are received only while a page shows the log, messages of the viewer itself always.

    Args:
        source: The source whose /rosout is shown.
        own: The viewer's own messages.

    Attributes:
        lines: The last messages, in receive order.
        total: The number of messages since the start.
        text: A note about missing messages, or "".
    """

    def __init__(self, source: ViewerSource, own: OwnMessages) -> None:
        self._source = source
        self.lines: deque[LogLine] = deque(maxlen=MAX_LINES if source.recording is None else _MAX_RECORDED)
        self.total = 0
        self.text = ""
        self._users = 0
        self._due = self._next_follow = 0.0
        self._subscription: AdaptiveSubscription | None = None
        self._executor: ThreadPoolExecutor | None = None
        self._reading: Future[list[LogLine]] | None = None
        self._closed = False
        self._own_messages = own

    def open(self) -> None:
        """Receive messages. Call `release` at the end."""
        self._users += 1
        if self._users > 1:
            return
        if self._source.recording is not None:
            self._start_reading(self._source.recording)
        elif self._source.connection is not None:
            self._subscribe(self._source.connection)

    def release(self) -> None:
        """Stop receiving messages if no other page shows them."""
        self._users = max(0, self._users - 1)
        if self._users == 0 and self._subscription is not None:
            self._subscription.close()
            self._subscription = None

    def poll(self) -> None:
        """Process new data since the last call."""
        now = time.monotonic()
        if not self._users or now < self._due:
            return
        self._due = now + _PERIOD
        self._collect_recorded()
        self._add(self._own_messages.take())
        if self._subscription is None:
            return
        if now >= self._next_follow:
            self._next_follow = now + _FOLLOW_PERIOD
            self._subscription.follow()
        taken = 0
        while (
            self._subscription.pending() and taken < _MAX_MESSAGES_PER_POLL and (samples := self._subscription.take())
        ):
            taken += len(samples)
            self._add([line for sample in samples if (line := _decode_line(sample.data)) is not None])

    def since(self, seen: int, most: int) -> list[LogLine]:
        """Return messages after the first ``seen`` ones, the oldest ones first."""
        first = len(self.lines) - min(len(self.lines), max(self.total - seen, 0))
        return list(islice(self.lines, first, first + most))

    def close(self) -> None:
        """Stop receiving messages."""
        self._closed = True
        if self._subscription is not None:
            self._subscription.close()
            self._subscription = None
        if self._executor is not None:
            self._executor.shutdown(wait=True, cancel_futures=True)

    def _add(self, lines: list[LogLine]) -> None:
        self.lines.extend(lines)
        self.total += len(lines)

    def _subscribe(self, connection: Connection) -> None:
        participant = connection.participant

        def offers() -> list[QoS]:
            return [one.qos for one in participant.publishers(ROSOUT) if one.ros_type == _TYPE]

        def subscribe(qos: QoS) -> Subscription:
            return participant.subscription(connection.node, ROSOUT, find(_TYPE), qos, adapts=True)

        try:
            self._subscription = AdaptiveSubscription(offers, subscribe, RequestedQuality(depth=_DEPTH))
            self.text = ""
        except WireError as error:
            self.text = error_text(error)

    def _start_reading(self, recording: Recording) -> None:
        if self._executor is not None:
            return
        if ROSOUT not in recording.topics:
            self.text = f"The recording contains no messages on {ROSOUT}."
            return
        self._executor = ThreadPoolExecutor(1, "coframe-viewer-log")
        self.text = f"Reading {ROSOUT} …"
        self._reading = self._executor.submit(self._read, recording)

    def _read(self, recording: Recording) -> list[LogLine]:
        lines: deque[LogLine] = deque(maxlen=_MAX_RECORDED)
        for recorded in recording.messages(ROSOUT):
            if self._closed:
                break
            try:
                lines.append(_line(recorded.message, recorded.stamp))
            except (DecodeError, AttributeError, TypeError, ValueError):
                continue  # A damaged message; `coframe doctor` reports it.
        return list(lines)

    def _collect_recorded(self) -> None:
        if self._reading is None or not self._reading.done():
            return
        reading, self._reading = self._reading, None
        try:
            lines = reading.result()
        except CoframeError as error:
            self.text = error_text(error)
            return
        self.text = f"The last {_MAX_RECORDED} messages." if len(lines) == _MAX_RECORDED else ""
        self._add(lines)


def _decode_line(data: bytes) -> LogLine | None:
    """Return the line of a message, or None if its bytes are damaged."""
    try:
        return _line(deserialize(data, find(_TYPE)), time.time_ns())
    except DecodeError:
        return None


def _line(message: Any, received: int) -> LogLine:
    """Return the line of a ROS 2 or ROS 1 message."""
    stamp = getattr(message, "stamp", None) or message.header.stamp
    level = int(message.level) if not isinstance(message.level, bytes) else message.level[0]
    nanoseconds = stamp.sec * SECOND + stamp.nanosec
    levels = LEVELS if hasattr(message, "stamp") else _ROS1_LEVELS
    place = ":".join(part for part in (str(message.file), str(message.function), str(message.line or "")) if part)
    return LogLine(
        nanoseconds or received,
        levels.get(level, "info"),
        str(message.name)[:MAX_TEXT],
        str(message.msg)[:MAX_TEXT],
        place[:MAX_TEXT],
    )
