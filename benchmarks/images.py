# SPDX-License-Identifier: Apache-2.0
"""Measures images and clouds between two processes of one machine.

    python -m benchmarks.images rclpy image             images of 1 MB at 30 Hz
    python -m benchmarks.images rclpy cloud             clouds of 40 MB at 2 Hz
    python -m benchmarks.images rclpy cloud_best_effort
    python -m benchmarks.images memory image

Prints the latency (median), the processor time of the sender and of the receiver per message, all in nanoseconds, and
how many messages were sent and received. The contenders are:

- `rclpy`: that of coframe over the middleware in COFRAME_WIRE, or that of ROS 2, whichever the Python has.
- `memory`: bare shared memory. The sender copies the bytes into it and writes to a pipe, the receiver copies them into
  an array.

The latency is the time from before the call that sends until the receiver has the message.
"""

import contextlib
import os
import select
import statistics
import subprocess
import sys
import threading
import time
from array import array
from collections.abc import Callable, Iterator
from multiprocessing import resource_tracker, shared_memory
from pathlib import Path
from typing import Any, NamedTuple

from benchmarks.processor import leave_processor, take_processor

NS = 1_000_000_000
TOPIC = "/large"
PATIENCE = 60.0
SETTLING = 0.5
QUIET = 3.0
"""When no message has arrived for this time, the missing ones are lost."""
SLOTS = 4
"""Messages that fit into the bare shared memory."""


class Kind(NamedTuple):
    """What is sent."""

    size: int
    hertz: float
    messages: int
    reliable: bool


KINDS = {
    "image": Kind(1_000_000, 30.0, 90, reliable=True),
    "cloud": Kind(40_000_000, 2.0, 10, reliable=True),
    "cloud_best_effort": Kind(40_000_000, 2.0, 10, reliable=False),
}
WARM_UP = 3
"""Messages that are not measured."""


class Receiver:
    """Collects the latencies of messages."""

    def __init__(self) -> None:
        self.latencies: list[int] = []
        self.spent = 0

    def add(self, stamp: int) -> None:
        self.latencies.append(time.monotonic_ns() - stamp)
        if len(self.latencies) == WARM_UP:
            self.spent = time.process_time_ns()


def _quality(kind: Kind) -> Any:
    from rclpy.qos import QoSProfile, ReliabilityPolicy

    reliability = ReliabilityPolicy.RELIABLE if kind.reliable else ReliabilityPolicy.BEST_EFFORT
    return QoSProfile(depth=10, reliability=reliability)


def receive_with_rclpy(kind: Kind, receiver: Receiver) -> str:
    import rclpy
    from sensor_msgs.msg import Image

    def on_message(message: Any) -> None:
        receiver.add(message.header.stamp.sec * NS + message.header.stamp.nanosec)

    rclpy.init()
    node = rclpy.create_node("receiver")
    node.create_subscription(Image, TOPIC, on_message, _quality(kind))
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    return ""


@contextlib.contextmanager
def send_with_rclpy(kind: Kind, _: str) -> Iterator[Callable[[], None]]:
    import rclpy
    from sensor_msgs.msg import Image

    rclpy.init()
    node = rclpy.create_node("sender")
    publisher = node.create_publisher(Image, TOPIC, _quality(kind))
    message = Image(data=array("B", bytes(kind.size)), height=1, width=kind.size, step=kind.size, encoding="mono8")
    while not publisher.get_subscription_count():
        time.sleep(0.01)

    def send() -> None:
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(time.monotonic_ns(), NS)
        publisher.publish(message)

    yield send


