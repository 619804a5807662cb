"""`coframe.play()`: a recording said again on the graph, in its order and at its pace."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING

from coframe.bags import RecordingError, open_bag
from coframe.frame_names import absolute, renaming
from coframe.messages import find, serialize
from coframe.recorder.playback_clock import PlaybackClock
from coframe.recorder.topic_publishers import TopicPublishers
from coframe.time import duration_ns
from coframe.wire import Participant, QoS

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Mapping
    from datetime import timedelta

    from typing_extensions import Self

    from coframe import _core
    from coframe.bags import Recording
    from coframe.wire import Publisher

__all__ = ["FASTEST", "Player", "play"]

FASTEST = 1000.0  # times as fast as recorded
_CLOCK, _CLOCK_TYPE = "/clock", "rosgraph_msgs/msg/Clock"
_FASTEST_CLOCK = 1000.0  # Hz
_LINGER = 0.3  # seconds: what was said last is to arrive
_NS = 1_000_000_000


class Player:
    """What `play` gives; usable as a context manager. Any thread may call.

    Attributes:
        recording: What is played.
        clock: Recorded time: pause, step, rate.
        played: How many messages were said so far.
    """

    def __init__(
        self,
        recording: Recording,
        *,
        topics: set[str],
        remap: Mapping[str, str],
        rate: float,
        loop: bool,
        start: int,
        paused: bool,
        clock: float | None,
        delay: float,
        domain: int | None,
        names: _core.Renaming | None,
    ) -> None:
        self.recording = recording
        self.played = 0
        self.clock = PlaybackClock(start, rate, paused=paused)
        self._loop = loop
        self._start = start
        self._clock_rate = clock
        self._delay = delay
        self._error: Exception | None = None
        self._closing = threading.Lock()
        self._closed = False
        self._participant = Participant.get(domain)
        try:
            self._node = self._participant.add_node("/", "coframe_play")
            self._outlets = TopicPublishers(self._participant, self._node, recording, topics, remap, names)
        except BaseException:
            self._participant.close()
            raise
        self._threads = [threading.Thread(target=self._guarded, name="coframe-play", daemon=True)]
        if clock is not None:
            publisher = self._outlets.publisher(_CLOCK, _CLOCK_TYPE, QoS(depth=1))
            self._threads.append(
                threading.Thread(target=self._tell_time, args=(publisher,), name="coframe-play-clock", daemon=True)
            )
        for thread in self._threads:
            thread.start()

    @property
    def position(self) -> int:
        """The recorded time that is being played, in nanoseconds."""
        return min(max(self.clock.now, self._start), self.recording.end)

    @property
    def problems(self) -> list[str]:
        """What is not played, a sentence each."""
        return self._outlets.problems

    @property
    def is_playing(self) -> bool:
        """Whether it has not come to its end."""
        return self._threads[0].is_alive()

    def wait(self, timeout: float | None = None) -> bool:
        """Waits for the end; False if that has not come within `timeout` seconds.

        Raises:
            OSError: The recording is no longer there, for example.
        """
        self._threads[0].join(timeout)
        if self._threads[0].is_alive():
            return False
        if self._error is not None:
            raise self._error
        return True

    def pause(self) -> None:
        """Stands still."""
        self.clock.set_paused(True)

    def resume(self) -> None:
        """Goes on."""
        self.clock.set_paused(False)

    def step(self) -> None:
        """Says the next message although it stands still."""
        self.clock.step()

    def set_rate(self, rate: float) -> None:
        """Goes on at another rate: seconds of the recording in a second.

        Raises:
            ValueError: It is not above 0, or above `FASTEST`.
        """
        self.clock.set_rate(_checked_rate(rate))

    def close(self) -> None:
        """Stops and leaves the graph. Closing twice does no harm."""
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

    def _guarded(self) -> None:
        try:
            self._play()
        except Exception as error:  # noqa: BLE001 - it is raised again in the thread that waits
            self._error = error
        finally:
            self.clock.sleep(_LINGER)
            self.clock.stop()

    def _play(self) -> None:
        self._outlets.say_latched(self._start)
        # Publishers and subscribers find each other while nothing is said that would be missed.
        if not self.clock.sleep(self._delay):
            return
        self.clock.jump(self._start)
        while self._play_once() and self._loop:
            self.clock.jump(self._start)
            self._outlets.say_latched(self._start)

    def _play_once(self) -> bool:
        """From the start to the end: False if it was stopped on the way."""
        for channel, received, data in self.recording.in_order(self._outlets.topics, self._start):
            if not self.clock.wait_until(received):
                return False
            if self._outlets.say(channel, data):
                self.played += 1
        return self.clock.wait_until(self.recording.end)

    def _tell_time(self, publisher: Publisher) -> None:
        kind, stamp = find(_CLOCK_TYPE), find("builtin_interfaces/msg/Time")
        period = 1.0 / (self._clock_rate or 1.0)
        due = time.monotonic()
        while not self.clock.stopped:
            seconds, nanoseconds = divmod(self.position, _NS)
            publisher.write(serialize(kind(clock=stamp(sec=seconds, nanosec=nanoseconds))))
            due = max(due + period, time.monotonic())
            self.clock.sleep(max(due - time.monotonic(), 0.0))


def _checked_rate(rate: float) -> float:
    if not 0.0 < rate <= FASTEST:
        raise ValueError(f"a recording is played at a rate above 0 and up to {FASTEST:g}, not {rate:g}")
    return rate


def play(
    path: str | os.PathLike[str],
    *,
    topics: Iterable[str] | None = None,
    remap: Mapping[str, str] | None = None,
    rate: float = 1.0,
    loop: bool = False,
    start_offset: str | int | timedelta = 0,
    paused: bool = False,
    clock: float | None = None,
    delay: str | int | timedelta = "1s",
    domain: int | None = None,
    prefix: str = "",
    keep: Iterable[str] = (),
) -> Player:
    """Says a recording again on the graph, in the background, in its order and at its pace.

    Latched messages come first, wherever playing starts: all static transforms of the recording, and of other latched
    topics the last message before the start; whoever joins later is given them, too.

    Args:
        path: A file, or a folder of rosbag2; a bag of ROS 1 as far as ROS 2 has its types.
        topics: Which topics; None: all.
        remap: Other names for topics: {"/tf": "/robot1/tf"}.
        rate: Seconds of the recording in a second.
        loop: Whether it starts again at its end. Stamps and /clock then jump back.
        start_offset: How far from the beginning it starts, such as "10s".
        paused: Whether it stands still at first.
        clock: How often a second /clock is told, in place of what was recorded of it; None: as recorded.
        delay: How long it waits before the first message, so that subscribers miss nothing.
        domain: The ROS domain, 0 to 232; None: ROS_DOMAIN_ID, or 0.
        prefix: In front of the names of frames in all messages, as it is: ``robot1/`` makes ``robot1/base_link``.
        keep: The frames that get no prefix, as they are shared: ``["map"]``.

    Raises:
        RecordingError: Nothing of it can be read, it has no such topic, or ends before the start.
        WireError: cyclonedds is missing, or DDS does not let us in.
        ValueError: One of the arguments makes no sense.

    Example:
        >>> with coframe.play("run", rate=2.0) as player:                              # doctest: +SKIP
        ...     player.wait()
    """
    _checked_rate(rate)
    if clock is not None and not 0.0 < clock <= _FASTEST_CLOCK:
        raise ValueError(f"/clock is told up to {_FASTEST_CLOCK:g} times a second, not {clock:g}")
    names = renaming(prefix, keep)
    recording = open_bag(Path(path))
    try:
        chosen = _chosen(recording, topics)
        return Player(
            recording,
            topics=chosen - {_CLOCK} if clock is not None else chosen,
            remap={absolute(old): absolute(new) for old, new in (remap or {}).items()},
            rate=rate,
            loop=loop,
            start=_start(recording, duration_ns(start_offset)),
            paused=paused,
            clock=clock,
            delay=duration_ns(delay) / _NS,
            domain=domain,
            names=names,
        )
    except BaseException:
        recording.close()
        raise


def _chosen(recording: Recording, topics: Iterable[str] | None) -> set[str]:
    there = set(recording.topics)
    if topics is None:
        return there
    wanted = set(map(absolute, topics))
    if missing := wanted - set(map(absolute, there)):
        raise RecordingError(
            f"{recording.path} has no topic {', '.join(sorted(missing))}",
            hint=f"It has {', '.join(sorted(there)) or 'none'}.",
        )
    return {topic for topic in there if absolute(topic) in wanted}


def _start(recording: Recording, offset: int) -> int:
    if not 0 <= offset <= recording.duration:
        raise RecordingError(
            f"{recording.path} lasts {recording.duration / _NS:.3f} s: it cannot start at {offset / _NS:.3f} s",
            hint="Choose another start.",
        )
    return recording.start + offset
