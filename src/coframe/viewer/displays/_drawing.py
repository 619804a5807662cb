# SPDX-License-Identifier: Apache-2.0
"""Drawings, and the options of displays."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from coframe.errors import CoframeError
from coframe.time import stamp_ns
from coframe.viewer.protocol.client_messages import DisplayOptions
from coframe.viewer.protocol.encoding import encode_shapes

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray
    from typing_extensions import Self

__all__ = [
    "FIXED_FRAME",
    "MAX_NEAR",
    "NO_NUMBERS",
    "CannotDrawError",
    "Drawing",
    "Options",
    "PoseRow",
    "Vector",
    "drawing_of_shapes",
    "far_offset",
    "finite",
    "finite_all",
    "header_of",
    "near_points",
    "pose_row",
    "pose_rows",
    "rgba_of",
]

Vector: TypeAlias = tuple[float, float, float]
PoseRow: TypeAlias = tuple[float, ...]
"""x, y, z, qx, qy, qz, qw."""
FIXED_FRAME = "<Fixed Frame>"
"""The frame of a drawing that is expressed in the fixed frame; RViz's files name it like this, too."""
MAX_NEAR = 1000.0
"""Meters. float32 resolves 0.06 mm up to here."""
_MAX_FAR = 1e12  # meters; differences of larger numbers are rounded in float64, too
NO_NUMBERS = np.zeros(0, np.float32)


class CannotDrawError(CoframeError, ValueError):
    """A message cannot be drawn. The error message gives the reason."""


@dataclass(eq=False)
class Drawing:
    """The data that the page needs to draw a message.

    Attributes:
        frame: The frame in which the drawing is expressed.
        stamp: The stamp at which its pose is looked up, in nanoseconds; 0 is the latest.
        data: The binary message to the page, without the display and the sequence number.
        locked: Whether the drawing moves with its frame after its stamp.
        placed: Whether it is part of the scene; images are shown next to it.
        offset: Position of the drawing in the frame, in meters; see :func:`far_offset`.
        changes: Binary messages that change the drawing after the page has received it.
        note: What the drawing omits, or "" if it is complete.
    """

    frame: str
    stamp: int
    data: bytearray
    locked: bool = False
    placed: bool = True
    offset: Vector = (0.0, 0.0, 0.0)
    changes: list[bytearray] = field(default_factory=list)
    note: str = ""

    def take_data(self) -> bytearray:
        """Return the binary message and release it, because it is sent only once and may be large."""
        data, self.data = self.data, bytearray()
        return data


@dataclass(frozen=True)
class Options(DisplayOptions):
    """The drawing options of a display: those that a client requested, and those that the server adds.

    Attributes:
        origin: The origin of the times that the page receives, in nanoseconds.
        is_replay: Whether each drawing has to be complete, because a replay contains only some of them.
    """

    origin: int = 0
    is_replay: bool = False

    @classmethod
    def from_message(cls, options: DisplayOptions, origin: int = 0) -> Self:
        """Return the options that a client requested."""
        return cls(**{one.name: getattr(options, one.name) for one in fields(options)}, origin=origin)


def finite(value: Any) -> float | None:
    """Return a number, or None for NaN and infinity, which JSON does not support."""
    return float(value) if math.isfinite(value) else None


def pose_row(pose: Any) -> PoseRow:
    """Return x, y, z, qx, qy, qz, qw of a Pose message.

    A quaternion of zeros, which is the default of the message, is treated as the identity.
    """
    p, q = pose.position, pose.orientation
    length = math.hypot(q.x, q.y, q.z, q.w)
    if length == 0.0:
        return (p.x, p.y, p.z, 0.0, 0.0, 0.0, 1.0)
    return (p.x, p.y, p.z, q.x / length, q.y / length, q.z / length, q.w / length)


def rgba_of(color: Any) -> list[float | None]:
    """Return red, green, blue and alpha of a ColorRGBA message."""
    return [finite(part) for part in (color.r, color.g, color.b, color.a)]


def finite_all(values: Iterable[Any]) -> list[float | None]:
    """Return numbers, with None for NaN and infinity."""
    return [finite(value) for value in values]


def far_offset(positions: NDArray[Any]) -> Vector:
    """Return the point to which a drawing's coordinates, (N, 3) in meters, are relative: the origin if they are near.

    The page draws float32 numbers, which would round coordinates of a map in UTM to steps of half a meter.
    """
    finite_rows = positions[np.isfinite(positions).all(axis=1)]
    if not finite_rows.size or not MAX_NEAR < float(np.abs(finite_rows).max()) < _MAX_FAR:
        return 0.0, 0.0, 0.0
    x, y, z = np.round((finite_rows.min(axis=0) + finite_rows.max(axis=0)) / 2).tolist()
    return x, y, z


def pose_rows(rows: Sequence[PoseRow]) -> tuple[NDArray[np.float32], Vector]:
    """Return poses as the numbers of a drawing, (N, 7), and the point to which they are relative."""
    numbers = np.array(rows, np.float64).reshape(-1, 7)
    offset = far_offset(numbers[:, :3])
    numbers[:, :3] -= offset
    with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
        return numbers.astype(np.float32), offset


def near_points(points: NDArray[np.float64]) -> tuple[NDArray[np.float32], Vector]:
    """Return points, (N, 3), as the numbers of a drawing, and the point to which they are relative."""
    offset = far_offset(points)
    with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
        return (points - offset).astype(np.float32), offset


def header_of(message: Any, options: Options) -> tuple[str, float]:
    """Return the frame of a message, and its stamp in nanoseconds relative to the origin of times."""
    return message.header.frame_id, stamp_ns(message.header.stamp) - options.origin


def drawing_of_shapes(
    message: Any, description: Mapping[str, Any], numbers: NDArray[np.float32], offset: Vector = (0.0, 0.0, 0.0)
) -> Drawing:
    """Return a drawing in the frame and at the stamp of a message, from its shapes and the numbers they refer to."""
    data = encode_shapes(description, numbers)
    return Drawing(message.header.frame_id, stamp_ns(message.header.stamp), data, offset=offset)
