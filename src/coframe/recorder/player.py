"""`coframe.play()`: a recording said again on the graph, in its order and at its pace."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.bags import RecordingError, from_yaml, open_bag
from coframe.bags.as_cdr import as_cdr
from coframe.bags.transforms import is_static
from coframe.errors import WireError
from coframe.messages import deserialize, find, serialize
from coframe.recorder.playback import PlaybackClock
from coframe.time import duration_ns
from coframe.wire import Participant, QoS

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Mapping
    from datetime import timedelta

    from typing_extensions import Self

    from coframe.bags import Recording
    from coframe.bags.storage import Channel
    from coframe.wire import Publisher, StaticWriter

__all__ = ["FASTEST", "Player", "play"]

FASTEST = 1000.0  # times as fast as recorded
_CLOCK, _CLOCK_TYPE = "/clock", "rosgraph_msgs/msg/Clock"
_TF_TYPE = "tf2_msgs/msg/TFMessage"
_DEPTH = 100  # messages that a publisher keeps until they have been delivered
_LINGER = 0.3  # seconds: what was said last is to arrive
_NS = 1_000_000_000


class _Outlet(NamedTuple):
    """Where the messages of a recorded channel go."""

    write: Callable[[bytes], None]
    convert: Callable[[bytes], bytes]
    latched: bool


class Player:
    """What `play` gives; usable as a context manager. Any thread may call.

    Attributes:
        recording: What is played.
        clock: Recorded time: pause, step, rate.
        played: How many messages were said so far.
        problems: What is not played, a sentence each.
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
    ) -> None:
        self.recording = recording
        self.played = 0
        self.problems: list[str] = []
        self.clock = PlaybackClock(start, rate, paused=paused)
        self._topics = topics
        self._remap = remap
        self._loop = loop
        self._start = start
        self._clock_rate = clock
        self._delay = delay
        self._error: Exception | None = None
        self._statics: dict[str, StaticWriter] = {}
        self._outlets: dict[tuple[str, str], _Outlet | None] = {}
        self._publishers: dict[tuple[str, str], Publisher] = {}
        self._closing = threading.Lock()
        self._closed = False
        self._participant = Participant.get(domain)
        try:
            self._node = self._participant.add_node("/", "coframe_play")
            self._open_outlets()
        except BaseException:
            self._participant.close()
            raise
        self._threads = [threading.Thread(target=self._guarded, name="coframe-play", daemon=True)]
        if clock is not None:
            publisher = self._publisher(_CLOCK, _CLOCK_TYPE, QoS(depth=1))
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
        self._say_latched()
        # Publishers and subscribers find each other while nothing is said that would be missed.
        if not self.clock.sleep(self._delay):
            return
        self.clock.jump(self._start)
        while self._play_once() and self._loop:
            self.clock.jump(self._start)
            self._say_latched()

    def _play_once(self) -> bool:
        """From the start to the end: False if it was stopped on the way."""
        for channel, received, data in self.recording.in_order(self._topics, self._start):
            if not self.clock.wait_until(received):
                return False
            if self._say(channel, data):
                self.played += 1
        return self.clock.wait_until(self.recording.end)

    def _say(self, channel: Channel, data: bytes) -> bool:
        outlet = self._outlets[channel.topic, channel.type]
        if outlet is None:
            return False
        try:
            outlet.write(outlet.convert(data))
        except WireError:
            if self._closed:
                return False
            self._problem(f"{channel.topic}: a subscription does not keep up, and misses messages")
            return False
        except Exception:  # noqa: BLE001 - of DDS and of the library that converts, which have many ways to say it
            self._problem(f"{channel.topic}: there are damaged messages, which are left out")
            return False
        return True

    def _problem(self, sentence: str) -> None:
        if sentence not in self.problems:
            self.problems.append(sentence)

    def _say_latched(self) -> None:
        """What holds where playing starts, before all else: all static transforms, and of others the last message."""
        for topic, transforms in self._static_transforms().items():
            self._statics[topic].send(transforms)
        latched = {topic for (topic, _), outlet in self._outlets.items() if outlet is not None and outlet.latched}
        last = {
            (channel.topic, channel.type): (channel, data)
            for channel, _, data in self.recording.in_order(latched - self._statics.keys(), None, self._start)
        }
        for channel, data in last.values():
            self._say(channel, data)

    def _static_transforms(self) -> dict[str, list[Any]]:
        """Those of the whole recording, by topic, with the values that hold where playing starts."""
        found: dict[str, dict[str, Any]] = {topic: {} for topic in self._statics}
        for channel, received, data in self.recording.in_order(self._statics):
            outlet = self._outlets[channel.topic, channel.type]
            if outlet is None:
                continue
            try:
                transforms = deserialize(outlet.convert(data), find(_TF_TYPE)).transforms
            except Exception:  # noqa: BLE001 - told of when it is said
                continue
            known = found[channel.topic]
            for transform in transforms:
                if received < self._start or transform.child_frame_id not in known:
                    known[transform.child_frame_id] = transform
        return {topic: list(known.values()) for topic, known in found.items() if known}

    def _open_outlets(self) -> None:
        offers: dict[tuple[str, str], list[QoS]] = {}
        channels = {}
        for channel in self.recording.channels():
            if channel.topic in self._topics:
                key = (channel.topic, channel.type)
                channels.setdefault(key, channel)
                offers.setdefault(key, []).extend(QoS(*profile) for profile in from_yaml(channel.offered_qos))
        for key, channel in channels.items():
            self._outlets[key] = self._outlet(channel, offers[key])

    def _outlet(self, channel: Channel, offered: list[QoS]) -> _Outlet | None:
        converted = as_cdr(channel)
        if converted is None:
            self.problems.append(
                f"{channel.topic} is not played: ROS 2 has no {channel.type} as it was recorded ({channel.encoding})"
            )
            return None
        ros_type, convert = converted
        topic = self._remap.get(channel.topic, channel.topic)
        if is_static(channel.topic) and ros_type == _TF_TYPE:
            writer = self._participant.static_broadcaster(self._node, topic)
            self._statics[channel.topic] = writer
            return _Outlet(_sending(writer), convert, latched=True)
        qos = _together(offered)
        return _Outlet(self._publisher(topic, ros_type, qos).write, convert, qos.transient_local)

    def _publisher(self, topic: str, ros_type: str, qos: QoS) -> Publisher:
        """One for all channels that go there."""
        key = (topic, ros_type)
        if key not in self._publishers:
            self._publishers[key] = self._participant.raw_publisher(self._node, topic, ros_type, qos)
        return self._publishers[key]

    def _tell_time(self, publisher: Publisher) -> None:
        kind, stamp = find(_CLOCK_TYPE), find("builtin_interfaces/msg/Time")
        period = 1.0 / (self._clock_rate or 1.0)
        due = time.monotonic()
        while not self.clock.stopped:
            seconds, nanoseconds = divmod(self.position, _NS)
            publisher.write(serialize(kind(clock=stamp(sec=seconds, nanosec=nanoseconds))))
            due = max(due + period, time.monotonic())
            self.clock.sleep(max(due - time.monotonic(), 0.0))


