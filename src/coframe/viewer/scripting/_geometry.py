# SPDX-License-Identifier: Apache-2.0
"""The geometry of nodes: vertices, indices and colors in the form in which they are sent."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.viewer.protocol.client_messages import MAX_POINTS
from coframe.viewer.protocol.encoding import encode_node
from coframe.viewer.scripting._arguments import parse_faces, parse_vertices
from coframe.viewer.scripting._colors import parse_colors, parse_pixels, parse_vertex_colors
from coframe.viewer.scripting.errors import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.viewer.protocol.common import Vector

__all__ = [
    "Geometry",
    "box_mesh",
    "image_geometry",
    "lines_geometry",
    "mesh_geometry",
    "points_geometry",
    "sphere_mesh",
]

# Coordinates beyond this are sent relative to their center: float32 resolves 0.06 mm up to here.
_MAX_EXACT_COORDINATE = 1000.0


class Geometry(NamedTuple):
    """The geometry of a node. See :class:`coframe.viewer.protocol.binary_messages.NodeHeader`.

    Attributes:
        vertices: Positions relative to the offset, (V, 3).
        indices: Indices of vertices, (I,).
        colors: Red, green, blue and alpha, (C, 4).
        width: The number of colors in each row of an image.
        offset: Position of the vertices' origin in the node, in meters.
    """

    vertices: NDArray[np.float32]
    indices: NDArray[np.uint32]
    colors: NDArray[np.uint8]
    width: int = 0
    offset: Vector = (0.0, 0.0, 0.0)

    @property
    def size(self) -> int:
        """The number of bytes."""
        return self.vertices.nbytes + self.indices.nbytes + self.colors.nbytes

    @property
    def positions(self) -> NDArray[np.float64]:
        """The vertices in the coordinates of the node, (V, 3)."""
        positions: NDArray[np.float64] = self.vertices.astype(np.float64) + self.offset
        return positions

    def encode(self, node: int) -> bytes:
        """Return the binary message for a node."""
        return encode_node(node, self.vertices, self.indices, self.colors, self.width, self.offset)


_NO_VERTICES, _NO_INDICES = np.empty((0, 3), np.float32), np.empty(0, np.uint32)


def points_geometry(points: Any, colors: Any) -> Geometry:
    """Return points, (N, 3), with a color each, or None."""
    positions = parse_vertices(points, "points", [(None, 3)])
    _check_count(len(positions), "points", "points")
    return _geometry(positions, _NO_INDICES, parse_colors(colors, len(positions)))


def lines_geometry(points: Any, colors: Any) -> Geometry:
    """Return separate lines, (N, 2, 3), or one line through points, (N, 3), with a color for each point, or None."""
    positions = parse_vertices(points, "points", [(None, 3), (None, 2, 3)])
    _check_count(positions.size // 3, "points", "points")
    strip = positions.ndim == 2
    flat = positions.reshape(-1, 3)
    own = parse_vertex_colors(colors, len(flat))
    return _geometry(_pairs(flat), _NO_INDICES, _pairs(own)) if strip else _geometry(flat, _NO_INDICES, own)


def mesh_geometry(vertices: Any, faces: Any, colors: Any) -> Geometry:
    """Return triangles from vertices, (V, 3), and their indices, (F, 3), with a color for each vertex, or None."""
    positions = parse_vertices(vertices, "vertices", [(None, 3)])
    _check_count(len(positions), "vertices", "vertices")
    triangles = parse_faces(faces, "faces", len(positions))
    _check_count(len(triangles), "faces", "triangles")
    return _geometry(positions, triangles.reshape(-1), parse_colors(colors, len(positions), each="vertex"))


def image_geometry(image: Any) -> Geometry:
    """Return the pixels of an image, row by row from the top."""
    pixels = parse_pixels(image)
    return Geometry(_NO_VERTICES, _NO_INDICES, pixels.reshape(-1, 4), pixels.shape[1])


def box_mesh(size: Vector) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Return the vertices and the triangles of a box with its center at zero. Each side has its own four vertices."""
    corners: list[NDArray[np.float64]] = []
    faces: list[list[int]] = []
    for axis in range(3):
        for side in (-0.5, 0.5):
            across = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
            start = len(corners)
            corners += [np.insert(np.array(pair), axis, side) for pair in across]
            # The second axis of a face around y points the other way.
            order = (0, 1, 2, 3) if (side > 0) == (axis != 1) else (3, 2, 1, 0)
            faces += [[start + order[k] for k in triangle] for triangle in ((0, 1, 2), (0, 2, 3))]
    return np.array(corners) * size, np.array(faces, np.uint32)


def sphere_mesh(radius: float | NDArray[np.float64], rows: int = 16) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Return the vertices and the triangles of a sphere, or an ellipsoid with three radii, with its center at zero."""
    columns = 2 * rows
    polar, azimuth = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, columns + 1), indexing="ij")
    points = np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)], axis=-1)
    at = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
    faces = np.concatenate([np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([a, c, d], axis=-1).reshape(-1, 3)])
    return radius * points.reshape(-1, 3), faces.astype(np.uint32)


def _geometry(positions: NDArray[np.float64], indices: NDArray[np.uint32], colors: NDArray[np.uint8]) -> Geometry:
    offset = np.zeros(3)
    if positions.size and float(np.abs(positions).max()) > _MAX_EXACT_COORDINATE:
        offset = np.round((positions.min(axis=0) + positions.max(axis=0)) / 2)
    x, y, z = offset.tolist()
    return Geometry((positions - offset).astype(np.float32), indices, colors.copy(), 0, (x, y, z))


def _pairs(rows: NDArray[Any]) -> NDArray[Any]:
    """Return both ends of each part of a line through N points, (2 N - 2, ...)."""
    ends: NDArray[Any] = np.repeat(rows, 2, axis=0)[1:-1]
    return ends


def _check_count(count: int, argument: str, what: str) -> None:
    if count > MAX_POINTS:
        raise SceneError(f"{argument}: {count} {what} exceed the maximum of {MAX_POINTS}", hint="Thin the data.")
