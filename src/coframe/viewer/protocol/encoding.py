# SPDX-License-Identifier: Apache-2.0
"""Encode the messages that the server sends."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.viewer.protocol._layout import Layout
from coframe.viewer.protocol.binary_messages import (
    NO_FRAME,
    BinaryKind,
    CloudFlag,
    CloudHeader,
    CurveRecord,
    CurvesHeader,
    EntryRecord,
    FramesHeader,
    GridHeader,
    GridPartHeader,
    ImageFormat,
    ImageHeader,
    NodeHeader,
    ShapesHeader,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from coframe.viewer.protocol.server_messages import ServerMessage

__all__ = [
    "CurvePoints",
    "EntryPose",
    "encode",
    "encode_cloud",
    "encode_curves",
    "encode_frames",
    "encode_grid",
    "encode_grid_part",
    "encode_image",
    "encode_node",
    "encode_shapes",
    "relative_to",
    "set_owner",
]

_FRAMES = Layout(FramesHeader)
_ENTRY = Layout(EntryRecord)
_CLOUD = Layout(CloudHeader)
_GRID = Layout(GridHeader)
_GRID_PART = Layout(GridPartHeader)
_SHAPES = Layout(ShapesHeader)
_IMAGE = Layout(ImageHeader)
_NODE = Layout(NodeHeader)
_CURVES, _CURVE = Layout(CurvesHeader), Layout(CurveRecord)
_NO_POSE = (float("nan"),) * 7


class EntryPose(NamedTuple):
    """A displayed message, its frame, and the pose of that frame in the fixed frame; None without a transform."""

    display: int
    sequence: int
    pose: NDArray[np.float64] | None
    frame: str = ""


class CurvePoints(NamedTuple):
    """New points of a curve, which replace all earlier ones if ``reset`` is set: (N,) nanoseconds and (N,) values."""

    curve: int
    reset: bool
    times: NDArray[np.int64]
    values: NDArray[np.float64]


def encode(message: ServerMessage) -> str:
    """Return a text message."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False)


def encode_curves(curves: Sequence[CurvePoints], origin: int) -> bytes:
    """Return new points of curves. Their times become relative to an origin in nanoseconds."""
    parts: list[Any] = [_CURVES.pack(BinaryKind.CURVES, len(curves))]
    parts += [_CURVE.pack(one.curve, one.reset, len(one.times), 0) for one in curves]
    for one in curves:
        parts += [(one.times - origin).astype("<f8").tobytes(), one.values.astype("<f8").tobytes()]
    return b"".join(parts)


def encode_frames(
    revision: int,
    time: float,
    origin: NDArray[np.float64],
    poses: NDArray[np.float32],
    states: NDArray[np.uint8],
    entries: Sequence[EntryPose],
    indices: Mapping[str, int],
) -> bytes:
    """Return a frame update.

    Args:
        revision: The revision of the tree that gives the order of the frames.
        time: The displayed time in nanoseconds relative to the origin of times, or NaN if there is no data.
        origin: The local origin in meters in the fixed frame, (3,).
        poses: The poses of all frames relative to the local origin, (N, 7).
        states: The `FrameState` of each frame, (N,).
        entries: The displayed messages.
        indices: The index of each frame by its name.
    """
    parts: list[Any] = [
        _FRAMES.pack(BinaryKind.FRAMES, revision, time, *origin.tolist(), len(poses), len(entries)),
        poses.data,
        states.data,
        bytes(-len(states) % 4),
    ]
    for entry in entries:
        frame = indices.get(entry.frame, NO_FRAME)
        pose = _NO_POSE if entry.pose is None else relative_to(origin, entry.pose).tolist()
        parts.append(_ENTRY.pack(entry.display, entry.sequence, frame, *pose, entry.pose is None))
    return b"".join(parts)


def relative_to(origin: NDArray[np.float64], poses: NDArray[np.float64]) -> NDArray[np.float32]:
    """Return poses, (..., 7), relative to a local origin, so that float32 is precise enough far from the origin."""
    local = poses.copy()
    local[..., :3] -= origin
    with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
        small: NDArray[np.float32] = local.astype("<f4")
    return small


