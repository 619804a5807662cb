# SPDX-License-Identifier: Apache-2.0
"""Draw the figures of the handbook as SVG files, with numbers computed by coframe.

Example:
    python scripts/handbook_figures.py            write docs/handbook/*.svg
    python scripts/handbook_figures.py --check    only report files that are out of date
"""

from __future__ import annotations

import itertools
import math
import sys
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from coframe import Buffer, Transform

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "handbook"
SECOND = 1_000_000_000
WIDTH = 640
RED, GREEN, BLUE, ORANGE, GRAY, BLACK = "#c62828", "#2e7d32", "#1565c0", "#e07000", "#8a8f98", "#22262b"
Point = tuple[float, float]


class Drawing:
    """A drawing in pixels, x to the right and y down."""

    def __init__(self, height: int) -> None:
        self.height = height
        self.parts: list[str] = []

    def line(self, points: Sequence[Point], color: str = BLACK, width: float = 2, *, dashed: bool = False) -> None:
        """Draw connected lines through points."""
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dashes = ' stroke-dasharray="5 4"' if dashed else ""
        self.parts.append(f'<polyline points="{text}" fill="none" stroke="{color}" stroke-width="{width:g}"{dashes}/>')

    def arrow(self, start: Point, end: Point, color: str = BLACK, width: float = 2) -> None:
        """Draw an arrow."""
        self.line([start, end], color, width)
        angle = math.atan2(end[1] - start[1], end[0] - start[0])
        sides = [(end[0] - 9 * math.cos(angle + turn), end[1] - 9 * math.sin(angle + turn)) for turn in (0.45, -0.45)]
        self.line([sides[0], end, sides[1]], color, width)

    def dot(self, at: Point, color: str = BLACK, radius: float = 4) -> None:
        """Draw a filled circle."""
        self.parts.append(f'<circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{radius:g}" fill="{color}"/>')

    def cross(self, at: Point, color: str = BLACK, radius: float = 5) -> None:
        """Draw a cross, which differs from a dot also without color."""
        for sign in (1, -1):
            ends = [(at[0] - radius, at[1] - sign * radius), (at[0] + radius, at[1] + sign * radius)]
            self.line(ends, color, 2.5)

    def area(self, x: float, y: float, width: float, height: float, color: str) -> None:
        """Draw a pale rectangle from its upper left corner."""
        self.parts.append(
            f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{color}"'
            ' fill-opacity="0.15"/>'
        )

    def text(self, at: Point, words: str, color: str = BLACK, *, anchor: str = "start", size: int = 14) -> None:
        """Write words, with their baseline at a point."""
        self.parts.append(
            f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" fill="{color}" text-anchor="{anchor}" font-size="{size}">'
            f"{escape(words)}</text>"
        )

    def box(self, at: Point, words: str, color: str = BLUE) -> None:
        """Draw a box with a name, centerd at a point."""
        half = 4.3 * len(words) + 8
        self.parts.append(
            f'<rect x="{at[0] - half:.1f}" y="{at[1] - 14:.1f}" width="{2 * half:.1f}" height="28" rx="6" fill="#fff"'
            f' stroke="{color}" stroke-width="2"/>'
        )
        self.text((at[0], at[1] + 5), words, anchor="middle")

    def axes(self, at: Point, angle: float, name: str, length: float = 55) -> None:
        """Draw a frame of the plane with its x and y axes; the angle is anticlockwise in radians."""
        for turn, color in ((0.0, RED), (math.pi / 2, GREEN)):
            end = (at[0] + length * math.cos(angle + turn), at[1] - length * math.sin(angle + turn))
            self.arrow(at, end, color, 3)
        self.text((at[0] - 4, at[1] + 20), name, anchor="middle")

    def svg(self, title: str) -> str:
        """Return the drawing as the text of an SVG file."""
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}" width="{WIDTH}"'
            f' font-family="sans-serif" role="img"><title>{escape(title)}</title>\n'
            f'<rect width="{WIDTH}" height="{self.height}" rx="8" fill="#fff"/>\n'
        )
        return head + "\n".join(self.parts) + "\n</svg>\n"


