# SPDX-License-Identifier: Apache-2.0
"""The nodes of `make soak`: ordinary nodes with rclpy and tf2_ros. They keep nothing per message.

    python -m benchmarks.soak_programs talker NUMBER HZ TRANSFORMS     until a line on standard input
    python -m benchmarks.soak_programs listener NODES                  answers each line with what it has received since
    python -m benchmarks.soak_programs passing NUMBER                  a node that listens for 2 s, and ends

The first transform of each message has its number as x; the listener finds the lost ones from that.
"""

from __future__ import annotations

import json
import sys
import threading
import time
from array import array

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener

NS = 1_000_000_000
_BIN_NS = 20_000  # of the histogram of latencies
_BINS = 50_000  # up to a second
_DEPTH = 10_000  # of the subscription that counts: ten seconds, for a busy machine


def talk(number: int, rate: float, transforms: int) -> None:
    """Publish until a line is read, and print the number of messages."""
    node = rclpy.create_node(f"talker_{number}")
    broadcaster, static = TransformBroadcaster(node), StaticTransformBroadcaster(node)
    messages = []
    for i in range(transforms):
        one = TransformStamped()
        one.header.frame_id = f"robot{number}_{i - 1}" if i else "map"
        one.child_frame_id = f"robot{number}_{i}"
        one.transform.rotation.w = 1.0
        messages.append(one)
    fixed = TransformStamped()
    fixed.header.frame_id, fixed.child_frame_id = f"robot{number}_0", f"robot{number}_sensor"
    fixed.transform.rotation.w = 1.0
    static.sendTransform(fixed)
    ended = threading.Event()

    def wait_for_line() -> None:
        sys.stdin.readline()
        ended.set()

    threading.Thread(target=wait_for_line, daemon=True).start()
    sent = 0
    begin = time.monotonic()
    print("ready", flush=True)
    while not ended.wait(max(begin + sent / rate - time.monotonic(), 0.0)):
        messages[0].transform.translation.x = float(sent)
        now = node.get_clock().now().to_msg()
        for one in messages:
            one.header.stamp = now
        broadcaster.sendTransform(messages)
        sent += 1
    print(sent, flush=True)
    sys.stdin.readline()


class Received:
    """Counts messages, lost messages and latencies."""

    def __init__(self, nodes: int) -> None:
        self.next = array("q", [-1] * nodes)  # the number of the next message of each node; -1 before the first one
        self.messages = self.transforms = self.lost = 0
        self._latencies = array("q", [0] * _BINS)

    def add(self, message: TFMessage) -> None:
        """Count a message."""
        first = message.transforms[0]
        latency = time.time_ns() - Time.from_msg(first.header.stamp).nanoseconds
        self._latencies[min(max(latency // _BIN_NS, 0), _BINS - 1)] += 1
        node, number = int(first.child_frame_id[5:].partition("_")[0]), int(first.transform.translation.x)
        self.lost += max(number - self.next[node], 0) if self.next[node] >= 0 else 0
        self.next[node] = number + 1
        self.messages += 1
        self.transforms += len(message.transforms)

    def report(self) -> dict[str, float]:
        """Return what was received since the last report; latencies in milliseconds."""
        count = sum(self._latencies)
        report = {
            "messages": self.messages,
            "transforms": self.transforms,
            "lost": self.lost,
            "p50": self._percentile(count * 0.50),
            "p99": self._percentile(count * 0.99),
        }
        self.messages = self.transforms = self.lost = 0
        self._latencies = array("q", [0] * _BINS)
        return report

    def _percentile(self, below: float) -> float:
        total = 0
        for number, count in enumerate(self._latencies):
            total += count
            if total >= below:
                return (number + 1) * _BIN_NS / 1e6
        return _BINS * _BIN_NS / 1e6


def listen(nodes: int) -> None:
    """Listen with a TransformListener and a subscription, until a line "end" is read."""
    node = rclpy.create_node("soak_listener")
    listener = TransformListener(Buffer(), node)
    received = Received(nodes)
    lock = threading.Lock()

    def count(message: TFMessage) -> None:
        with lock:
            received.add(message)

    node.create_subscription(TFMessage, "/tf", count, _DEPTH)
    spinner = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
    spinner.start()
    print("ready", flush=True)
    for line in sys.stdin:
        with lock:
            print(json.dumps(received.report()), flush=True)
        if line.strip() == "end":
            break
    listener.unregister()


def pass_by(number: int) -> None:
    """Listen for 2 s, as a command does that a user enters in the meantime."""
    node = rclpy.create_node(f"passing_{number}")
    listener = TransformListener(Buffer(), node, spin_thread=True)
    time.sleep(2.0)
    listener.unregister()


def main(program: str, *arguments: str) -> None:
    rclpy.init()
    if program == "talker":
        talk(int(arguments[0]), float(arguments[1]), int(arguments[2]))
    elif program == "listener":
        listen(int(arguments[0]))
    else:
        pass_by(int(arguments[0]))
    rclpy.shutdown()


if __name__ == "__main__":
    main(*sys.argv[1:])
