# SPDX-License-Identifier: Apache-2.0
"""Click two points of a cloud in the viewer, and read their distance.

No ROS graph is needed. Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe


def walls() -> np.ndarray:
    """Return points on two walls of a room, (N, 3), as a lidar in its middle would measure them."""
    along, up = (axis.ravel() for axis in np.meshgrid(np.linspace(-2, 2, 81), np.linspace(0, 2, 41)))
    ahead = np.stack([np.full_like(along, 2.0), along, up], axis=1)
    left = np.stack([along, np.full_like(along, 2.0), up], axis=1)
    return np.concatenate([ahead, left])


def main() -> None:
    buffer = coframe.Buffer()
    buffer.set("map", "lidar", coframe.Transform([1.0, 0.0, 0.5]), static=True)

    with coframe.show(buffer, fixed="map") as viewer:
        cloud = viewer.scene.add_points("cloud", walls(), color="#30a46c", point_size=0.04, frame="lidar")
        ends: list[np.ndarray] = []

        @cloud.on_click
        def measure(event: coframe.viewer.ClickEvent) -> None:
            if len(ends) != 1:  # a new measurement; what is below "measure" is removed with it
                ends.clear()
                if "measure" in viewer.scene:
                    viewer.scene.remove("measure")
                viewer.scene.add_frame("measure", axes_length=0.0, frame=event.frame)
            ends.append(event.position)
            viewer.scene.add_sphere(f"measure/{len(ends)}", 0.05, color="#e5484d", position=event.position)
            if len(ends) == 2:
                distance = float(np.linalg.norm(ends[1] - ends[0]))
                above = (ends[0] + ends[1]) / 2 + np.array([0.0, 0.0, 0.2])
                viewer.scene.add_lines("measure/line", ends, color="#e5484d", line_width=4)
                viewer.scene.add_text("measure/distance", f"{distance:.2f} m", position=above)
                print(f"{distance:.2f} m", flush=True)

        print(f"Open {viewer.url} and click two points of the cloud.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
