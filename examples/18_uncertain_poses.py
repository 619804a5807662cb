# SPDX-License-Identifier: Apache-2.0
"""Combine a pose from odometry with one from GPS, and carry the covariance to a sensor."""

from __future__ import annotations

import numpy as np

from coframe import Transform


def main() -> None:
    odometry = Transform([3.0, 0.0, 0.0], target="map", source="base_link")
    odometry = odometry.with_covariance(np.diag([0.01, 0.04, 0.0, 0.0, 0.0, 0.01]))
    gps = odometry.replace(translation=[3.1, 0.0, 0.0]).with_covariance(np.diag([0.01, 0.01, 0.0, 0.0, 0.0, 1.0]))
    fused = odometry.fuse(gps)
    lidar = fused @ Transform([1.0, 0.0, 0.0], target="base_link", source="lidar")

    for name, pose in (("odometry", odometry), ("GPS", gps), ("fused", fused), ("lidar", lidar)):
        deviations = np.sqrt(np.diag(pose.covariance)[:2])
        print(f"{name:8} x = {pose.x:.2f} +- {deviations[0]:.2f} m, y = {pose.y:.2f} +- {deviations[1]:.2f} m")


if __name__ == "__main__":
    main()
