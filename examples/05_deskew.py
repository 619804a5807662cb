# SPDX-License-Identifier: Apache-2.0
"""Correct a lidar sweep for the motion of the robot: each point is transformed at the time it was measured.

A robot turns at 90 degrees per second next to a straight wall while its lidar measures one sweep of 0.1 s. Without
correction the wall is bent; with deskewing it is straight again.
"""

from __future__ import annotations

import numpy as np

import coframe
from coframe.sensors import deskew

SECOND = 1_000_000_000
TURN = np.radians(90.0)  # radians per second
WALL = 3.0  # meters from the robot, along y


def main() -> None:
    start, end = SECOND, SECOND + SECOND // 10
    buffer = coframe.Buffer()
    for stamp in (start, end):
        angle = TURN * (stamp - start) / SECOND
        buffer.set("odom", "lidar_link", coframe.Transform.from_rpy([0, 0, 0], [0, 0, angle]), stamp)

    # What the lidar measures: the wall y = 3 m in odom, seen from a sensor that has turned a little more at each point.
    times = np.linspace(start, end, 200).astype(np.int64)
    wall = np.column_stack([np.linspace(-2, 2, 200), np.full(200, WALL), np.zeros(200)])
    turned = -TURN * (times - start) / SECOND
    measured = np.column_stack(
        [
            np.cos(turned) * wall[:, 0] - np.sin(turned) * wall[:, 1],
            np.sin(turned) * wall[:, 0] + np.cos(turned) * wall[:, 1],
            wall[:, 2],
        ]
    )

    # All points at the stamp of the sweep's end, as if the robot had stood still.
    skewed = buffer.lookup("odom", "lidar_link", end) @ measured
    straight = deskew(measured, times, buffer, "odom", source="lidar_link")
    print(f"one transform for all points: the wall is off by up to {np.abs(skewed[:, 1] - WALL).max():.3f} m")
    print(f"deskewed:                     the wall is off by up to {np.abs(straight[:, 1] - WALL).max():.6f} m")


if __name__ == "__main__":
    main()
