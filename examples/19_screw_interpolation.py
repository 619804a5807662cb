# SPDX-License-Identifier: Apache-2.0
"""A robot on a circle, between two samples: the straight line of tf2, and the arc that the robot drove."""

from __future__ import annotations

import numpy as np

import coframe

SECOND = 1_000_000_000
SPEED, TURN = 1.0, 1.0  # meters and radians per second


def main() -> None:
    times = np.linspace(0.0, 1.0, 11)
    for interpolation in ("decoupled", "screw"):
        buffer = coframe.Buffer(cache=None, interpolation=interpolation)
        for second in (0, 1):
            driven = coframe.Transform.exp([SPEED * second, 0.0, 0.0, 0.0, 0.0, TURN * second])
            buffer.set("odom", "base_link", driven, (second + 1) * SECOND)
        found = buffer.lookup_many("odom", "base_link", ((times + 1) * SECOND).astype(np.int64)).translation
        true = np.stack([np.sin(times), 1 - np.cos(times)], axis=1)  # a circle with a radius of 1 m
        error = np.linalg.norm(found[:, :2] - true, axis=1).max()
        print(f"{interpolation:9}: up to {1000 * error:.1f} mm from the circle")


if __name__ == "__main__":
    main()
