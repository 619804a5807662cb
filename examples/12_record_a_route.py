# SPDX-License-Identifier: Apache-2.0
"""Clicks on a map place waypoints; buttons undo the last one, and print the route.

No ROS graph is needed. Open the printed address in a browser; Ctrl-C ends the program.
"""

from __future__ import annotations

import numpy as np

import coframe

CELL = 0.05  # meters


def floor_plan() -> np.ndarray:
    """Return a room with a wall in it: white is free, black is a wall, (rows, columns, 3)."""
    plan = np.full((120, 160, 3), 235, np.uint8)
    plan[[0, -1]] = plan[:, [0, -1]] = 30
    plan[60:, 80] = 30
    return plan


def main() -> None:
    buffer = coframe.Buffer()
    buffer.set("map", "base_link", coframe.Transform([-3.0, -2.0, 0.0]), static=True)
    with coframe.show(buffer, fixed="map") as viewer:
        plan = floor_plan()
        floor = viewer.scene.add_image("floor", plan, width=plan.shape[1] * CELL)
        length = viewer.gui.add_text("Length", initial_value="0.00 m", disabled=True)
        undo = viewer.gui.add_button("Undo")
        finish = viewer.gui.add_button("Print the route")
        route: list[tuple[float, float, float]] = []

        def draw() -> None:
            if "route" in viewer.scene.names:
                viewer.scene.remove("route")
            viewer.scene.add_frame("route", axes_length=0.001)
            for number, point in enumerate(route, 1):
                viewer.scene.add_sphere(f"route/{number}", 0.08, color="#e5484d", position=point)
            if len(route) > 1:
                viewer.scene.add_lines("route/line", np.array(route), color="#e5484d", line_width=3)
            steps = np.diff(np.array(route).reshape(-1, 3), axis=0)
            length.value = f"{np.linalg.norm(steps, axis=1).sum():.2f} m"

        @floor.on_click
        def add(event: coframe.viewer.ClickEvent) -> None:
            x, y, _ = event.position
            route.append((float(x), float(y), 0.0))
            draw()

        @undo.on_click
        def remove_last(_event: object) -> None:
            if route:
                route.pop()
                draw()

        @finish.on_click
        def print_route(_event: object) -> None:
            print(" -> ".join(f"({x:.1f}, {y:.1f})" for x, y, _ in route) + f": {length.value}", flush=True)

        print(f"Open {viewer.url} and click the floor.", flush=True)
        viewer.wait()


if __name__ == "__main__":
    main()
