# SPDX-License-Identifier: Apache-2.0
"""`coframe.play()`: the replay of a recording on the graph."""

from __future__ import annotations

import os
import threading
import time
from typing import TYPE_CHECKING

from coframe._sources.sources import Source
from coframe.bags import RecordingError
from coframe.frame_names import absolute, renaming
from coframe.messages import find, serialize
from coframe.recorder._merged_recordings import MergedRecordings, open_merged
from coframe.recorder._playback_clock import PlaybackClock
from coframe.recorder._topic_filter import TopicFilter
from coframe.recorder._topic_publishers import TopicPublishers
from coframe.time import SECOND, duration_ns, duration_seconds
from coframe.wire.participant import Participant
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from datetime import timedelta

    from typing_extensions import Self

    from coframe import _core
    from coframe._sources.sources import Location
    from coframe.bags import Recording
    from coframe.time import DurationLike
    from coframe.wire.endpoints import Publisher

__all__ = ["MAX_RATE", "Player", "play"]

MAX_RATE = 1000.0  # times as fast as recorded
_CLOCK, _CLOCK_TYPE = "/clock", "rosgraph_msgs/msg/Clock"
_MAX_CLOCK_RATE = 1000.0  # Hz
_CLOSE_DELAY = 0.3  # seconds to keep the publishers open so that the last messages are delivered


