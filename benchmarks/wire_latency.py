# SPDX-License-Identifier: Apache-2.0
"""Measures the latency of transforms between two processes, and the processor time of a listener.

A talker publishes messages of ten transforms at 1 kHz. They are stamped with the monotonic clock, and the first one
right before it is sent: its latency is measured.

    python -m benchmarks.wire_latency cpu coframe 5         processor time of the listener, percent of one core
    python -m benchmarks.wire_latency latency coframe 5     until it is stored: nanoseconds, median and 99th percentile
    python -m benchmarks.wire_latency awake coframe 5       until a waiting Python thread is awake: the same

The talker and the listener run on separate processors.

A transform is stored when a lookup returns it; the reader records the time on the thread that stores it. The listeners
are `coframe`, the native reader of a buffer; `zenoh`, the reader over Zenoh; `tf2`, the TransformListener of the
installed tf2_ros; `subscription`, one of rclpy whose callback does nothing; and `udp`, a bare socket that receives the
same bytes. The socket is the floor, and its two latencies are the same.
"""

import contextlib
import os
import socket
import statistics
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Protocol

from benchmarks.processor import leave_processor, take_processor

RATE_HZ = 1000
TRANSFORMS = 10
TARGET, SOURCE = "base_link_0", "arm_link_0"
STAMP_AT = 8
"""Offset of the first stamp in the bytes of the message."""
NS = 1_000_000_000
PATIENCE = 30.0


class Listener(Protocol):
    """Receives messages from its creation on."""

    address: str
    """The address argument of the talker."""

    def has_received(self) -> bool:
        """Return whether the first message has been received."""

    def listen(self, seconds: float) -> None:
        """Receive messages for a time."""

    def next_message(self) -> tuple[int, int]:
        """Wait for a message; return its stamp and the time when it was stored, in nanoseconds."""


class Coframe:
    """Listener: the native reader of a buffer."""

    address = "dds"

    def __init__(self) -> None:
        import coframe
        from coframe.wire import Participant

        self._buffer = coframe.Buffer()
        participant = Participant.get()
        self._reader = participant.tf_reader(participant.add_node("/", "listener"), "/tf", self._buffer, static=False)
        self._last = 0

    def has_received(self) -> bool:
        if self._buffer.can_transform(TARGET, SOURCE):
            self._last = self._buffer.lookup(TARGET, SOURCE).stamp or 0
        return self._last > 0

    @property
    def received(self) -> int:
        """The number of received messages."""
        return self._reader.received

    def listen(self, seconds: float) -> None:
        time.sleep(seconds)

    def next_message(self) -> tuple[int, int]:
        self._buffer.lookup(TARGET, SOURCE, self._last + 1, timeout=NS)  # Waits for a newer one.
        while True:
            stored = self._reader.stored_at
            self._last = self._buffer.lookup(TARGET, SOURCE).stamp or 0
            if self._last < stored == self._reader.stored_at:  # Otherwise the next message is being stored.
                return self._last, stored


class Zenoh(Coframe):
    """Listener: the same over Zenoh, from peer to peer; the talker inherits the variable."""

    def __init__(self) -> None:
        os.environ["COFRAME_WIRE"] = "zenoh"
        super().__init__()


class Tf2:
    """Listener: tf2_ros.TransformListener, which spins in its own thread."""

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

    def has_received(self) -> bool:
        return bool(self._buffer.can_transform(TARGET, SOURCE, self._latest))

    def listen(self, seconds: float) -> None:
        time.sleep(seconds)

    def next_message(self) -> tuple[int, int]:
        raise SystemExit("tf2_ros cannot wait for the next message: only cpu can be measured")


class Subscription(Tf2):
    """Listener: a subscription of rclpy whose callback does nothing, where there is no tf2_ros."""

    def __init__(self) -> None:
        import rclpy
        from tf2_msgs.msg import TFMessage

        self._received = False
        rclpy.init()
        self._node = rclpy.create_node("listener")
        self._node.create_subscription(TFMessage, "/tf", self._on_message, 100)
        threading.Thread(target=rclpy.spin, args=(self._node,), daemon=True).start()

    def _on_message(self, _: object) -> None:
        self._received = True

    def has_received(self) -> bool:
        return self._received


