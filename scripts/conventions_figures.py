# SPDX-License-Identifier: Apache-2.0
"""Draw the figures of docs/concepts/conventions.md as SVG files, with numbers computed by coframe.

Example:
    python scripts/conventions_figures.py            write docs/images/convention_*.svg
    python scripts/conventions_figures.py --check    only report files that are out of date
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
from handbook_figures import BLUE, GRAY, GREEN, ORANGE, RED, SECOND, WIDTH, Drawing, Point

from coframe import Buffer, Transform

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "images"


def a_from_b() -> Drawing:
    drawing, scale = Drawing(270), 120.0
    lidar = Transform.from_rpy([1.7, 0.3, 0.0], yaw=math.pi / 6, target="base_link", source="lidar_link")
    seen = np.array([1.2, 0.4, 0.0])
    point = lidar @ seen

    def pixel(position: np.ndarray) -> Point:
        return 80 + scale * float(position[0]), 200 - scale * float(position[1])

    drawing.arrow(pixel(np.zeros(3)), pixel(lidar.translation), GRAY, 1.5)
    drawing.axes(pixel(np.zeros(3)), 0.0, "base_link (target)")
    drawing.axes(pixel(lidar.translation), lidar.yaw, "lidar_link (source)")
    drawing.dot(pixel(point), ORANGE, 7)
    end = pixel(point)
    drawing.text((end[0] + 14, end[1] - 6), f"in lidar_link: [{seen[0]:.2f}, {seen[1]:.2f}]")
    drawing.text((end[0] + 14, end[1] + 14), f"in base_link: [{point[0]:.2f}, {point[1]:.2f}]")
    drawing.text(
        (WIDTH / 2, 255), "base_link_from_lidar_link @ point_in_lidar_link = point_in_base_link", BLUE, anchor="middle"
    )
    return drawing


def quaternion_order() -> Drawing:
    drawing = Drawing(190)
    rows = (
        (55, "x y z w", "ROS, tf2, SciPy, Eigen's coeffs(), coframe"),
        (130, "w x y z", "pytransform3d, MuJoCo, files in EuRoC's format"),
    )
    values = dict(zip("xyzw", Transform.from_rpy(yaw=math.pi / 2).quaternion, strict=True))
    for y, order, users in rows:
        for place, name in enumerate(order.split()):
            middle = 60 + 62 * place
            color = ORANGE if name == "w" else BLUE
            drawing.area(middle - 28, y - 26, 56, 46, color)
            drawing.text((middle, y - 6), name, color, anchor="middle", size=16)
            drawing.text((middle, y + 14), f"{values[name]:.4g}", anchor="middle", size=12)
        drawing.text((295, y), users, size=13)
    drawing.text((WIDTH / 2, 178), "a quarter turn about z: the same four numbers in two orders", GRAY, anchor="middle")
    return drawing


def axes() -> Drawing:
    drawing = Drawing(250)
    optical = Transform.from_matrix(np.array([[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1.0]]))
    columns = (
        (165, "body frame: base_link, lidar_link", Transform(), ("x forward", "y left", "z up")),
        (480, "optical frame: camera_optical_frame", optical, ("x right", "y down", "z forward")),
    )
    for middle, title, rotation, names in columns:
        drawing.text((middle, 28), title, anchor="middle")
        for axis, (name, color) in enumerate(zip(names, (RED, GREEN, BLUE), strict=True)):
            # An oblique view from behind: forward goes up to the right, left to the left, up goes up.
            forward, left, up = (float(value) for value in rotation.rotation[:, axis])
            end = (middle + 62 * forward - 80 * left, 130 - 48 * forward - 75 * up)
            drawing.arrow((middle, 130), end, color, 3)
            anchor = "end" if left > 0.5 else "start"
            shift = -8 if left > 0.5 else 8
            drawing.text((end[0] + shift, end[1] + (14 if up < -0.5 else -4)), name, color, anchor=anchor)
    drawing.text((WIDTH / 2, 238), "seen from behind the robot", GRAY, anchor="middle")
    return drawing


def tree() -> Drawing:
    drawing = Drawing(240)
    frames = (
        (80, "map", "fixed in the world:"),
        (240, "odom", "continuous,"),
        (410, "base_link", "fixed to"),
        (560, "lidar_link", "fixed to"),
    )
    second = ("poses may jump", "but drifts", "the robot", "the sensor")
    for (x, _, line), below in zip(frames, second, strict=True):
        drawing.text((x, 150), line, GRAY, anchor="middle", size=12)
        drawing.text((x, 167), below, GRAY, anchor="middle", size=12)
    edges = ((80, 240, "localization"), (240, 410, "odometry"), (410, 560, "static, or URDF"))
    for start, end, publisher in edges:
        drawing.arrow((start + 50, 105), (end - 55, 105))
        drawing.text(((start + end) / 2, 60), publisher, BLUE, anchor="middle", size=13)
        drawing.line([((start + end) / 2, 66), ((start + end) / 2, 100)], BLUE, 1, dashed=True)
    for x, name, _ in frames:
        drawing.box((x, 105), name)
    drawing.text(
        (WIDTH / 2, 222), "parent -> child: each frame has one parent, and one publisher", GRAY, anchor="middle"
    )
    return drawing


def time() -> Drawing:
    drawing = Drawing(270)
    buffer = Buffer()
    stamps = {"odom -> base_link": [1.0, 2.0, 3.0, 4.0], "base_link -> arm": [0.5, 1.5, 2.5, 3.5]}
    for name, seconds in stamps.items():
        parent, child = name.split(" -> ")
        for second in seconds:
            buffer.set(parent, child, Transform([second, 0, 0]), int(second * SECOND))
    common = buffer.latest_common_time("odom", "arm") / SECOND

    def x_of(second: float) -> float:
        return 150 + 82 * second

    for y, (name, seconds) in zip((70, 130), stamps.items(), strict=True):
        drawing.text((15, y + 5), name, size=13)
        drawing.line([(x_of(0), y), (x_of(4.8), y)], GRAY, 1)
        for second in seconds:
            drawing.dot((x_of(second), y), BLUE, 6)
    for second, color, words, line in (
        (1.8, GREEN, "lookup at 1.8 s:", "interpolated"),
        (common, ORANGE, "lookup at time 0:", "latest common time"),
        (4.4, RED, "lookup at now():", "extrapolation error"),
    ):
        drawing.line([(x_of(second), 45), (x_of(second), 185)], color, 2, dashed=True)
        anchor = "start" if second > 4 else "end" if second > 3 else "middle"
        drawing.text((x_of(second), 205), words, color, anchor=anchor, size=13)
        drawing.text((x_of(second), 223), line, color, anchor=anchor, size=13)
    drawing.text((WIDTH / 2, 258), "dots: received transforms; time runs to the right", GRAY, anchor="middle")
    return drawing


FIGURES = {
    "convention_a_from_b": ("A point expressed in two frames", a_from_b),
    "convention_quaternion": ("The two orders of quaternions", quaternion_order),
    "convention_axes": ("Axes of body frames and optical frames", axes),
    "convention_tree": ("The frames of REP-105", tree),
    "convention_time": ("Lookups at three times", time),
}


def main() -> int:
    """Write the figures, or report those that are out of date; return the exit status."""
    outdated = []
    for name, (title, draw) in FIGURES.items():
        path, text = FOLDER / f"{name}.svg", draw().svg(title)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            outdated.append(path.name)
            if "--check" not in sys.argv:
                path.write_text(text, encoding="utf-8")
    print(f"{'out of date' if '--check' in sys.argv else 'written'}: {', '.join(outdated) or 'none'}")
    return 1 if outdated and "--check" in sys.argv else 0


if __name__ == "__main__":
    sys.exit(main())
