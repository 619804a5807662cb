# SPDX-License-Identifier: Apache-2.0
"""Look up a thousand times in one call, and transform points at each of them.

No ROS graph is needed: the buffer is filled by hand.
"""

from __future__ import annotations

import numpy as np

import coframe

SECOND = 1_000_000_000  # stamps are integer nanoseconds


def main() -> None:
    buffer = coframe.Buffer(cache=None)  # keep everything
    buffer.set("base_link", "lidar_link", coframe.Transform([0.1, 0.0, 0.3]), static=True)

    # The robot drives along x at 1 m/s and turns slowly: 11 samples over 10 s.
    stamps = np.arange(11) * SECOND + SECOND
    poses = [coframe.Transform.from_rpy([float(i), 0.0, 0.0], [0.0, 0.0, 0.05 * i]) for i in range(11)]
    for stamp, pose in zip(stamps, poses, strict=True):
        buffer.set("odom", "base_link", pose, int(stamp))

    # One call interpolates at all times; the result is a batch of shape (1000,).
    times = np.linspace(stamps[0], stamps[-1], 1000).astype(np.int64)
    path = buffer.lookup_many("odom", "lidar_link", times)
    print(f"{path.shape[0]} poses; the last one is at {path.translation[-1].round(3).tolist()} m")

    # A point 5 m in front of the lidar, expressed in odom at each of the times: (1000, 3).
    points = path @ np.array([5.0, 0.0, 0.0])
    print(f"the point moved from {points[0].round(3).tolist()} to {points[-1].round(3).tolist()} m")


if __name__ == "__main__":
    main()
