# SPDX-License-Identifier: Apache-2.0
"""Write the meshes of the lab's robot, src/coframe/lab/meshes/*.glb, from primitive solids.

Lengths are in meters, in the frames of the links: x forward, y left, z up. The camera looks along z.

Example:
    python scripts/lab_meshes.py
"""

from __future__ import annotations

import json
import struct
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

TARGET = Path(__file__).parents[1] / "src" / "coframe" / "lab" / "meshes"

ORANGE, DARK, GRAY = (0.93, 0.42, 0.08), (0.06, 0.065, 0.07), (0.42, 0.45, 0.5)
LIGHT, BLUE, GLASS = (0.78, 0.8, 0.82), (0.05, 0.25, 0.6), (0.03, 0.05, 0.12)
SEGMENTS = 20


class Solid(NamedTuple):
    """Triangles, (N, 3, 3), with the normals of their corners, (N, 3, 3)."""

    corners: NDArray[np.float64]
    normals: NDArray[np.float64]

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Solid:
        """Return a copy at another position."""
        return Solid(self.corners + np.array([x, y, z]), self.normals)

    def along(self, axis: str) -> Solid:
        """Turn a solid whose axis is z."""
        order = {"x": [2, 0, 1], "y": [1, 2, 0], "z": [0, 1, 2]}[axis]
        return Solid(self.corners[..., order], self.normals[..., order])


def lathe(profile: list[tuple[float, float]]) -> Solid:
    """Rotate a profile of (radius, z), from the bottom to the top, about the z axis; edges of the profile are sharp."""
    angles = np.linspace(0.0, 2.0 * np.pi, SEGMENTS + 1)
    circle = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    corners, normals = [], []
    for (r0, z0), (r1, z1) in pairwise(profile):
        slope = np.array([z1 - z0, r0 - r1]) / np.hypot(z1 - z0, r0 - r1)
        normal = circle * slope[0] + [0.0, 0.0, slope[1]]
        low, high = circle * r0 + [0.0, 0.0, z0], circle * r1 + [0.0, 0.0, z1]
        for a in range(SEGMENTS):
            b = a + 1
            if r0 > 0.0:
                corners.append([low[a], low[b], high[b]])
                normals.append([normal[a], normal[b], normal[b]])
            if r1 > 0.0:
                corners.append([low[a], high[b], high[a]])
                normals.append([normal[a], normal[b], normal[a]])
    return Solid(np.array(corners), np.array(normals))


def cylinder(radius: float, bottom: float, top: float, bevel: float = 0.0) -> Solid:
    inner = radius - bevel
    return lathe(
        [(0.0, bottom), (inner, bottom), (radius, bottom + bevel), (radius, top - bevel), (inner, top), (0.0, top)]
        if bevel
        else [(0.0, bottom), (radius, bottom), (radius, top), (0.0, top)]
    )


def prism(outline: list[tuple[float, float]], bottom: float, top: float, bevel: float = 0.004) -> Solid:
    """Extrude a convex outline in x and y, counter-clockwise, along z, with bevelled edges at both ends."""
    points = np.array(outline)
    center = points.mean(axis=0)
    inner = center + (points - center) * (1.0 - bevel / np.abs(points - center).max(axis=0).min())
    rings = [(inner, bottom), (points, bottom + bevel), (points, top - bevel), (inner, top)]
    corners: list[Any] = []
    count = len(points)
    for (low, z0), (high, z1) in pairwise(rings):
        for a in range(count):
            b = (a + 1) % count
            quad = [(*low[a], z0), (*low[b], z0), (*high[b], z1), (*high[a], z1)]
            corners += [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]
    for ring, z, order in ((inner, bottom, (0, 2, 1)), (inner, top, (0, 1, 2))):
        for a in range(1, count - 1):
            triangle = [(*ring[0], z), (*ring[a], z), (*ring[a + 1], z)]
            corners.append([triangle[i] for i in order])
    faces = np.array(corners, float)
    normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return Solid(faces, np.repeat(normal[:, None], 3, axis=1))


def rounded(length: float, width: float, corner: float, steps: int = 4) -> list[tuple[float, float]]:
    """Return the outline of a rectangle around the origin with round corners."""
    outline = []
    for x, y, start in ((1, 1, 0.0), (-1, 1, 0.5), (-1, -1, 1.0), (1, -1, 1.5)):
        for k in range(steps + 1):
            angle = np.pi * (start + 0.5 * k / steps)
            outline.append(
                (
                    x * (length / 2 - corner) + corner * float(np.cos(angle)),
                    y * (width / 2 - corner) + corner * float(np.sin(angle)),
                )
            )
    return outline


def box(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float], bevel: float = 0.003) -> Solid:
    return prism([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])], *z, bevel)


Part = tuple[tuple[float, float, float], Solid]


