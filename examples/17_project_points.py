# SPDX-License-Identifier: Apache-2.0
"""Project points of the map into the image of a calibrated camera on a moving robot."""

from __future__ import annotations

import numpy as np

import coframe
from coframe.cameras import CameraModel
from sensor_msgs.msg import CameraInfo

STAMP = 2_000_000_000  # of the image, in nanoseconds


def main() -> None:
    buffer = coframe.Buffer()
    optical = coframe.Transform.from_rpy([0.1, 0.0, 0.5], roll=-np.pi / 2, yaw=-np.pi / 2)  # z forward, y down
    buffer.set("base_link", "camera_optical", optical, static=True)
    buffer.set("map", "base_link", coframe.Transform([1.0, 0.0, 0.0]), 1_000_000_000)
    buffer.set("map", "base_link", coframe.Transform([2.0, 0.0, 0.0]), 3_000_000_000)

    info = CameraInfo(width=640, height=480, distortion_model="plumb_bob", d=[-0.2, 0.05, 0.0, 0.0, 0.0])
    info.header.frame_id = "camera_optical"
    info.k = [500.0, 0.0, 320.0, 0.0, 500.0, 240.0, 0.0, 0.0, 1.0]
    camera = CameraModel.from_info(info)

    points = np.array([[5.0, 0.0, 0.5], [5.0, 1.0, 0.5], [-5.0, 0.0, 0.5]])
    pixels = camera.project(buffer.lookup("camera_optical", "map", STAMP) @ points)
    for point, pixel in zip(points.tolist(), pixels.round(1).tolist(), strict=True):
        print(f"{point} m -> {pixel} px")


if __name__ == "__main__":
    main()
