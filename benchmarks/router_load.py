# SPDX-License-Identifier: Apache-2.0
"""Many robots on Zenoh, one router, one listener: processor time, latency and lost messages.

The robots are simulated by a few processes. Each robot has a node and a publisher of /tf, whose messages contain the
transforms of its frames. The router is in a separate process; this process subscribes to /tf and stores the
transforms in a buffer:

    python -m benchmarks.router_load 100 20 50 10       # robots, frames of each, Hz, seconds

It prints the messages per second, the processor time of the router and of the listener in percent of one core, the
median and the 99th percentile of the latency from the stamp to the buffer in nanoseconds, and the number of lost
messages.
"""

import itertools
import os
import socket
import struct
import sys
import time
from typing import NamedTuple

from benchmarks.fleet import Child, answer, wait

MODULE = "benchmarks.router_load"
PROCESSES = 4
BATCH = 100  # messages
TF_TYPE = "tf2_msgs/msg/TFMessage"
STAMP_OFFSET = 8  # of the first transform in a TFMessage as CDR
PLACEHOLDER = 1_234_567_890  # seconds; a stamp that is replaced before each publication


class Outcome(NamedTuple):
    """The results of one run; see above."""

    messages_per_second: float
    router: float
    listener: float
    median: float
    p99: float
    lost: int


def simulate(first: int, robots: int, frames: int, hertz: float, seconds: float) -> None:
    """Publish as several robots, evenly distributed over each period."""
    from coframe.messages import codec, find
    from coframe.wire import Participant
    from coframe.wire.qos import TF

    kind = find(TF_TYPE)
    participant = Participant.get()
    publishers, messages = [], []
    for number in range(first, first + robots):
        message = kind()
        for frame in range(frames):
            stamped = find("geometry_msgs/msg/TransformStamped")()
            stamped.header.frame_id = f"robot{number}/link_{frame}"
            stamped.child_frame_id = f"robot{number}/link_{frame + 1}"
            stamped.header.stamp.sec = PLACEHOLDER
            stamped.transform.rotation.w = 1.0
            message.transforms.append(stamped)
        messages.append(bytearray(codec.serialize(message)))
        node = participant.add_node(f"/robot{number}", "driver")
        publishers.append(participant.publisher(node, "/tf", kind, TF))
    offsets = [stamp_offsets(bytes(message)) for message in messages]
    wait(lambda: all(publisher.matched > 0 for publisher in publishers))
    answer("ready")
    sys.stdin.readline()
    start = time.monotonic()
    for number in range(int(hertz * seconds) * robots):
        time.sleep(max(0.0, start + number / (hertz * robots) - time.monotonic()))
        robot = number % robots
        stamp = struct.pack("<iI", *divmod(time.time_ns(), 1_000_000_000))
        for offset in offsets[robot]:
            messages[robot][offset : offset + len(stamp)] = stamp
        publishers[robot].write(bytes(messages[robot]))
    print("done", flush=True)
    sys.stdin.readline()
    participant.close()


def stamp_offsets(message: bytes) -> list[int]:
    """Return where the stamps are in a message."""
    placeholder = struct.pack("<iI", PLACEHOLDER, 0)
    offsets = [message.find(placeholder)]
    while (found := message.find(placeholder, offsets[-1] + 1)) >= 0:
        offsets.append(found)
    return offsets


def route(endpoint: str) -> None:
    """Run the router, and print its processor time."""
    from coframe.wire.zenoh.router import Router

    with Router(listen=[endpoint]):
        answer("ready")
        sys.stdin.readline()
        begin, spent = time.monotonic(), time.process_time()
        print("begun", flush=True)
        sys.stdin.readline()
        print(100 * (time.process_time() - spent) / (time.monotonic() - begin), flush=True)
        sys.stdin.readline()


class Listener:
    """Stores the transforms of /tf in a buffer, and records how old each message was then."""

    def __init__(self) -> None:
        from coframe import Buffer, _core
        from coframe.wire import Participant, QoS

        self.latencies: list[int] = []
        self.buffer = Buffer()
        self.participant = Participant.get()
        self._event = _core.Event()
        node = self.participant.add_node("/", "listener")
        qos = QoS(depth=10_000)
        self._subscription = self.participant.raw_subscription(node, "/tf", TF_TYPE, qos, on_data=self._event)

    def receive(self, expected: int) -> None:
        """Receive until all messages have arrived, or none for two seconds."""
        while len(self.latencies) < expected and self._event.wait(2_000_000_000):
            while self._subscription.pending():
                for data, *_ in self._subscription.take(BATCH):
                    self.buffer.ingest(data)
                    seconds, nanoseconds = struct.unpack_from("<iI", data, STAMP_OFFSET)
                    self.latencies.append(time.time_ns() - seconds * 1_000_000_000 - nanoseconds)


def measure(robots: int = 100, frames: int = 20, hertz: float = 50.0, seconds: float = 10.0) -> Outcome:
    """Run the benchmark once."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        endpoint = f"tcp/127.0.0.1:{server.getsockname()[1]}"
    os.environ["COFRAME_WIRE"] = "zenoh"
    router = Child("route", endpoint, module=MODULE)
    children = [router]
    try:
        router.ask()
        os.environ["ZENOH_CONFIG_OVERRIDE"] = f'mode="client";connect/endpoints=["{endpoint}"]'
        bounds = [robots * number // PROCESSES for number in range(PROCESSES + 1)]
        counts = [(first, last - first) for first, last in itertools.pairwise(bounds) if last > first]
        fleet = [Child("simulate", first, count, frames, hertz, seconds, module=MODULE) for first, count in counts]
        children += fleet
        listener = Listener()
        for child in fleet:
            child.ask()
        router.ask()
        begin, spent = time.monotonic(), time.process_time()
        for child in fleet:
            child.go_on()
        expected = robots * int(hertz * seconds)
        listener.receive(expected)
        elapsed, used = time.monotonic() - begin, time.process_time() - spent
        busy = float(router.ask())
        listener.participant.close()
    finally:
        for child in children:
            child.close()
    latencies = sorted(listener.latencies)
    return Outcome(
        len(latencies) / elapsed,
        busy,
        100 * used / elapsed,
        latencies[len(latencies) // 2],
        latencies[len(latencies) * 99 // 100],
        expected - len(latencies),
    )


def main(*arguments: str) -> None:
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    what, *rest = arguments
    if what == "simulate":
        simulate(int(rest[0]), int(rest[1]), int(rest[2]), float(rest[3]), float(rest[4]))
    elif what == "route":
        route(rest[0])
    else:
        print(*measure(int(what), int(rest[0]), float(rest[1]), float(rest[2])), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