def why_frames() -> Drawing:
    drawing, scale = Drawing(260), 130.0
    lidar = Transform.from_rpy([1.6, 0.35, 0.0], yaw=0.6)
    point = np.array([3.2, 1.45, 0.0])

    def pixel(position: Sequence[float]) -> Point:
        return 90 + scale * float(position[0]), 220 - scale * float(position[1])

    seen = lidar.inverse() @ point
    for origin in ([0.0, 0.0, 0.0], lidar.translation):
        drawing.line([pixel(origin), pixel(point)], GRAY, 1.5, dashed=True)
    drawing.axes(pixel([0, 0]), 0.0, "base_link")
    drawing.axes(pixel(lidar.translation), lidar.yaw, "lidar_link")
    drawing.dot(pixel(point), ORANGE, 7)
    end = pixel(point)
    drawing.text((end[0] - 12, end[1] - 1), "one obstacle", ORANGE, anchor="end")
    drawing.text((end[0] + 10, end[1] + 65), f"base_link: [{point[0]:.2f}, {point[1]:.2f}]", anchor="middle")
    drawing.text((end[0] + 10, end[1] + 85), f"lidar_link: [{seen[0]:.2f}, {seen[1]:.2f}]", anchor="middle")
    return drawing


def rotations() -> Drawing:
    drawing = Drawing(250)
    turn_z, turn_x = Transform.from_rpy(yaw=math.pi / 2), Transform.from_rpy(roll=math.pi / 2)
    columns = (
        (100, "before", Transform()),
        (310, "z, then the new x axis", turn_z @ turn_x),
        (520, "z, then the fixed x axis", turn_x @ turn_z),
    )
    for middle, title, rotation in columns:
        drawing.text((middle, 28), title, anchor="middle")
        for axis, (name, color) in enumerate(zip("xyz", (RED, GREEN, BLUE), strict=True)):
            x, y, z = (float(value) for value in rotation.rotation[:, axis])
            # An oblique view: x towards the viewer and to the left, y to the right, z up.
            end = (middle + 80 * y - 48 * x, 150 - 80 * z + 40 * x)
            drawing.arrow((middle, 150), end, color, 3)
            drawing.text((end[0] + (8 if y > -0.5 else -16), end[1] + (14 if x > 0.5 else -4)), name, color)
    drawing.text((WIDTH / 2, 235), "two turns of 90 degrees, in the same order of names", GRAY, anchor="middle")
    return drawing


def static_and_dynamic() -> Drawing:
    drawing = Drawing(230)
    joins = 380.0
    for y, name in ((60, "/tf_static"), (120, "/tf"), (180, "a listener")):
        drawing.text((20, y + 5), name)
        drawing.arrow((110, y), (620, y), GRAY, 1.5)
    drawing.dot((130, 60), BLUE, 7)
    drawing.text((145, 50), "sent once, then stored", BLUE)
    for number in range(24):
        drawing.dot((130 + 20 * number, 120), ORANGE if 130 + 20 * number < joins else GREEN)
    drawing.text((130, 148), "sent before it joined: lost", ORANGE)
    drawing.line([(joins, 35), (joins, 205)], BLACK, 1.5, dashed=True)
    drawing.text((joins + 6, 215), "joins")
    drawing.arrow((137, 66), (joins - 4, 174), BLUE)
    for number in range(1, 4):
        drawing.arrow((joins - 10 + 60 * number, 126), (joins - 10 + 60 * number, 174), GREEN)
    drawing.text((joins - 10, 200), "stored, delivered late", BLUE, anchor="end")
    return drawing


