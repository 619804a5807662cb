"""How long a transform is on its way between two processes, and what listening costs.

A talker publishes messages of ten transforms at 1 kHz, all of them stamped by the monotonic clock and the first one at
the last moment before it is sent: its latency is measured. The figures of the listener:

    python -m benchmarks.wire_latency cpu coframe 5         processor time, percent of one core
    python -m benchmarks.wire_latency latency coframe 5     till it is there: nanoseconds, median and 99th percentile
    python -m benchmarks.wire_latency awake coframe 5       till a Python thread that waits for it is awake: the same

A transform is there when whoever asks the buffer gets it: the reader notes the time on the thread that has stored it.
Listeners are `coframe`, the buffer's own reader; `tf2`, the TransformListener of whoever provides tf2_ros; and `udp`, a
bare socket that is sent the same bytes: the floor, where there and awake are one.
"""

import contextlib
import os
import socket
import statistics
import struct
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Protocol

RATE_HZ = 1000
TRANSFORMS = 10
TARGET, SOURCE = "base_link_0", "arm_link_0"
STAMP_AT = 8
"""Where the first stamp is in the message's bytes."""
NS = 1_000_000_000
PATIENCE = 30.0


class Listener(Protocol):
    """Takes messages in from when it is made."""

    address: str
    """What a talker is to be told."""

    def heard(self) -> bool:
        """Whether there was a first message."""

    def listen(self, seconds: float) -> None:
        """Goes on for so long."""

    def next_message(self) -> tuple[int, int]:
        """Waits for a message: its stamp, and when it was there; nanoseconds."""


class Coframe:
    """The native reader of a buffer."""

    address = "dds"

    def __init__(self) -> None:
        import coframe
        from coframe.wire import Participant

        self._buffer = coframe.Buffer()
        participant = Participant.get()
        self._reader = participant.tf_reader(participant.add_node("/", "listener"), "/tf", self._buffer, static=False)
        self._seen = 0

    def heard(self) -> bool:
        if self._buffer.can_transform(TARGET, SOURCE):
            self._seen = self._buffer.lookup(TARGET, SOURCE).stamp or 0
        return self._seen > 0

    def listen(self, seconds: float) -> None:
        time.sleep(seconds)

    def next_message(self) -> tuple[int, int]:
        self._buffer.lookup(TARGET, SOURCE, self._seen + 1, timeout=NS)  # possible once there is a newer one
        while True:
            there = self._reader.stored_at
            self._seen = self._buffer.lookup(TARGET, SOURCE).stamp or 0
            if self._seen < there == self._reader.stored_at:  # else the next message is coming in just now
                return self._seen, there


class Tf2:
    """The listener of tf2_ros, which spins in a thread of its own."""

    address = "dds"

    def __init__(self) -> None:
        import rclpy
        import tf2_ros
        from rclpy.time import Time

        rclpy.init()
        self._node = rclpy.create_node("listener")
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer, self._node, spin_thread=True)
        self._latest = Time()

    def heard(self) -> bool:
        return bool(self._buffer.can_transform(TARGET, SOURCE, self._latest))

    def listen(self, seconds: float) -> None:
        time.sleep(seconds)

    def next_message(self) -> tuple[int, int]:
        raise SystemExit("tf2_ros has nothing to wait with for the next message: ask for cpu")


