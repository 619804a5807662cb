"""Poses, paths, ranges and cameras."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays.drawing import Drawing, Options, finite, pose_row
from coframe.viewer.protocol import binary

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["draw_camera", "draw_odometry", "draw_path", "draw_pose", "draw_pose_array", "draw_range"]

Row = tuple[float, ...]


def draw_pose(message: Any, options: Options) -> Drawing:
    """A PoseStamped, or a PoseWithCovarianceStamped with its covariance."""
    pose = message.pose
    covariance = getattr(pose, "covariance", None)
    facts = {} if covariance is None else {"covariance": [finite(value) for value in covariance]}
    return _posed(message, "poses", [pose_row(pose if covariance is None else pose.pose)], facts, options.origin)


def draw_pose_array(message: Any, options: Options) -> Drawing:
    """A PoseArray."""
    return _posed(message, "poses", [pose_row(pose) for pose in message.poses], {}, options.origin)


def draw_path(message: Any, options: Options) -> Drawing:
    """A Path, all of it in its own header's frame."""
    return _posed(message, "path", [pose_row(stamped.pose) for stamped in message.poses], {}, options.origin)


def draw_odometry(message: Any, trail: Sequence[Row], options: Options) -> Drawing:
    """An Odometry message behind those before it."""
    covariance = [finite(value) for value in message.pose.covariance]
    facts = {"child_frame": message.child_frame_id, "covariance": covariance}
    return _posed(message, "odometry", trail, facts, options.origin)


def draw_range(message: Any, options: Options) -> Drawing:
    """A Range: a cone of sound or light."""
    facts = {
        "radiation_type": message.radiation_type,
        "field_of_view": finite(message.field_of_view),
        "min_range": finite(message.min_range),
        "max_range": finite(message.max_range),
        "range": finite(message.range),
    }
    return _described(message, "range", facts, np.zeros(0, np.float32), options.origin)


def draw_camera(message: Any, options: Options) -> Drawing:
    """A CameraInfo: the pyramid that the camera sees."""
    facts = {
        "width": message.width,
        "height": message.height,
        "k": [finite(value) for value in message.k],
        "d": [finite(value) for value in message.d],
        "distortion_model": message.distortion_model,
    }
    return _described(message, "camera", facts, np.zeros(0, np.float32), options.origin)


def _posed(message: Any, kind: str, rows: Sequence[Row], facts: dict[str, Any], origin: int) -> Drawing:
    with np.errstate(over="ignore"):
        payload = np.array(rows, np.float64).reshape(-1, 7).astype(np.float32)
    return _described(message, kind, {**facts, "poses": [0, len(payload)]}, payload, origin)


def _described(message: Any, kind: str, facts: dict[str, Any], payload: Any, origin: int) -> Drawing:
    stamp = stamp_ns(message.header.stamp)
    description = {"kind": kind, "frame": message.header.frame_id, "stamp": stamp - origin, **facts}
    return Drawing(message.header.frame_id, stamp, binary.shapes(description, payload))