def target_and_source() -> Drawing:
    drawing = Drawing(230)
    base, camera, point = (90.0, 180.0), (360.0, 120.0), (540.0, 50.0)
    drawing.axes(base, 0.0, "base_link (target)")
    drawing.axes(camera, 0.35, "")
    drawing.text((camera[0] + 20, camera[1] + 16), "camera_link (source)")
    drawing.dot(point, ORANGE, 7)
    drawing.line([camera, point], GRAY, 1.5, dashed=True)
    drawing.line([base, point], GRAY, 1.5, dashed=True)
    drawing.arrow((base[0] + 8, base[1] - 6), (camera[0] - 8, camera[1] + 4), BLUE, 2.5)
    drawing.text((250, 180), "the pose of the source", BLUE)
    drawing.text((250, 198), "relative to the target", BLUE)
    drawing.text((320, 30), "point: source numbers in,", ORANGE, anchor="middle")
    drawing.text((320, 48), "target numbers out", ORANGE, anchor="middle")
    return drawing


def _arm_angles(start: float, end: float, step: float) -> list[tuple[float, float]]:
    count = round((end - start) / step) + 1
    return [(start + k * step, 0.5 * math.sin(2 * math.pi * 0.2 * (start + k * step))) for k in range(count)]


def interpolation() -> Drawing:
    drawing = Drawing(250)
    buffer = Buffer()
    for time, angle in _arm_angles(1.0, 4.0, 0.5):
        buffer.set("base_link", "link1", Transform.from_rpy(yaw=angle), round(time * SECOND))

    def pixel(time: float, angle: float) -> Point:
        return 60 + 110 * time, 120 - 140 * angle

    drawing.area(60, 30, 110, 180, GRAY)
    drawing.area(pixel(4.0, 0)[0], 30, 620 - pixel(4.0, 0)[0], 180, ORANGE)
    drawing.arrow((60, 210), (620, 210), GRAY, 1.5)
    drawing.line([pixel(t, a) for t, a in _arm_angles(0.0, 5.0, 0.1)], GRAY, 1.5, dashed=True)
    stored = [pixel(t, a) for t, a in _arm_angles(1.0, 4.0, 0.5)]
    drawing.line(stored, BLUE)
    for at in stored:
        drawing.dot(at, BLUE)
    found = buffer.lookup("base_link", "link1", round(2.2 * SECOND)).yaw
    drawing.dot(pixel(2.2, found), GREEN, 6)
    drawing.line([(pixel(2.2, 0)[0], 210), pixel(2.2, found)], GREEN, 1.5, dashed=True)
    drawing.text((pixel(2.2, 0)[0] + 8, 170), "interpolated", GREEN)
    drawing.text((115, 50), "before the cache", anchor="middle", size=12)
    drawing.text((560, 50), "into the future", anchor="middle", size=12)
    for column in (115, 560):
        drawing.text((column, 66), "error", RED, anchor="middle", size=12)
    drawing.text((pixel(4.0, 0)[0], 232), "newest stamp = Time()", BLUE, anchor="middle")
    drawing.text((60, 232), "time", GRAY)
    return drawing


def sensors() -> Drawing:
    drawing = Drawing(300)
    right, late = Transform.from_rpy([0.9, 0.0, 0.0], yaw=0.0), Transform.from_rpy([0.88, 0.13, 0.0], yaw=0.25)
    angles = np.linspace(-0.55, 0.55, 13)
    ranges = 1.6 / np.cos(angles)  # a wall 1.6 m in front of the sensor
    points = np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(13)])

    def pixel(position: Sequence[float]) -> Point:
        return 60 + 200 * float(position[0]), 180 - 100 * float(position[1])

    drawing.line([pixel([2.5, -1.1]), pixel([2.5, 1.1])], GRAY, 7)
    for position in right @ points:
        drawing.dot(pixel(position), BLUE, 4.5)
    for position in late @ points:
        drawing.cross(pixel(position), ORANGE)
    drawing.axes(pixel([0, 0]), 0.0, "base_link", 40)
    drawing.line([pixel([0, 0]), pixel(right.translation)], BLACK, 3)
    drawing.axes(pixel(right.translation), 0.0, "lidar on the gripper", 40)
    drawing.text((20, 30), "at the stamp of the scan: the points (dots) are on the wall", BLUE)
    drawing.text((20, 50), "latest transform, 0.1 s later: the wall (crosses) is turned", ORANGE)
    return drawing


