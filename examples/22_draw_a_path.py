# SPDX-License-Identifier: Apache-2.0
"""The path of a sensor on a turning robot, as a line in the viewer, with a label at its end.

Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

STAMPS = 1_700_000_000_000_000_000 + np.arange(0, 60) * 100_000_000


def show_scene() -> coframe.viewer.Viewer:
    """Show a robot that drives a spiral, and the path of its lidar."""
    buffer = coframe.Buffer(cache=None)
    for step, stamp in enumerate(STAMPS.tolist()):
        angle = 0.2 * step
        position = [0.05 * step * np.cos(angle), 0.05 * step * np.sin(angle), 0.0]
        buffer.set("odom", "base_link", coframe.Transform.from_rpy(position, yaw=angle + np.pi / 2), stamp)
    buffer.set("base_link", "lidar", coframe.Transform([0.3, 0.0, 0.4]), static=True)
    viewer = coframe.show(buffer, fixed="odom")
    path = buffer.lookup_many("odom", "lidar", STAMPS).translation
    viewer.scene.add_lines("path", path, color="#e5484d", line_width=4)
    viewer.scene.add_text("length", f"{np.linalg.norm(np.diff(path, axis=0), axis=1).sum():.1f} m", position=path[-1])
    return viewer


def main() -> None:
    with show_scene() as viewer:
        print(f"Open {viewer.url}.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
