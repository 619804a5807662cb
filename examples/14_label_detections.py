# SPDX-License-Identifier: Apache-2.0
"""Detections in a camera image are shown one by one, and a drop-down gives each of them a label.

No ROS graph is needed. Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

POSITIONS = [(2.0, 0.6, 0.2), (2.5, -0.4, 0.5), (3.0, 0.1, 0.9)]  # in the frame of the camera, meters
COLORS = [(229, 72, 77), (48, 164, 108), (63, 123, 245)]


def crop(color: tuple[int, int, int]) -> np.ndarray:
    """Return the part of the camera image around a detection, (rows, columns, 3)."""
    rows, columns = np.indices((48, 64))
    inside = (rows - 24) ** 2 + (columns - 32) ** 2 < 18**2
    return np.where(inside[..., np.newaxis], np.array(color, np.uint8), np.uint8(40)).astype(np.uint8)


def main() -> None:
    buffer = coframe.Buffer()
    buffer.set("base_link", "camera", coframe.Transform([0.2, 0.0, 0.4]), static=True)
    buffer.set("base_link", "rack", coframe.Transform([3.2, 0.0, 0.0]), static=True)
    with coframe.show(buffer, fixed="base_link") as viewer:
        labels = ["unknown"] * len(POSITIONS)
        boxes = [
            viewer.scene.add_box(f"detection/{i}", (0.3, 0.3, 0.3), color=color, frame="camera", position=position)
            for i, (position, color) in enumerate(zip(POSITIONS, COLORS, strict=True))
        ]
        picture = viewer.gui.add_image("Detection", crop(COLORS[0]))
        label = viewer.gui.add_dropdown("Label", ["unknown", "pallet", "person", "door"])
        shown = 0

        def show(number: int) -> None:
            nonlocal shown
            shown = number
            picture.image = crop(COLORS[number])
            label.value = labels[number]

        for number, box in enumerate(boxes):
            box.on_click(lambda _event, number=number: show(number))

        @label.on_update
        def save(_event: object) -> None:
            labels[shown] = label.value
            print(", ".join(labels), flush=True)

        print(f"Open {viewer.url} and click the boxes.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
