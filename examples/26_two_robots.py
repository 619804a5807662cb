# SPDX-License-Identifier: Apache-2.0
"""Two robots in one map, each with a prefix, and the distance between them.

Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

POSES = {"robot1": ([0.0, 0.0, 0.0], 0.0), "robot2": ([2.0, 1.5, 0.0], 2.0)}


def show_scene() -> coframe.viewer.Viewer:
    """Show the frames of both robots, and a line between their lidars."""
    buffer = coframe.Buffer()
    for name, (position, yaw) in POSES.items():
        buffer.set("map", f"{name}/base_link", coframe.Transform.from_rpy(position, yaw=yaw), static=True)
        buffer.set(f"{name}/base_link", f"{name}/lidar", coframe.Transform([0.2, 0.0, 0.4]), static=True)
    viewer = coframe.show(buffer, fixed="map")
    for name, color in zip(POSES, ("#3f7bf5", "#30a46c"), strict=True):
        viewer.scene.add_box(f"{name} body", (0.6, 0.4, 0.25), color=color, frame=f"{name}/base_link")
    ends = np.array([buffer.lookup("map", f"{name}/lidar").translation for name in POSES])
    viewer.scene.add_lines("between", ends, color="#e5484d", line_width=3)
    distance = np.linalg.norm(ends[1] - ends[0])
    viewer.scene.add_text("distance", f"{distance:.2f} m", position=ends.mean(axis=0) + np.array([0.0, 0.0, 0.2]))
    return viewer


def main() -> None:
    with show_scene() as viewer:
        print(f"Open {viewer.url}.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
