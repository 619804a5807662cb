# SPDX-License-Identifier: Apache-2.0
"""Poses, paths, odometry, ranges and cameras."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays.drawing import Drawing, Options, finite, pose_row
from coframe.viewer.protocol.encoding import encode_shapes
from coframe.viewer.protocol.shapes import CameraShape, OdometryShape, PathShape, PosesShape, RangeShape

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from coframe.viewer.protocol.shapes import ShapesDescription

__all__ = ["draw_camera", "draw_odometry", "draw_path", "draw_pose", "draw_pose_array", "draw_range"]

Row = tuple[float, ...]
_MAX_DISTORTION = 16  # OpenCV's models have at most 14 coefficients.
_NO_NUMBERS = np.zeros(0, np.float32)


def draw_pose(message: Any, options: Options) -> Drawing:
    """Draw a PoseStamped, or a PoseWithCovarianceStamped with its covariance."""
    pose = message.pose
    covariance = getattr(pose, "covariance", None)
    if covariance is None:
        return _draw_poses(message, [pose_row(pose)], None, options)
    return _draw_poses(message, [pose_row(pose.pose)], _finite_all(covariance), options)


def draw_pose_array(message: Any, options: Options) -> Drawing:
    """Draw a PoseArray."""
    return _draw_poses(message, [pose_row(pose) for pose in message.poses], None, options)


def draw_path(message: Any, options: Options) -> Drawing:
    """Draw a Path, with all poses expressed in the frame of its own header."""
    payload = _payload([pose_row(stamped.pose) for stamped in message.poses])
    frame, stamp = _header(message, options)
    description = PathShape(kind="path", frame=frame, stamp=stamp, poses=(0, len(payload)))
    return _drawing(message, description, payload)


def draw_odometry(message: Any, trail: Sequence[Row], options: Options) -> Drawing:
    """Draw an Odometry message with a trail of the previous poses."""
    payload = _payload(trail)
    frame, stamp = _header(message, options)
    description = OdometryShape(
        kind="odometry",
        frame=frame,
        child_frame=message.child_frame_id,
        stamp=stamp,
        poses=(0, len(payload)),
        covariance=_finite_all(message.pose.covariance),
    )
    return _drawing(message, description, payload)


def draw_range(message: Any, options: Options) -> Drawing:
    """Draw a Range as a cone."""
    frame, stamp = _header(message, options)
    description = RangeShape(
        kind="range",
        frame=frame,
        stamp=stamp,
        range=finite(message.range),
        min_range=finite(message.min_range),
        max_range=finite(message.max_range),
        field_of_view=finite(message.field_of_view),
        radiation_type=message.radiation_type,
    )
    return _drawing(message, description, _NO_NUMBERS)


def draw_camera(message: Any, options: Options) -> Drawing:
    """Draw the view frustum of a CameraInfo."""
    frame, stamp = _header(message, options)
    description = CameraShape(
        kind="camera",
        frame=frame,
        stamp=stamp,
        width=message.width,
        height=message.height,
        k=_finite_all(message.k),
        p=_finite_all(message.p),
        distortion_model=message.distortion_model,
        d=_finite_all(message.d[:_MAX_DISTORTION]),
    )
    return _drawing(message, description, _NO_NUMBERS)


def _draw_poses(message: Any, rows: Sequence[Row], covariance: list[float | None] | None, options: Options) -> Drawing:
    payload = _payload(rows)
    frame, stamp = _header(message, options)
    description = PosesShape(kind="poses", frame=frame, stamp=stamp, poses=(0, len(payload)), covariance=covariance)
    return _drawing(message, description, payload)


def _header(message: Any, options: Options) -> tuple[str, float]:
    return message.header.frame_id, stamp_ns(message.header.stamp) - options.origin


def _payload(rows: Sequence[Row]) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
        return np.array(rows, np.float64).reshape(-1, 7).astype(np.float32)


def _finite_all(values: Iterable[Any]) -> list[float | None]:
    return [finite(value) for value in values]


def _drawing(message: Any, description: ShapesDescription, payload: NDArray[np.float32]) -> Drawing:
    return Drawing(message.header.frame_id, stamp_ns(message.header.stamp), encode_shapes(description, payload))