class Player:
    """A running replay. Created by :func:`play`; can be used as a context manager. All methods are thread-safe.

    Attributes:
        recording: The recording, or several that are merged.
        clock: The clock of the recorded time.
        played: The number of messages published so far.
    """

    def __init__(
        self,
        recording: Recording | MergedRecordings,
        *,
        topics: set[str],
        remap: Mapping[str, str],
        rate: float,
        loop: bool,
        start: int,
        end: int | None,
        paused: bool,
        clock: float | None,
        delay: float,
        domain: int | None,
        wire: str | None,
        names: _core.Renaming | None,
    ) -> None:
        self.recording = recording
        self.played = 0
        self.clock = PlaybackClock(start, rate, paused=paused)
        self._loop = loop
        self._start = start
        self._end = recording.received_end if end is None else min(end, recording.received_end)
        self._seek_target: int | None = None  # where `seek` continues
        self._start_event = threading.Event()
        self._clock_rate = clock
        self._delay = delay
        self._error: Exception | None = None
        self._closing = threading.Lock()
        self._closed = False
        self._participant = Participant.get(domain, wire)
        try:
            self._node = self._participant.add_node("/", "coframe_play")
            self._publishers = TopicPublishers(self._participant, self._node, recording, topics, remap, names)
        except BaseException:
            self._participant.close()
            raise
        self._threads = [threading.Thread(target=self._run_guarded, name="coframe-play", daemon=True)]
        if clock is not None:
            publisher = self._publishers.publisher(_CLOCK, _CLOCK_TYPE, QoS(depth=1))
            self._threads.append(
                threading.Thread(target=self._publish_clock, args=(publisher,), name="coframe-play-clock", daemon=True)
            )
        for thread in self._threads:
            thread.start()

    @property
    def position(self) -> int:
        """The recorded time of the replay, in nanoseconds."""
        return min(max(self.clock.now, self._start), self._end)

    @property
    def problems(self) -> list[str]:
        """A message for each topic or message type that cannot be replayed."""
        return self._publishers.problems

    @property
    def is_playing(self) -> bool:
        """Whether the replay has not ended."""
        return self._threads[0].is_alive()

    def wait(self, timeout: DurationLike | None = None) -> bool:
        """Wait until the replay ends.

        Args:
            timeout: How long to wait, such as "2s". If None, wait without a limit.

        Returns:
            True at the end, False after the timeout.

        Raises:
            OSError: The recording cannot be read, for example because it was deleted.
        """
        self._threads[0].join(duration_seconds(timeout))
        if self._threads[0].is_alive():
            return False
        if self._error is not None:
            raise self._error
        return True

    def wait_for_start(self, timeout: DurationLike | None = None) -> bool:
        """Wait until the first message is published, or False after the timeout."""
        return self._start_event.wait(duration_seconds(timeout))

    def pause(self) -> None:
        """Pause the replay."""
        self.clock.set_paused(True)

    def resume(self) -> None:
        """Resume the replay."""
        self.clock.set_paused(False)

    def seek(self, moment: int) -> None:
        """Continue at a receive time in nanoseconds; times outside the recording are limited to it."""
        self._seek_target = min(max(moment, self.recording.received_start), self._end)
        self.clock.interrupt()

    def step(self, number: int = 1) -> None:
        """Publish the next messages while the replay is paused."""
        self.clock.step(number)

    def set_rate(self, rate: float) -> None:
        """Set the rate of the replay: recorded seconds per real second.

        Raises:
            ValueError: The rate is not above 0 and at most `MAX_RATE`.
        """
        self.clock.set_rate(_check_rate(rate))

    def close(self) -> None:
        """Stop the replay and leave the graph. A second call has no effect."""
        with self._closing:
            if self._closed:
                return
            self._closed = True
        self.clock.stop()
        for thread in self._threads:
            thread.join()
        self._node.close()
        self._participant.close()
        self.recording.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run_guarded(self) -> None:
        try:
            self._play()
        except Exception as error:  # noqa: BLE001 - `wait` raises it in the thread of the caller
            self._error = error
        finally:
            self.clock.sleep(_CLOSE_DELAY)
            self.clock.stop()

    def _play(self) -> None:
        self._publishers.publish_latched(self._start)
        # Discovery takes time: messages published before subscriptions match would be lost.
        if not self.clock.sleep(self._delay):
            return
        self._start_event.set()
        start = self._start
        while True:
            self.clock.jump(start)
            complete = self._play_from(start)
            if self.clock.stopped:
                return
            target, self._seek_target = self._seek_target, None
            if target is None and complete and not self._loop:
                return
            start = self._start if target is None else target
            self._publishers.publish_latched(start)

    def _play_from(self, start: int) -> bool:
        """Publish the recording once, from a receive time on. Return False if the replay was stopped or moved."""
        for channel, received, data in self.recording.in_order(self._publishers.topics, start, self._end + 1):
            if not self.clock.wait_until(received):
                return False
            if self._publishers.publish(channel, data):
                self.played += 1
        return self.clock.wait_until(self._end)

    def _publish_clock(self, publisher: Publisher) -> None:
        kind, stamp = find(_CLOCK_TYPE), find("builtin_interfaces/msg/Time")
        period = 1.0 / (self._clock_rate or 1.0)
        due = time.monotonic()
        while not self.clock.stopped:
            seconds, nanoseconds = divmod(self.position, SECOND)
            publisher.write(serialize(kind(clock=stamp(sec=seconds, nanosec=nanoseconds))))
            due = max(due + period, time.monotonic())
            self.clock.sleep(max(due - time.monotonic(), 0.0))


def _check_rate(rate: float) -> float:
    if not 0.0 < rate <= MAX_RATE:
        raise ValueError(f"the rate of a replay must be above 0 and at most {MAX_RATE:g}, not {rate:g}")
    return rate


