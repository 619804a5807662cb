# SPDX-License-Identifier: Apache-2.0
"""What a camera on a mast sees: its image plane, and the edges of its field of view.

Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

WIDTH, HEIGHT, FOCAL = 640, 480, 500.0  # pixels
DEPTH = 1.5  # meters


def show_scene() -> coframe.viewer.Viewer:
    """Show the field of view in the optical frame of the camera: z forward, x right, y down."""
    buffer = coframe.Buffer()
    mount = coframe.Transform.from_rpy([0.0, 0.0, 1.2], roll=-np.pi / 2 - 0.3, yaw=-np.pi / 2)
    buffer.set("base_link", "camera_optical", mount, static=True)
    viewer = coframe.show(buffer, fixed="base_link")
    x, y = DEPTH * WIDTH / 2 / FOCAL, DEPTH * HEIGHT / 2 / FOCAL
    corners = np.array([[-x, -y, DEPTH], [x, -y, DEPTH], [x, y, DEPTH], [-x, y, DEPTH]])
    edges = [*((np.zeros(3), corner) for corner in corners), *zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    viewer.scene.add_lines("frustum", np.array(edges), color="#f5a623", line_width=3, frame="camera_optical")
    rows, columns = np.indices((48, 64))
    image = np.where(((rows // 8 + columns // 8) % 2)[..., np.newaxis], 220, 60).repeat(3, axis=2).astype(np.uint8)
    viewer.scene.add_image("image", image, width=2 * x, frame="camera_optical", position=(0.0, 0.0, DEPTH))
    return viewer


def main() -> None:
    with show_scene() as viewer:
        print(f"Open {viewer.url}.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
