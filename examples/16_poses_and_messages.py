# SPDX-License-Identifier: Apache-2.0
"""Convert messages to transforms, compute with them, and convert back."""

from __future__ import annotations

import coframe
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry


def main() -> None:
    odometry = Odometry(child_frame_id="base_link")
    odometry.header.frame_id = "odom"
    odometry.pose.pose.position.x = 2.0
    robot = coframe.Transform(odometry)
    print(robot)

    goal = coframe.Transform.from_rpy([1.0, 0.0, 0.0], yaw=0.5).to_msg(PoseStamped, frame="base_link", stamp=5)
    in_odom = robot @ goal  # a PoseStamped, too
    print(f"goal in {in_odom.header.frame_id}: x = {in_odom.pose.position.x} m")


if __name__ == "__main__":
    main()