def play(
    path: Location | Sequence[Location],
    *,
    topics: Iterable[str] | None = None,
    regex: str | None = None,
    exclude: str | None = None,
    exclude_topics: Iterable[str] = (),
    remap: Mapping[str, str] | None = None,
    rate: float = 1.0,
    loop: bool = False,
    start_offset: str | int | timedelta = 0,
    duration: str | int | timedelta | None = None,
    end: int | None = None,
    paused: bool = False,
    clock: float | None = None,
    delay: str | int | timedelta = "1s",
    domain: int | None = None,
    wire: str | None = None,
    prefix: str = "",
    keep: Iterable[str] = (),
) -> Player:
    """Replay a recording on the graph in the background: publish its messages in order and at their original rate.

    Latched messages are published first, wherever the replay starts: all static transforms of the recording, and the
    last message before the start on other latched topics. Late-joining subscriptions also receive them.

    Args:
        path: A file or a rosbag2 folder, or a list of them, which are merged by receive time. From ROS 1 bags, the
            topics whose types exist in ROS 2 are replayed.
        topics: The topics to replay. If None and there is no `regex`, all topics are replayed.
        regex: A regular expression. Topics whose full name matches it are replayed as well.
        exclude: A regular expression. Topics whose full name matches it are not replayed.
        exclude_topics: Topics that are not replayed.
        remap: A mapping from recorded topic names to published topic names: {"/tf": "/robot1/tf"}.
        rate: The rate in recorded seconds per real second, above 0 and at most 1000.
        loop: Whether to start again at the end. Stamps and /clock then jump back.
        start_offset: The start of the replay, relative to the start of the recording, such as "10s".
        duration: The recorded time to replay, such as "30s". If None, the replay ends with the recording.
        end: The receive time at which the replay ends, in nanoseconds. If None, it ends with the recording.
        paused: Whether the replay is paused at first.
        clock: The rate at which /clock is published, in Hz, up to 1000. Recorded messages on /clock are then skipped.
            If None, /clock is replayed like any other topic.
        delay: The time before the first message, such as "1s", in which subscriptions can match.
        domain: The ROS domain, 0 to 232. If None, it is ROS_DOMAIN_ID, or 0 if that is not set.
        wire: The middleware, "dds" or "zenoh"; see :func:`coframe.connect`.
        prefix: A prefix for the frames in all messages, used as given: ``robot1/`` turns ``base_link`` into
            ``robot1/base_link``.
        keep: The frames that are shared by robots and get no prefix: ``["map"]``.

    Raises:
        RecordingError: The recording cannot be read, has no such topic, or ends before the start.
        WireError: The middleware is not installed, or it cannot join the graph.
        ValueError: An argument has an invalid value.

    Example:
        >>> with coframe.play("run", rate=2.0) as player:                              # doctest: +SKIP
        ...     player.wait()
    """
    _check_rate(rate)
    if clock is not None and not 0.0 < clock <= _MAX_CLOCK_RATE:
        raise ValueError(f"the rate of /clock must be above 0 Hz and at most {_MAX_CLOCK_RATE:g} Hz, not {clock:g}")
    names = renaming(prefix, keep)
    chooses = TopicFilter(
        topics if topics is None else list(topics), regex, exclude, hidden=True, exclude_topics=exclude_topics
    )
    recording = open_merged([path] if isinstance(path, str | os.PathLike | Source) else path)
    try:
        chosen = _choose_channels(recording, chooses)
        start = _start(recording, duration_ns(start_offset))
        if duration is not None:
            end = start + duration_ns(duration) if end is None else min(end, start + duration_ns(duration))
        return Player(
            recording,
            topics=chosen - {_CLOCK} if clock is not None else chosen,
            remap={absolute(old): absolute(new) for old, new in (remap or {}).items()},
            rate=rate,
            loop=loop,
            start=start,
            end=end,
            paused=paused,
            clock=clock,
            delay=duration_ns(delay) / SECOND,
            domain=domain,
            wire=wire,
            names=names,
        )
    except BaseException:
        recording.close()
        raise


def _choose_channels(recording: Recording | MergedRecordings, chooses: TopicFilter) -> set[str]:
    available = set(recording.topics)
    if missing := chooses.missing(map(absolute, available)):
        raise RecordingError(
            f"{recording.path} has no topic {', '.join(missing)}",
            hint=f"Its topics: {', '.join(sorted(available)) or 'none'}.",
        )
    return {topic for topic in available if chooses(absolute(topic))}


def _start(recording: Recording | MergedRecordings, offset: int) -> int:
    if not 0 <= offset <= recording.duration:
        duration = f"{recording.duration / SECOND:.3f} s"
        raise RecordingError(
            f"{recording.path} lasts {duration}: the replay cannot start at {offset / SECOND:.3f} s",
            hint=f"Choose a start offset from 0 to {duration}.",
        )
    return recording.received_start + offset