def receive_from_memory(kind: Kind, receiver: Receiver) -> str:
    size = kind.size + 8
    memory = shared_memory.SharedMemory(create=True, size=SLOTS * size)
    pipe = f"/tmp/coframe_benchmark_{os.getpid()}"  # noqa: S108 - its name contains the process
    os.mkfifo(pipe, 0o600)

    def receive() -> None:
        assert memory.buf is not None
        reading = os.open(pipe, os.O_RDONLY)
        Path(pipe).unlink()
        memory.unlink()  # the sender has opened both
        with memoryview(memory.buf) as view:
            while slot := os.read(reading, 1):
                begin = slot[0] * size
                stamp = int.from_bytes(view[begin : begin + 8], "little")
                data = array("B")
                data.frombytes(view[begin + 8 : begin + size])
                receiver.add(stamp)

    threading.Thread(target=receive, daemon=True).start()
    return f"{memory.name}:{pipe}"


@contextlib.contextmanager
def send_to_memory(kind: Kind, address: str) -> Iterator[Callable[[], None]]:
    name, _, pipe = address.partition(":")
    memory = shared_memory.SharedMemory(name)
    resource_tracker.unregister(f"/{memory.name}", "shared_memory")  # the receiver removes it
    assert memory.buf is not None
    size, data, slot = kind.size + 8, array("B", bytes(kind.size)), 0
    writing = os.open(pipe, os.O_WRONLY)
    with memoryview(memory.buf) as view, memoryview(data) as source:

        def send() -> None:
            nonlocal slot
            stamp = time.monotonic_ns()
            slot = (slot + 1) % SLOTS
            begin = slot * size
            view[begin + 8 : begin + size] = source
            view[begin : begin + 8] = stamp.to_bytes(8, "little")
            os.write(writing, bytes((slot,)))

        yield send


RECEIVERS = {"rclpy": receive_with_rclpy, "memory": receive_from_memory}
SENDERS = {"rclpy": send_with_rclpy, "memory": send_to_memory}


def send_messages(contender: str, kind: Kind, address: str, processor: str) -> None:
    """Send the messages, and print the processor time of each in nanoseconds. End when the input ends."""
    take_processor(processor)
    with SENDERS[contender](kind, address) as send:
        time.sleep(SETTLING)
        for _ in range(WARM_UP):
            send()
            time.sleep(1 / kind.hertz)
        spent, due = time.process_time_ns(), time.monotonic()
        for _ in range(kind.messages):
            send()
            due += 1 / kind.hertz
            time.sleep(max(0.0, due - time.monotonic()))
        print((time.process_time_ns() - spent) / kind.messages, flush=True)
        select.select([sys.stdin], [], [])  # reliable messages may be sent again
    os._exit(0)  # Threads of the middleware may still run.


def measure(contender: str, name: str) -> tuple[float, ...]:
    kind, receiver, processor = KINDS[name], Receiver(), leave_processor()
    address = RECEIVERS[contender](kind, receiver)
    flags = ["-E"] if sys.flags.ignore_environment else []
    command = [sys.executable, *flags, "-m", "benchmarks.images", "send", contender, name, address, processor]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as sender:
        print("the first message", file=sys.stderr, flush=True)
        assert sender.stdout
        sent = float(sender.stdout.readline() or "nan")
        end, seen = time.monotonic() + QUIET, 0
        while time.monotonic() < end and seen < WARM_UP + kind.messages:
            if len(receiver.latencies) != seen:
                seen, end = len(receiver.latencies), time.monotonic() + QUIET
            time.sleep(0.02)
        measured = receiver.latencies[WARM_UP:]
        received = (time.process_time_ns() - receiver.spent) / max(len(measured), 1)
        sender.communicate()
    if not measured:
        return 0.0, sent, 0.0, kind.messages, 0
    return statistics.median(measured), sent, received, kind.messages, min(len(measured), kind.messages)


def main(*arguments: str) -> None:
    # Use only the loopback interface and a separate domain.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    if arguments[0] == "send":
        _, contender, name, address, processor = arguments
        send_messages(contender, KINDS[name], address, processor)
    print(*measure(*arguments), flush=True)
    os._exit(0)  # Threads of the middleware may still run.


if __name__ == "__main__":
    main(*sys.argv[1:])
