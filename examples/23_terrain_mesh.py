# SPDX-License-Identifier: Apache-2.0
"""A mesh of a terrain with a box and a sphere on it.

Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

SIZE = 40  # vertices along each side


def show_scene() -> coframe.viewer.Viewer:
    """Show a terrain of triangles."""
    buffer = coframe.Buffer()
    buffer.set("map", "base_link", coframe.Transform([0.0, 0.0, 1.0]), static=True)
    viewer = coframe.show(buffer, fixed="map")
    x, y = np.meshgrid(np.linspace(-3, 3, SIZE), np.linspace(-3, 3, SIZE))
    vertices = np.stack([x, y, 0.8 * np.exp(-(x**2 + y**2) / 3)], axis=2).reshape(-1, 3)
    corner = (np.arange(SIZE - 1)[:, np.newaxis] * SIZE + np.arange(SIZE - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + SIZE], axis=1)
    upper = np.stack([corner + 1, corner + SIZE + 1, corner + SIZE], axis=1)
    viewer.scene.add_mesh("terrain", vertices, np.concatenate([lower, upper]), color="#8fb573")
    viewer.scene.add_box("box", (0.5, 0.5, 0.5), color="#e5484d", position=(2.0, -1.0, 0.4))
    viewer.scene.add_sphere("ball", 0.3, color="#3f7bf5", position=(0.0, 0.0, 1.1))
    return viewer


def main() -> None:
    with show_scene() as viewer:
        print(f"Open {viewer.url}.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
