# SPDX-License-Identifier: Apache-2.0
"""Odometry logs as recordings: lines with seconds, x, y in meters and yaw in radians."""

import math
from collections.abc import Iterator
from pathlib import Path

from coframe.bags import RecordingFormat
from coframe.messages import Message, find

TransformStamped = find("geometry_msgs/msg/TransformStamped")
TFMessage = find("tf2_msgs/msg/TFMessage")


class OdometryLog(RecordingFormat):
    """Files such as drive.odom."""

    name = "odometry log"
    suffixes = (".odom",)

    def messages(self, path: Path) -> Iterator[tuple[str, int, Message]]:
        """Yield topic, receive time in nanoseconds, and message."""
        for line in path.read_text(encoding="utf-8").splitlines():
            seconds, x, y, yaw = map(float, line.split())
            stamp = round(seconds * 1e9)
            transform = TransformStamped(child_frame_id="base_link")
            transform.header.frame_id = "odom"
            transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(stamp, 1_000_000_000)
            transform.transform.translation.x, transform.transform.translation.y = x, y
            transform.transform.rotation.z, transform.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
            yield "/tf", stamp, TFMessage(transforms=[transform])