def _tree(drawing: Drawing, nodes: dict[str, Point], edges: Sequence[tuple[str, str, str]]) -> None:
    for parent, child, color in edges:
        (x, y), (to_x, to_y) = nodes[parent], nodes[child]
        drawing.arrow((x, y + 14), (to_x, to_y - 15), color)
    for name, at in nodes.items():
        drawing.box(at, name)


def complete_tree() -> Drawing:
    drawing = Drawing(470)
    chain = ("world", "map", "odom", "base_link", "link1", "link2", "end_effector", "camera_link")
    nodes = {name: (320.0, 30 + 58.0 * number) for number, name in enumerate(chain)}
    nodes |= {"imu_link": (130.0, 262.0), "lidar_link": (510.0, 262.0)}
    static = {("world", "map"), ("end_effector", "camera_link"), ("base_link", "imu_link"), ("base_link", "lidar_link")}
    edges = [*itertools.pairwise(chain), ("base_link", "imu_link"), ("base_link", "lidar_link")]
    _tree(drawing, nodes, [(a, b, BLUE if (a, b) in static else ORANGE) for a, b in edges])
    drawing.text((20, 30), "static, /tf_static", BLUE)
    drawing.text((20, 52), "dynamic, /tf", ORANGE)
    drawing.text((400, 122), "localization: may jump", GRAY)
    drawing.text((400, 180), "odometry: continuous, drifts", GRAY)
    drawing.text((400, 378), "joints", GRAY)
    return drawing


def urdf() -> Drawing:
    drawing = Drawing(190)
    nodes = {"base_link": (75.0, 60.0), "link1": (235.0, 60.0), "link2": (385.0, 60.0), "end_effector": (550.0, 60.0)}
    joints = (("base_link", "link1", "joint1"), ("link1", "link2", "joint2"), ("link2", "end_effector", "tip"))
    for parent, child, joint in joints:
        start, end = nodes[parent][0] + 4.3 * len(parent) + 8, nodes[child][0] - 4.3 * len(child) - 9
        drawing.arrow((start, 60), (end, 60), BLUE if joint == "tip" else ORANGE)
        drawing.text(((start + end) / 2, 45), joint, anchor="middle", size=12)
    for name, at in nodes.items():
        drawing.box(at, name)
    drawing.text((20, 115), "link: a rigid body, whose frame has its name")
    drawing.text((20, 140), "joint that moves: origin, then a turn about its axis, from /joint_states -> /tf", ORANGE)
    drawing.text((20, 165), "fixed joint: origin only -> /tf_static", BLUE)
    return drawing


def time_travel() -> Drawing:
    drawing = Drawing(230)

    def base(time: float) -> Transform:
        return Transform.from_rpy([0.5 * time, 0.25 * math.sin(1.1 * time), 0.0], yaw=0.5 * math.cos(1.1 * time))

    def pixel(position: Sequence[float]) -> Point:
        return 60 + 200 * float(position[0]), 130 - 150 * float(position[1])

    tip = Transform([0.8, 0.0, 0.0])
    drawing.line([pixel(base(k / 20).translation) for k in range(81)], GRAY, 1.5, dashed=True)
    for time, color, name in ((2.0, BLUE, "one second ago"), (3.0, BLACK, "now")):
        end = (base(time) @ tip).translation
        drawing.line([pixel(base(time).translation), pixel(end)], color, 4)
        drawing.dot(pixel(base(time).translation), color, 8)
        drawing.text((pixel(base(time).translation)[0], 215), name, color, anchor="middle")
    past = (base(2.0) @ tip).translation
    drawing.dot(pixel(past), ORANGE, 7)
    drawing.arrow(pixel(base(3.0).translation), pixel(past), ORANGE)
    drawing.text((pixel(past)[0] + 4, 40), "the end effector then, seen from the base now", ORANGE, anchor="middle")
    drawing.axes((50, 190), 0.0, "odom", 35)
    return drawing