def _sending(writer: StaticWriter) -> Callable[[bytes], None]:
    kind = find(_TF_TYPE)
    return lambda data: writer.send(deserialize(data, kind).transforms)


def _together(offered: list[QoS]) -> QoS:
    """What one publisher offers in place of several: as much as the best of them, for no subscription asked for more."""
    if not offered:
        return QoS(depth=_DEPTH)
    latched = any(qos.transient_local for qos in offered)
    depth = max(qos.depth for qos in offered)
    return QoS(
        # Of a latched topic the depth says how many messages late joiners are given.
        depth=depth if latched else max(depth, _DEPTH),
        reliable=any(qos.reliable for qos in offered),
        transient_local=latched,
        keep_all=any(qos.keep_all for qos in offered),
    )


def _checked_rate(rate: float) -> float:
    if not 0.0 < rate <= FASTEST:
        raise ValueError(f"a recording is played at a rate above 0 and up to {FASTEST:g}, not {rate:g}")
    return rate


def _absolute(topic: str) -> str:
    return topic if topic.startswith("/") else f"/{topic}"


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

    Raises:
        RecordingError: Nothing of it can be read, it has no such topic, or ends before the start.
        WireError: cyclonedds is missing, or DDS does not let us in.
        ValueError: One of the arguments makes no sense.

    Example:
        >>> with coframe.play("run", rate=2.0) as player:                              # doctest: +SKIP
        ...     player.wait()
    """
    _checked_rate(rate)
    if clock is not None and not 0.0 < clock <= 1000.0:
        raise ValueError(f"/clock is told up to 1000 times a second, not {clock:g}")
    recording = open_bag(Path(path))
    try:
        names = set(recording.topics)
        wanted = names if topics is None else {_absolute(topic) for topic in topics}
        start = recording.start + duration_ns(start_offset)
        if wanted - names:
            raise RecordingError(
                f"{path} has no topic {', '.join(sorted(wanted - names))}", hint=f"It has {', '.join(sorted(names))}."
            )
        if not recording.start <= start <= recording.end:
            seconds = recording.duration / _NS
            raise RecordingError(f"{path} lasts {seconds:.3f} s: it cannot start there", hint="Start earlier.")
        return Player(
            recording,
            topics=wanted - {_CLOCK} if clock is not None else wanted,
            remap={_absolute(old): _absolute(new) for old, new in (remap or {}).items()},
            rate=rate,
            loop=loop,
            start=start,
            paused=paused,
            clock=clock,
            delay=duration_ns(delay) / _NS,
            domain=domain,
        )
    except BaseException:
        recording.close()
        raise
