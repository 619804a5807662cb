# SPDX-License-Identifier: Apache-2.0
"""The programs between which faults happen: ordinary nodes with rclpy and tf2_ros.

    python -m benchmarks.faults.programs talker robot1 100     publish odom_robot1 -> robot1 at 100 Hz
    python -m benchmarks.faults.programs listener robot1       listen, and report what was stored
    python -m benchmarks.faults.programs listener robot1 10    the same, with a cache of 10 s

Both print "ready", then wait for a line on standard input and print one line of JSON. The line that ends a listener is
the JSON {robot: [stamps that were sent]}. The translation is a pseudo-random function of the stamp: an interpolated
value instead of a missing message would be noticed.
"""

from __future__ import annotations

import json
import sys
import threading
import time

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)

NS = 1_000_000_000
JOINTS = 4  # transforms per message in addition to that of the robot
_POLL = 0.005  # seconds
_LONG_CACHE = 100_000  # seconds


def value(stamp: int) -> float:
    """Return the translation at a stamp in nanoseconds."""
    return (stamp // 1000 * 2654435761 % 2**32) / 2**32


def _transform(parent: str, child: str, stamp: int) -> TransformStamped:
    transform = TransformStamped()
    transform.header.stamp = Time(nanoseconds=stamp).to_msg()
    transform.header.frame_id, transform.child_frame_id = parent, child
    transform.transform.translation.x = value(stamp)
    transform.transform.rotation.w = 1.0
    return transform


def talk(robot: str, rate: float) -> None:
    """Publish until a line is read; print the stamps and the longest duration of a publish()."""
    node = rclpy.create_node(f"talker_{robot}")
    broadcaster, static = TransformBroadcaster(node), StaticTransformBroadcaster(node)
    static.sendTransform(_transform(robot, f"{robot}_sensor", node.get_clock().now().nanoseconds))
    stamps: list[int] = []
    slowest = 0.0
    ended = _end_of_input()
    begin = time.monotonic()
    print("ready", flush=True)
    while not ended.wait(max(begin + len(stamps) / rate - time.monotonic(), 0.0)):
        stamp = node.get_clock().now().nanoseconds
        edges = [(f"odom_{robot}", robot), *((robot, f"{robot}_joint{joint}") for joint in range(JOINTS))]
        before = time.monotonic()
        broadcaster.sendTransform([_transform(parent, child, stamp) for parent, child in edges])
        slowest = max(slowest, time.monotonic() - before)
        stamps.append(stamp)
        if time.monotonic() - begin > (len(stamps) + rate) / rate:  # It was stopped: do not publish in a burst.
            begin = time.monotonic() - len(stamps) / rate
    print(json.dumps({"stamps": stamps, "slowest": slowest}), flush=True)
    sys.stdin.readline()  # The last messages may have to be sent again.


def listen(robots: list[str], cache: int) -> None:
    """Listen until a line is read; print when the newest stamp of each robot changed, and which stamps are stored.

    Also print when all publishers of static transforms had been discovered, and when their transforms were there.
    """
    node = rclpy.create_node("listener")
    buffer = Buffer(cache_time=Duration(seconds=cache))
    listener = TransformListener(buffer, node, spin_thread=True)
    arrivals: dict[str, list[tuple[float, int]]] = {robot: [] for robot in robots}
    statics: dict[str, float] = {}
    discovered: float | None = None
    ended = _end_of_input()
    print("ready", flush=True)
    while not ended.wait(_POLL):
        if discovered is None and len(node.get_publishers_info_by_topic("/tf_static")) >= len(robots):
            discovered = time.monotonic()
        for robot in robots:
            newest = _newest(buffer, f"odom_{robot}", robot)
            if newest and (not arrivals[robot] or arrivals[robot][-1][1] != newest):
                arrivals[robot].append((time.monotonic(), newest))
            if robot not in statics and buffer.can_transform(robot, f"{robot}_sensor", Time()):
                statics[robot] = time.monotonic()
    sent: dict[str, list[int]] = json.loads(ended.line or "{}")
    stored = {robot: [_has(buffer, robot, stamp) for stamp in stamps] for robot, stamps in sent.items()}
    report = {"arrivals": arrivals, "statics": statics, "discovered": discovered, "stored": stored}
    print(json.dumps(report), flush=True)
    listener.unregister()


def _newest(buffer: Buffer, target: str, source: str) -> int:
    try:
        return int(Time.from_msg(buffer.lookup_transform(target, source, Time()).header.stamp).nanoseconds)
    except TransformException:
        return 0


def _has(buffer: Buffer, robot: str, stamp: int) -> bool:
    try:
        found = buffer.lookup_transform(f"odom_{robot}", robot, Time(nanoseconds=stamp))
    except TransformException:
        return False
    return bool(abs(found.transform.translation.x - value(stamp)) < 1e-12)


class _EndOfInput(threading.Event):
    line = ""


def _end_of_input() -> _EndOfInput:
    ended = _EndOfInput()

    def read() -> None:
        ended.line = sys.stdin.readline()
        ended.set()

    threading.Thread(target=read, daemon=True).start()
    return ended


def main(program: str, *arguments: str) -> None:
    rclpy.init()
    if program == "talker":
        talk(arguments[0], float(arguments[1]))
    else:
        robots = [argument for argument in arguments if not argument.isdecimal()]
        listen(robots, int(arguments[-1]) if arguments[-1].isdecimal() else _LONG_CACHE)
    rclpy.shutdown()


if __name__ == "__main__":
    main(*sys.argv[1:])
