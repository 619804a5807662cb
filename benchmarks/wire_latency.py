"""How long a transform is on its way between two processes, and what listening costs.

One process publishes messages of ten transforms at 1 kHz, stamped with the monotonic clock; the other stores them in a
buffer by the native reader. Latency is from before writing to being in the buffer, as a thread sees it that waits for
the buffer's change; CPU is that of a listening process without such a thread.

    python benchmarks/wire_latency.py [seconds]
"""

from __future__ import annotations

import os
import subprocess
import sys
import time

import numpy as np

import coframe
from coframe.messages import codec, find
from coframe.wire.qos import TF

RATE_HZ = 1000
TRANSFORMS = 10
DOMAIN = "97"


def message_bytes() -> bytearray:
    """A TFMessage of ten transforms; the first one's stamp is at byte 8."""
    message = find("tf2_msgs/msg/TFMessage")()
    for number in range(TRANSFORMS):
        stamped = find("geometry_msgs/msg/TransformStamped")()
        stamped.header.frame_id, stamped.child_frame_id = f"base_link_{number}", f"arm_link_{number}"
        stamped.transform.rotation.w = 1.0
        message.transforms.append(stamped)
    return bytearray(codec.serialize(message))


def publish(seconds: float) -> None:
    data = message_bytes()
    with coframe.connect("talker") as ros:
        publisher = ros.participant.publisher(ros.node, "/bench/tf", find("tf2_msgs/msg/TFMessage"), TF)
        while not publisher.matched:
            time.sleep(0.01)
        spent = []
        begin = time.monotonic_ns()
        for number in range(int(seconds * RATE_HZ)):
            left = begin + number * 1_000_000_000 // RATE_HZ - time.monotonic_ns()
            if left > 0:
                time.sleep(left / 1e9)
            now = time.monotonic_ns()
            data[8:16] = np.array([now // 1_000_000_000, now % 1_000_000_000], dtype="<u4").tobytes()
            publisher.write(bytes(data))
            spent.append(time.monotonic_ns() - now)
        p50, p99 = np.percentile(spent, [50, 99]) / 1e3
        print(f"write            p50 {p50:6.1f} us   p99 {p99:6.1f} us", flush=True)


def listen(seconds: float, *, watch: bool) -> None:
    buffer = coframe.Buffer()
    participant = coframe.wire.Participant.get()
    node = participant.add_node("/", "listener")
    participant.tf_reader(node, "/bench/tf", buffer, static=False)
    talker = subprocess.Popen([sys.executable, __file__, "--publish", str(seconds)])
    while not buffer.can_transform("base_link_0", "arm_link_0"):
        time.sleep(0.01)
    latencies = []
    cpu, begin, first = time.process_time(), time.monotonic(), buffer.statistics["messages"]
    end = begin + seconds * 0.9
    if watch:
        seen = buffer.changes
        while time.monotonic() < end:
            seen = buffer.wait_for_change(seen, 100_000_000)
            latencies.append(time.monotonic_ns() - buffer.lookup("base_link_0", "arm_link_0").stamp)
    else:
        time.sleep(seconds * 0.9)
    elapsed = time.monotonic() - begin
    busy = time.process_time() - cpu
    messages = buffer.statistics["messages"] - first
    if watch:
        p50, p99 = np.percentile(latencies, [50, 99]) / 1e3
        print(f"latency          p50 {p50:6.1f} us   p99 {p99:6.1f} us   (with a Python thread that waits)")
    else:
        print(f"listening        {100 * busy / elapsed:.1f} % of one core at {messages / elapsed:.0f} messages/s")
    talker.wait()
    participant.close()


if __name__ == "__main__":
    os.environ["ROS_DOMAIN_ID"] = DOMAIN
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    if sys.argv[1:2] == ["--publish"]:
        publish(float(sys.argv[2]))
    else:
        duration = float(sys.argv[1]) if len(sys.argv) > 1 else 5.0
        listen(duration, watch=False)
        listen(duration, watch=True)
