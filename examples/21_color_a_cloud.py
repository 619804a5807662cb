# SPDX-License-Identifier: Apache-2.0
"""A cloud whose points have colors by height, in the frame of the lidar that measured it.

Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe


def show_scene() -> coframe.viewer.Viewer:
    """Show hills around a lidar."""
    buffer = coframe.Buffer()
    buffer.set("map", "lidar", coframe.Transform([0.0, 0.0, 1.5]), static=True)
    viewer = coframe.show(buffer, fixed="map")
    x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(-4, 4, 120), np.linspace(-4, 4, 120)))
    height = 0.6 * np.sin(x) * np.cos(y)
    part = (height - height.min()) / np.ptp(height)
    colors = np.stack([255 * part, 120 + 80 * part, 255 * (1 - part)], axis=1).astype(np.uint8)
    points = np.stack([x, y, height - 1.5], axis=1)
    viewer.scene.add_points("hills", points, colors, point_size=0.05, frame="lidar")
    return viewer


def main() -> None:
    with show_scene() as viewer:
        print(f"Open {viewer.url}.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