def encode_cloud(
    stamp: float,
    points: NDArray[np.float32],
    scalars: NDArray[np.float32] | None,
    colors: NDArray[np.uint8] | None,
    step: int = 1,
) -> bytearray:
    """Return a point cloud.

    Args:
        stamp: Nanoseconds relative to the origin of times.
        points: Positions in the message's frame, (N, 3).
        scalars: One number per point, (N,).
        colors: Red, green, blue and alpha of each point, (N, 4).
        step: Every n-th point of the message is included.
    """
    flags = step << 8
    parts: list[Any] = [np.ascontiguousarray(points, "<f4")]
    if scalars is not None:
        flags |= CloudFlag.SCALARS
        parts.append(np.ascontiguousarray(scalars, "<f4"))
    if colors is not None:
        flags |= CloudFlag.COLORS
        parts.append(np.ascontiguousarray(colors))
    header = _CLOUD.pack(BinaryKind.CLOUD, 0, 0, len(points), flags, stamp, *_finite_range(scalars))
    return _join(header, *parts)


def encode_grid(resolution: float, corner: Sequence[float], cells: NDArray[np.int8]) -> bytearray:
    """Return an occupancy grid from its cells, (height, width), and the pose of its corner, (7,)."""
    height, width = cells.shape
    header = _GRID.pack(BinaryKind.GRID, 0, 0, width, height, resolution, *corner)
    return _join(header, np.ascontiguousarray(cells))


def encode_grid_part(x: int, y: int, cells: NDArray[np.int8]) -> bytearray:
    """Return new cells, (height, width), of an occupancy grid that the page has, from column x and row y."""
    height, width = cells.shape
    return _join(_GRID_PART.pack(BinaryKind.GRID_PART, 0, 0, x, y, width, height), np.ascontiguousarray(cells))


def encode_shapes(description: Mapping[str, Any], payload: NDArray[np.float32]) -> bytearray:
    """Return shapes from their description, a TypedDict of a `DisplayRow`, and the numbers to which it refers."""
    text = json.dumps(description, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    return _join(_SHAPES.pack(BinaryKind.SHAPES, 0, 0, len(text)), text, payload.astype("<f4"))


def encode_image(
    kind: ImageFormat, width: int, height: int, data: NDArray[np.uint8], stamp: float, step: int = 1
) -> bytearray:
    """Return an image.

    Args:
        kind: The format of `data`.
        width: Pixels per row.
        height: Number of rows.
        data: Pixels, (height, width, 1 or 3), or the bytes of a file.
        stamp: Nanoseconds relative to the origin of times.
        step: Every n-th row and column of the message is included.
    """
    header = _IMAGE.pack(BinaryKind.IMAGE, 0, 0, width, height, kind | step << 8, stamp)
    return _join(header, np.ascontiguousarray(data))


def encode_node(
    node: int,
    vertices: NDArray[np.float32],
    indices: NDArray[np.uint32],
    colors: NDArray[np.uint8],
    width: int,
    offset: Sequence[float],
) -> bytes:
    """Return the geometry of a node.

    Args:
        node: The id of the node.
        vertices: Positions relative to the offset, (V, 3).
        indices: Indices of vertices, (I,).
        colors: Red, green, blue and alpha, (C, 4).
        width: The number of colors in each row of an image, or 0 for other nodes.
        offset: The offset in the node, in meters, (3,).
    """
    header = _NODE.pack(BinaryKind.NODE, node, len(vertices), len(indices), len(colors), width, *offset)
    parts = (np.ascontiguousarray(vertices, "<f4"), np.ascontiguousarray(indices, "<u4"), np.ascontiguousarray(colors))
    return b"".join((header, *(part.tobytes() for part in parts)))


def set_owner(drawing: bytearray, display: int, sequence: int) -> None:
    """Write the display and the sequence number into an encoded drawing."""
    struct.pack_into("<II", drawing, 4, display, sequence)


def _join(*parts: Any) -> bytearray:
    return bytearray().join(parts)


def _finite_range(scalars: NDArray[np.float32] | None) -> tuple[float, float]:
    if scalars is None or not scalars.size:
        return 0.0, 0.0
    finite = scalars[np.isfinite(scalars)]
    return (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
