# SPDX-License-Identifier: Apache-2.0
"""Where was the lidar two seconds ago, seen from where the robot is now?"""

from __future__ import annotations

import coframe

SECOND = 1_000_000_000


def main() -> None:
    buffer = coframe.Buffer(cache=None)
    for second in range(1, 6):  # the robot drives at 0.5 m/s
        buffer.set("odom", "base_link", coframe.Transform([0.5 * second, 0.0, 0.0]), second * SECOND)
    buffer.set("base_link", "lidar", coframe.Transform([0.1, 0.0, 0.3]), static=True)

    now = buffer.lookup("base_link", "lidar", 5 * SECOND)
    # "odom" is the frame that did not move between the two times.
    before = buffer.lookup("base_link", "lidar", 5 * SECOND, fixed="odom", source_time=3 * SECOND)
    print(f"lidar now: x = {now.x:.2f} m; two seconds ago: x = {before.x:.2f} m")


if __name__ == "__main__":
    main()
