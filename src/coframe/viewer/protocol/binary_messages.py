# SPDX-License-Identifier: Apache-2.0
"""Binary messages from the server to the page: headers and records of fixed size, little-endian.

Each message begins with its kind (`BinaryKind`). The letters of the types are the same as in the struct module.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Annotated, Any, NamedTuple, TypeAlias

UInt32: TypeAlias = Annotated[int, "I"]
Float32: TypeAlias = Annotated[float, "f"]
Float64: TypeAlias = Annotated[float, "d"]
Float64x3: TypeAlias = Annotated[tuple[float, ...], "3d"]
Float32x2: TypeAlias = Annotated[tuple[float, ...], "2f"]
Float32x7: TypeAlias = Annotated[tuple[float, ...], "7f"]

NO_FRAME = 2**32 - 1


class BinaryKind(IntEnum):
    """The first four bytes of a binary message."""

    FRAMES = 1
    CLOUD = 2
    GRID = 3
    SHAPES = 4
    IMAGE = 5
    CURVES = 6
    NODE = 7
    GRID_PART = 8


class FrameState(IntEnum):
    """The state of a frame in a frame update.

    A frame of another tree has no transform to the fixed frame; its pose is relative to its own root.
    """

    OK = 0
    STALE = 1
    GONE = 2
    OTHER_TREE = 3


class CloudFlag(IntEnum):
    """Flags of a cloud. The bits above 8 hold the thinning step."""

    SCALARS = 1
    COLORS = 2


class ImageFormat(IntEnum):
    """The lowest eight bits of an image's format. The bits above 8 hold the thinning step.

    The values of GRAY16 are uint16, those of FLOAT float32. VIDEO is a sequence of encoded frames.
    """

    GRAY = 0
    RGB = 1
    JPEG = 2
    PNG = 3
    GRAY16 = 4
    FLOAT = 5
    VIDEO = 6


class FramesHeader(NamedTuple):
    """A frame update: the poses of all frames and displayed messages at one time.

    Followed by float32[7] per frame, uint8 `FrameState` per frame, padding to four bytes, and one `EntryRecord` per
    displayed message. Positions are relative to ``origin``, which is in meters in the fixed frame. Entries that are no
    longer listed are removed. ``time`` is NaN while there is no data.
    """

    kind: UInt32
    revision: UInt32
    time: Float64
    origin: Float64x3
    frames: UInt32
    entries: UInt32


class EntryRecord(NamedTuple):
    """A displayed message of a frame update: the pose of its frame, and 1 for ``missing`` if there is no transform.

    ``frame`` is the index of its frame in the tree, and `NO_FRAME` if the tree does not contain the frame.
    """

    display: UInt32
    sequence: UInt32
    frame: UInt32
    pose: Float32x7
    missing: UInt32


class CloudHeader(NamedTuple):
    """A point cloud. Followed by float32[3] per point in the message's frame, then float32 scalars or uint8[4] colors.

    ``range`` holds the smallest and the largest finite scalar.
    """

    kind: UInt32
    display: UInt32
    sequence: UInt32
    points: UInt32
    flags: UInt32
    stamp: Float64
    range: Float32x2


class GridHeader(NamedTuple):
    """An occupancy grid. Followed by int8 cells in row-major order; ``corner`` is the pose of the first cell."""

    kind: UInt32
    display: UInt32
    sequence: UInt32
    width: UInt32
    height: UInt32
    resolution: Float32
    corner: Float32x7


class GridPartHeader(NamedTuple):
    """New cells of a grid that the page has received, from column x and row y.

    Followed by int8 cells in row-major order.
    """

    kind: UInt32
    display: UInt32
    sequence: UInt32
    x: UInt32
    y: UInt32
    width: UInt32
    height: UInt32


class ShapesHeader(NamedTuple):
    """Shapes. Followed by a `ShapesDescription` as JSON, padded by spaces to four bytes, and a float32 payload."""

    kind: UInt32
    display: UInt32
    sequence: UInt32
    length: UInt32


class ImageHeader(NamedTuple):
    """An image, which is shown next to the scene. Followed by the pixels, or the bytes of a JPEG or PNG file."""

    kind: UInt32
    display: UInt32
    sequence: UInt32
    width: UInt32
    height: UInt32
    format: UInt32
    stamp: Float64


class CurvesHeader(NamedTuple):
    """New points of curves. Followed by one `CurveRecord` per curve, then the points of each curve in this order.

    The points of a curve are float64 times in nanoseconds relative to the origin, then float64 values; NaN is a gap.
    """

    kind: UInt32
    curves: UInt32


class CurveRecord(NamedTuple):
    """The number of points of a curve. They replace all earlier points if ``reset`` is 1, and follow them otherwise."""

    curve: UInt32
    reset: UInt32
    points: UInt32
    reserved: UInt32


class NodeHeader(NamedTuple):
    """The geometry of a node. Followed by float32[3] vertices, uint32 indices, and uint8[4] colors, in this order.

    Vertices are relative to ``offset``, which is expressed in the node. Lines have two vertices each, triangles three
    indices. There is one color (red, green, blue, alpha) for each vertex, or none; an image has no vertices, and
    ``width`` colors in each row.
    """

    kind: UInt32
    node: UInt32
    vertices: UInt32
    indices: UInt32
    colors: UInt32
    width: UInt32
    offset: Float64x3


BINARY_RECORDS: tuple[type[Any], ...] = (
    FramesHeader,
    EntryRecord,
    CloudHeader,
    GridHeader,
    GridPartHeader,
    ShapesHeader,
    ImageHeader,
    CurvesHeader,
    CurveRecord,
    NodeHeader,
)
BINARY_ENUMS: tuple[type[IntEnum], ...] = (BinaryKind, FrameState, CloudFlag, ImageFormat)