def base() -> list[Part]:
    """Return a chassis with four wheels, a turntable for the arm, and a bridge for the lidar at 0.3 m."""
    wheel = cylinder(0.045, -0.018, 0.018, 0.006).along("y")
    hub = cylinder(0.022, -0.021, 0.021, 0.003).along("y")
    places = [(x, y) for x in (-0.125, 0.125) for y in (-0.165, 0.165)]
    posts = [cylinder(0.008, 0.07, 0.262).moved(0.1, y) for y in (-0.125, 0.125)]
    return [
        (GRAY, prism(rounded(0.4, 0.29, 0.05), 0.02, 0.07, 0.008)),
        (LIGHT, prism(rounded(0.36, 0.25, 0.045), 0.07, 0.078)),
        (ORANGE, prism(rounded(0.012, 0.2, 0.005, 2), 0.035, 0.055, 0.002).moved(0.197)),
        *((DARK, wheel.moved(x, y, 0.045)) for x, y in places),
        *((LIGHT, hub.moved(x, y, 0.045)) for x, y in places),
        (DARK, cylinder(0.05, 0.077, 0.086, 0.002)),
        *((DARK, post) for post in posts),
        (DARK, box((0.085, 0.115), (-0.135, 0.135), (0.258, 0.272))),
    ]


def joint() -> list[Part]:
    """Return the housing at the beginning of a link; the axis of the joint is z."""
    return [
        (DARK, cylinder(0.04, -0.014, 0.03, 0.004)),
        (LIGHT, cylinder(0.026, 0.03, 0.036, 0.003)),
    ]


def beam() -> list[Part]:
    """Return the beam of a link with a length of one, to be scaled along x."""
    outline = [(0.0, -0.026), (1.0, -0.019), (1.0, 0.019), (0.0, 0.026)]
    return [
        (ORANGE, prism(outline, -0.008, 0.022, 0.005)),
        (DARK, box((0.22, 0.78), (-0.009, 0.009), (0.02, 0.024), 0.001)),
    ]


def lidar() -> list[Part]:
    return [
        (DARK, cylinder(0.036, -0.028, -0.01, 0.003)),
        (GLASS, cylinder(0.033, -0.01, 0.016)),
        (DARK, cylinder(0.036, 0.016, 0.03, 0.005)),
        (ORANGE, cylinder(0.0365, 0.019, 0.022)),
    ]


def camera() -> list[Part]:
    return [
        (LIGHT, prism(rounded(0.036, 0.06, 0.008, 3), -0.014, 0.01)),
        (DARK, cylinder(0.013, 0.009, 0.024, 0.002)),
        (GLASS, cylinder(0.01, 0.024, 0.026, 0.001)),
    ]


def gripper() -> list[Part]:
    fingers = [box((0.0, 0.055), (y - 0.007, y + 0.007), (-0.01, 0.01)) for y in (-0.036, 0.036)]
    tips = [box((0.03, 0.055), (y - 0.003, y + 0.003), (-0.009, 0.009), 0.001) for y in (-0.0275, 0.0275)]
    return [
        (GRAY, cylinder(0.016, -0.1, -0.02).along("x")),
        (DARK, box((-0.03, 0.004), (-0.05, 0.05), (-0.016, 0.016), 0.005)),
        *((LIGHT, finger) for finger in fingers),
        *((ORANGE, tip) for tip in tips),
    ]


def imu() -> list[Part]:
    return [
        (DARK, box((-0.016, 0.016), (-0.016, 0.016), (-0.006, 0.004))),
        (BLUE, box((-0.007, 0.007), (-0.007, 0.007), (0.003, 0.006), 0.001)),
    ]


def glb(parts: list[Part]) -> bytes:
    """Return a binary glTF file with one primitive per color; z is up, as in the frames of links."""
    colors = list(dict.fromkeys(color for color, _ in parts))
    accessors: list[dict[str, Any]] = []
    views: list[dict[str, Any]] = []
    primitives: list[dict[str, Any]] = []
    blob = bytearray()

    def add(array: NDArray[Any], kind: str, component: int, target: int, **bounds: Any) -> int:
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": array.nbytes, "target": target})
        blob.extend(array.tobytes() + bytes(-array.nbytes % 4))
        accessor = {"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind}
        accessors.append({**accessor, **bounds})
        return len(accessors) - 1

    for number, color in enumerate(colors):
        solids = [solid for own, solid in parts if own == color]
        rows = np.concatenate(
            [np.concatenate([solid.corners, solid.normals], axis=2).reshape(-1, 6) for solid in solids]
        ).astype("<f4")
        vertices, indices = np.unique(rows.round(6), axis=0, return_inverse=True)
        position, normal = np.ascontiguousarray(vertices[:, :3]), np.ascontiguousarray(vertices[:, 3:])
        low, high = position.min(axis=0).tolist(), position.max(axis=0).tolist()
        primitives.append(
            {
                "attributes": {
                    "POSITION": add(position, "VEC3", 5126, 34962, min=low, max=high),
                    "NORMAL": add(normal, "VEC3", 5126, 34962),
                },
                "indices": add(indices.astype("<u2").reshape(-1), "SCALAR", 5123, 34963),
                "material": number,
            }
        )
    materials = [
        {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.6}}
        for color in colors
    ]
    document = {
        "asset": {"version": "2.0", "generator": "scripts/lab_meshes.py"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}],
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(blob)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(blob), len(text), 0x4E4F534A)
    return head[:20] + text + struct.pack("<II", len(blob), 0x004E4942) + bytes(blob)


def main() -> None:
    TARGET.mkdir(exist_ok=True)
    total = 0
    for make in (base, joint, beam, lidar, camera, gripper, imu):
        data = glb(make())
        (TARGET / f"{make.__name__}.glb").write_bytes(data)
        total += len(data)
        print(f"{make.__name__}.glb: {len(data)} bytes")
    print(f"together {total} bytes")


main()