class Udp:
    """A bare socket."""

    def __init__(self) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.settimeout(1.0)
        self.address = str(self._socket.getsockname()[1])
        self._message = bytearray(4096)

    def heard(self) -> bool:
        try:
            return self.next_message()[0] > 0
        except TimeoutError:  # on a busy machine the talker needs its time to start
            return False

    def listen(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._socket.recv_into(self._message)

    def next_message(self) -> tuple[int, int]:
        self._socket.recv_into(self._message)
        there = time.monotonic_ns()
        seconds, nanoseconds = struct.unpack_from("<II", self._message, STAMP_AT)
        return int(seconds * NS + nanoseconds), there


LISTENERS: dict[str, Callable[[], Listener]] = {"coframe": Coframe, "tf2": Tf2, "udp": Udp}


def message() -> bytearray:
    """A TFMessage's bytes."""
    from coframe.messages import codec, find

    result = find("tf2_msgs/msg/TFMessage")()
    for number in range(TRANSFORMS):
        stamped = find("geometry_msgs/msg/TransformStamped")()
        stamped.header.frame_id, stamped.child_frame_id = f"base_link_{number}", f"arm_link_{number}"
        stamped.transform.rotation.w = 1.0
        result.transforms.append(stamped)
    return bytearray(codec.serialize(result))


@contextlib.contextmanager
def road(address: str) -> Iterator[Callable[[bytes], object]]:
    """What sends bytes to a listener."""
    if address != "dds":
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.connect(("127.0.0.1", int(address)))
            yield sender.send
        return
    from coframe.messages import find
    from coframe.wire import Participant
    from coframe.wire.qos import TF

    participant = Participant.get()
    node = participant.add_node("/", "talker")  # it has no buffer of its own
    publisher = participant.publisher(node, "/tf", find("tf2_msgs/msg/TFMessage"), TF)
    while not publisher.matched:
        time.sleep(0.01)
    yield publisher.write
    participant.close()


def stamps_at(data: bytearray) -> list[int]:
    """Where the stamps are in the message's bytes: each in front of the length and the name of its parent."""
    return [data.index(f"base_link_{number}".encode()) - 12 for number in range(TRANSFORMS)]


def stamp(data: bytearray, place: int) -> None:
    now = time.monotonic_ns()
    struct.pack_into("<II", data, place, now // NS, now % NS)


def talk(address: str, seconds: float) -> None:
    data = message()
    places = stamps_at(data)
    with road(address) as send:
        begin = time.monotonic_ns()
        for number in range(int(seconds * RATE_HZ)):
            left = begin + number * NS // RATE_HZ - time.monotonic_ns()
            if left > 0:
                time.sleep(left / NS)
            for place in reversed(places):
                stamp(data, place)
            with contextlib.suppress(ConnectionRefusedError):  # the socket has been closed
                send(bytes(data))


@contextlib.contextmanager
def talker(python: str, listener: Listener, seconds: float) -> Iterator[None]:
    """A process that talks; from when its first message was heard."""
    command = [python, "-E", "-m", "benchmarks.wire_latency", "talk", listener.address, str(seconds + PATIENCE)]
    process = subprocess.Popen(command)
    try:
        end = time.monotonic() + PATIENCE
        while not listener.heard():
            if time.monotonic() > end:
                raise SystemExit(f"nothing was heard for {PATIENCE:g} s")
            time.sleep(0.01)
        yield
    finally:
        process.terminate()
        process.wait()


def cpu(listener: Listener, seconds: float) -> tuple[float, ...]:
    begin, spent = time.monotonic(), time.process_time()
    listener.listen(seconds)
    return (100 * (time.process_time() - spent) / (time.monotonic() - begin),)


def latencies(listener: Listener, seconds: float) -> Iterator[tuple[int, int]]:
    """From before the write till the message was there, and till this thread was awake."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        stamp, there = listener.next_message()
        yield there - stamp, time.monotonic_ns() - stamp


def percentiles(figures: Iterable[int]) -> tuple[float, ...]:
    cuts = statistics.quantiles(figures, n=100)
    return cuts[49], cuts[98]


def latency(listener: Listener, seconds: float) -> tuple[float, ...]:
    return percentiles(there for there, _ in latencies(listener, seconds))


def awake(listener: Listener, seconds: float) -> tuple[float, ...]:
    return percentiles(awake for _, awake in latencies(listener, seconds))


FIGURES: dict[str, Callable[[Listener, float], tuple[float, ...]]] = {"cpu": cpu, "latency": latency, "awake": awake}


def main(figure: str, who: str, seconds: str, talkers_python: str = sys.executable) -> None:
    if figure == "talk":
        talk(who, float(seconds))
        return
    # This machine's loopback only, and away from whoever else is on it.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    listener = LISTENERS[who]()
    with talker(talkers_python, listener, float(seconds)):
        print(*FIGURES[figure](listener, float(seconds)), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