class Udp:
    """Listener: a bare UDP socket."""

    def __init__(self) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.settimeout(1.0)
        self.address = str(self._socket.getsockname()[1])
        self._message = bytearray(4096)

    def has_received(self) -> bool:
        try:
            return self.next_message()[0] > 0
        except TimeoutError:  # On a busy machine, the talker takes a while to start.
            return False

    def listen(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._socket.recv_into(self._message)

    def next_message(self) -> tuple[int, int]:
        self._socket.recv_into(self._message)
        received = time.monotonic_ns()
        seconds, nanoseconds = struct.unpack_from("<II", self._message, STAMP_AT)
        return int(seconds * NS + nanoseconds), received


LISTENERS: dict[str, Callable[[], Listener]] = {
    "coframe": Coframe,
    "zenoh": Zenoh,
    "tf2": Tf2,
    "subscription": Subscription,
    "udp": Udp,
}


def message() -> bytearray:
    """Return the bytes of a TFMessage."""
    from coframe.messages import codec, find

    result = find("tf2_msgs/msg/TFMessage")()
    for number in range(TRANSFORMS):
        stamped = find("geometry_msgs/msg/TransformStamped")()
        stamped.header.frame_id, stamped.child_frame_id = f"base_link_{number}", f"arm_link_{number}"
        stamped.transform.rotation.w = 1.0
        result.transforms.append(stamped)
    return bytearray(codec.serialize(result))


@contextlib.contextmanager
def sender_to(address: str) -> Iterator[Callable[[bytes], object]]:
    """Yield the function that sends bytes to a listener."""
    if address != "dds":
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.connect(("127.0.0.1", int(address)))
            yield sender.send
        return
    from coframe.messages import find
    from coframe.wire import Participant
    from coframe.wire.qos import TF

    participant = Participant.get()
    node = participant.add_node("/", "talker")  # It has no buffer.
    publisher = participant.publisher(node, "/tf", find("tf2_msgs/msg/TFMessage"), TF)
    while not publisher.matched:
        time.sleep(0.01)
    yield publisher.write
    participant.close()


def stamps_at(data: bytearray) -> list[int]:
    """Return the offsets of the stamps in the bytes; each is followed by length and name of the parent."""
    return [data.index(f"base_link_{number}".encode()) - 12 for number in range(TRANSFORMS)]


def stamp(data: bytearray, offset: int) -> None:
    now = time.monotonic_ns()
    struct.pack_into("<II", data, offset, now // NS, now % NS)


def talk(address: str, seconds: float, processor: str) -> None:
    take_processor(processor)
    data = message()
    offsets = stamps_at(data)
    with sender_to(address) as send:
        begin = time.monotonic_ns()
        for number in range(int(seconds * RATE_HZ)):
            left = begin + number * NS // RATE_HZ - time.monotonic_ns()
            if left > 0:
                time.sleep(left / NS)
            for offset in reversed(offsets):
                stamp(data, offset)
            with contextlib.suppress(ConnectionRefusedError):  # The listener has closed its socket.
                send(bytes(data))


@contextlib.contextmanager
def talker(python: str, listener: Listener, seconds: float, processor: str) -> Iterator[None]:
    """Run a talker process on a processor, from the receipt of its first message."""
    arguments = ["talk", listener.address, str(seconds + PATIENCE), processor]
    command = [python, "-E", "-m", "benchmarks.wire_latency", *arguments]
    process = subprocess.Popen(command)
    try:
        print("the first message of the talker", file=sys.stderr, flush=True)
        end = time.monotonic() + PATIENCE
        while not listener.has_received():
            if time.monotonic() > end:
                raise SystemExit(f"no message was received within {PATIENCE:g} s")
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
    """Yield the times from before the write until the message was stored, and until this thread was awake."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        stamp, stored = listener.next_message()
        yield stored - stamp, time.monotonic_ns() - stamp


def percentiles(samples: Iterable[int]) -> tuple[float, ...]:
    cuts = statistics.quantiles(samples, n=100)
    return cuts[49], cuts[98]


def latency(listener: Listener, seconds: float) -> tuple[float, ...]:
    return percentiles(stored for stored, _ in latencies(listener, seconds))


def awake(listener: Listener, seconds: float) -> tuple[float, ...]:
    return percentiles(awake for _, awake in latencies(listener, seconds))


QUANTITIES: dict[str, Callable[[Listener, float], tuple[float, ...]]] = {"cpu": cpu, "latency": latency, "awake": awake}


def main(quantity: str, name: str, seconds: str, argument: str = "") -> None:
    if quantity == "talk":
        talk(name, float(seconds), argument)
        return
    # Use only the loopback interface and a separate domain.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    processor = leave_processor()
    listener = LISTENERS[name]()
    with talker(argument or sys.executable, listener, float(seconds), processor):
        print("the measurement", file=sys.stderr, flush=True)
        print(*QUANTITIES[quantity](listener, float(seconds)), flush=True)
    if name in ("tf2", "subscription"):
        os._exit(0)  # The thread of a real TransformListener keeps the process alive until rclpy.shutdown().


if __name__ == "__main__":
    main(*sys.argv[1:])
