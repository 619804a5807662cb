# SPDX-License-Identifier: Apache-2.0
"""Descriptions of shapes: the JSON part of a binary message of kind `BinaryKind.SHAPES`."""

from __future__ import annotations

from typing import Literal, TypeAlias, TypedDict

Rows: TypeAlias = tuple[int, int]
"""An offset into the payload, in floats, and a number of rows: 7 floats per pose, 3 per point, 4 per colour."""


class PosesShape(TypedDict):
    """Poses of one message; 36 covariances, or none."""

    kind: Literal["poses"]
    frame: str
    stamp: float
    poses: Rows
    covariance: list[float | None] | None


class PathShape(TypedDict):
    """A path."""

    kind: Literal["path"]
    frame: str
    stamp: float
    poses: Rows


class OdometryShape(TypedDict):
    """The trail of an odometry topic, newest pose last."""

    kind: Literal["odometry"]
    frame: str
    child_frame: str
    stamp: float
    poses: Rows
    covariance: list[float | None] | None


class MarkerItem(TypedDict):
    """A marker; ``mesh`` is the URL of its mesh, ``mesh_problem`` the reason why there is none."""

    ns: str
    id: int
    type: int
    pose: list[float | None]
    scale: list[float | None]
    rgba: list[float | None]
    text: str
    use_materials: bool
    mesh: str | None
    mesh_problem: str | None
    points: Rows | None
    colors: Rows | None


class MarkersShape(TypedDict):
    """Markers that share a frame and a stamp."""

    kind: Literal["markers"]
    frame: str
    stamp: float
    items: list[MarkerItem]


class RangeShape(TypedDict):
    """A range measurement."""

    kind: Literal["range"]
    frame: str
    stamp: float
    range: float | None
    min_range: float | None
    max_range: float | None
    field_of_view: float | None
    radiation_type: int


class CameraShape(TypedDict):
    """The intrinsics of a camera: image size in pixels, the 3x3 matrix K and the 3x4 matrix P in row-major order."""

    kind: Literal["camera"]
    frame: str
    stamp: float
    width: int
    height: int
    k: list[float | None]
    p: list[float | None]
    distortion_model: str
    d: list[float | None]


ShapesDescription: TypeAlias = PosesShape | PathShape | OdometryShape | MarkersShape | RangeShape | CameraShape