def finding_errors() -> Drawing:
    drawing = Drawing(220)
    lengths = (0.5, 0.3)  # of link1
    curves: list[list[Point]] = [[], []]
    both: list[Point] = []
    for k in range(100):
        t = k / 20
        q1 = 0.5 * math.sin(2 * math.pi * 0.2 * t)
        for curve, length in zip(curves, lengths, strict=True):
            curve.append((60 + 5.5 * k, 110 - 320 * length * math.sin(q1)))
        both.append(curves[k % 2][-1])
    drawing.arrow((60, 200), (620, 200), GRAY, 1.5)
    drawing.line(both, GRAY, 1.5)
    drawing.line(curves[0], BLUE, 3)
    drawing.line(curves[1], ORANGE, 3, dashed=True)
    drawing.text((300, 30), "dynamic_tf_broadcaster (solid)", BLUE)
    drawing.text((300, 50), "arm_driver, with other lengths (dashed)", ORANGE)
    drawing.text((300, 70), "what a listener receives (zigzag)", GRAY)
    drawing.text((20, 20), "y of link2", GRAY)
    drawing.text((600, 215), "time", GRAY)
    return drawing


def motion_between_frames() -> Drawing:
    drawing = Drawing(240)
    base, sensor, center = (150, 170), (330, 80), (330, 170)
    drawing.line([base, sensor], GRAY, 3)
    drawing.axes(base, 0.0, "base_link", 45)
    drawing.axes(sensor, 0.5, "sensor", 45)
    drawing.arrow(base, (base[0] + 110, base[1]), BLUE, 3)
    drawing.text((center[0] - 60, center[1] + 20), "v", BLUE)
    drawing.arrow(sensor, (sensor[0] + 70, sensor[1] + 50), ORANGE, 3)
    drawing.text((410, 150), "v + w x t: the same motion at the sensor", ORANGE)
    drawing.text((20, 30), "one rigid body, one angular velocity w, two linear velocities")
    drawing.text((225, 120), "t", GRAY)
    return drawing


def packages_and_launch() -> Drawing:
    drawing = Drawing(200)
    drawing.box((320, 40), "lab.launch.py", ORANGE)
    for number, name in enumerate(("static_tf_broadcaster", "tf_listener", "sensor_transform")):
        x = 120 + 200 * number
        drawing.arrow((320, 54), (x, 96), ORANGE)
        drawing.box((x, 110), name)
    drawing.text((20, 165), "executables of the package my_lab_nodes: setup.py names module and function of each", BLUE)
    drawing.text((20, 185), "one launch file starts them with their parameters", ORANGE)
    return drawing


FIGURES: dict[str, tuple[Callable[[], Drawing], str]] = {
    "01_why_frames": (why_frames, "An obstacle has different coordinates in two frames"),
    "02_rotations": (rotations, "Two turns about the new axes and about the fixed axes differ"),
    "03_static_and_dynamic": (static_and_dynamic, "What a late-joining listener receives"),
    "04_lookup_transform": (target_and_source, "The pose of the source relative to the target"),
    "05_time": (interpolation, "Stored samples, interpolation, and times without an answer"),
    "06_sensors": (sensors, "A scan with the transform at its stamp, and with the latest one"),
    "07_complete_tree": (complete_tree, "The complete tree of the lab"),
    "08_urdf": (urdf, "Links and joints of a robot description"),
    "09_time_travel": (time_travel, "A lookup with two times and a fixed frame"),
    "10_finding_errors": (finding_errors, "Two publishers of one transform"),
    "11_motion_between_frames": (motion_between_frames, "A velocity in two frames of one rigid body"),
    "12_packages_and_launch": (packages_and_launch, "A package, its executables, and a launch file that starts them"),
}


def main() -> int:
    outdated = []
    for name, (draw, title) in FIGURES.items():
        path, text = FOLDER / f"{name}.svg", draw().svg(title)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            outdated.append(path.name)
            if "--check" not in sys.argv:
                path.write_text(text, encoding="utf-8")
    print(f"{'out of date' if '--check' in sys.argv else 'written'}: {', '.join(outdated) or 'none'}")
    return 1 if outdated and "--check" in sys.argv else 0


if __name__ == "__main__":
    sys.exit(main())
