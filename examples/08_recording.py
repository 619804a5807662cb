# SPDX-License-Identifier: Apache-2.0
"""Ask a recording where a frame was, at any time, without ROS.

Give the path of a rosbag2 folder, an MCAP file or a ROS 1 bag; without one the example writes a short recording first.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np

import coframe
from coframe.bags import Writer
from geometry_msgs.msg import TransformStamped
from rclpy.serialization import serialize_message
from tf2_msgs.msg import TFMessage

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND


def write_example(folder: Path) -> Path:
    """Write ten seconds of a robot that drives along x at 1 m/s, 10 transforms per second."""
    with Writer(folder) as writer:
        topic = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for step in range(101):
            stamp = START + step * SECOND // 10
            transform = TransformStamped()
            transform.header.frame_id, transform.child_frame_id = "odom", "base_link"
            transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(stamp, SECOND)
            transform.transform.translation.x = 0.1 * step
            writer.write(topic, serialize_message(TFMessage(transforms=[transform])), received=stamp)
    return folder


def report(path: Path) -> None:
    """Print what the recording contains and where its frames moved."""
    with coframe.open_bag(path) as recording:
        print(f"{recording.duration / SECOND:.1f} s, frames: {', '.join(f.name for f in recording.buffer.frames())}")
        for edge in recording.buffer.edges():
            if edge.static or not edge.parent:
                continue
            times = np.linspace(edge.oldest, edge.newest, 200).astype(np.int64)
            path_ = recording.buffer.lookup_many(edge.parent, edge.child, times).translation
            length = np.linalg.norm(np.diff(path_, axis=0), axis=1).sum()
            print(f"{edge.parent} -> {edge.child}: {edge.samples} transforms, moved {length:.2f} m")


def main() -> None:
    if len(sys.argv) > 1:
        report(Path(sys.argv[1]))
        return
    with tempfile.TemporaryDirectory() as folder:
        report(write_example(Path(folder) / "run"))


if __name__ == "__main__":
    main()
