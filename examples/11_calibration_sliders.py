# SPDX-License-Identifier: Apache-2.0
"""Sliders move the mount of a camera; its cloud follows until it lies on the floor.

No ROS graph is needed. Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

TRUE_MOUNT = coframe.Transform.from_rpy([0.3, 0.0, 0.8], [0.0, 0.35, 0.0])  # what the calibration has to find


def floor_seen_by_camera() -> np.ndarray:
    """Return points of the floor in front of the robot, expressed in the camera, (N, 3)."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.linspace(0.5, 3.0, 60), np.linspace(-1.0, 1.0, 50)))
    return TRUE_MOUNT.inverse() @ np.stack([x, y, np.zeros_like(x)], axis=1)


def main() -> None:
    buffer = coframe.Buffer()
    buffer.set("base_link", "camera_link", coframe.Transform([0.3, 0.0, 0.8]), static=True)

    with coframe.show(buffer, fixed="base_link") as viewer:
        points = floor_seen_by_camera()
        viewer.scene.add_points("cloud", points, color="#3f7bf5", frame="camera_link")

        with viewer.gui.add_folder("Camera mount"):
            height = viewer.gui.add_slider("Height (m)", min=0.0, max=1.5, step=0.01, initial_value=0.8)
            pitch = viewer.gui.add_slider("Pitch (rad)", min=-0.8, max=0.8, step=0.01, initial_value=0.0)
        error = viewer.gui.add_text("Distance to the floor", disabled=True)
        save = viewer.gui.add_button("Print the transform")

        def update(_event: object = None) -> None:
            mount = coframe.Transform.from_rpy([0.3, 0.0, height.value], [0.0, pitch.value, 0.0])
            buffer.set("base_link", "camera_link", mount, static=True)  # the cloud moves with its frame
            error.value = f"{np.abs((mount @ points)[:, 2]).mean():.3f} m"

        height.on_update(update)
        pitch.on_update(update)
        update()

        @save.on_click
        def print_transform(_event: object) -> None:
            print(f"camera_link: height {height.value:.2f} m, pitch {pitch.value:.2f} rad, {error.value}", flush=True)

        print(f"Open {viewer.url} and move the sliders.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
