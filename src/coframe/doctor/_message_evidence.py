# SPDX-License-Identifier: Apache-2.0
"""What messages of odometry, IMUs and cameras show about transforms, from a recording or from a live graph.

The definition of a type in a recording can differ from the usual one: messages with other fields show nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.cameras import CameraError, CameraModel
from coframe.doctor.observation import ObservedCamera, ObservedImu, ObservedPoses
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["CAMERA_INFO", "IMU", "ODOMETRY", "observed_camera", "observed_imu", "observed_poses"]

CAMERA_INFO, IMU, ODOMETRY = "sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/Imu", "nav_msgs/msg/Odometry"
_NORM_TOLERANCE = 5e-3  # how far a quaternion is off length 1 in tf2
_OTHER_FIELDS = (AttributeError, TypeError, ValueError, OverflowError)


def observed_camera(topic: str, message: Any, rename: Callable[[str], str]) -> ObservedCamera | None:
    """Return the camera of a CameraInfo; `rename` returns the name of a frame in the tree."""
    try:
        frame = rename(str(message.header.frame_id).lstrip("/"))
        d = tuple(float(value) for value in getattr(message, "d" if hasattr(message, "d") else "D"))
        name = str(message.distortion_model)
        try:
            model, problem = CameraModel.from_info(message), ""
        except CameraError as error:
            model, problem = None, str(error)
    except _OTHER_FIELDS:
        return None
    # Drivers without a calibration publish zeros, which is correct.
    is_calibrated = model is not None or any(d)
    return ObservedCamera(topic, frame, name, d, model, problem if is_calibrated else "")


def observed_imu(topic: str, messages: Iterable[Any], rename: Callable[[str], str]) -> ObservedImu | None:
    """Return the measurements of an IMU, or None if there are none in the frame of the first message."""
    try:
        received = [
            (
                str(message.header.frame_id).lstrip("/"),
                [
                    [getattr(one, axis) for axis in "xyz"]
                    for one in (message.linear_acceleration, message.angular_velocity)
                ],
            )
            for message in messages
        ]
        frame = received[0][0] if received else ""
        values = np.array([pair for own, pair in received if own == frame], dtype=np.float64).reshape(-1, 2, 3)
    except _OTHER_FIELDS:
        return None
    values = values[np.isfinite(values).all(axis=(1, 2))]
    return ObservedImu(topic, rename(frame), values[:, 0], values[:, 1]) if frame else None


def observed_poses(topic: str, messages: Iterable[Any], rename: Callable[[str], str]) -> ObservedPoses | None:
    """Return the poses of odometry, or None if its messages have several frames."""
    try:
        rows = [(message.header, message.child_frame_id, message.pose.pose) for message in messages]
        frames = {(str(header.frame_id).lstrip("/"), str(child).lstrip("/")) for header, child, _ in rows}
        stamps = [int(header.stamp.sec) * SECOND + header.stamp.nanosec for header, _, _ in rows]
        points = [[pose.position.x, pose.position.y, pose.position.z] for *_, pose in rows]
        turns = [[getattr(pose.orientation, name) for name in "xyzw"] for *_, pose in rows]
        values = np.concatenate([np.array(points, np.float64), np.array(turns, np.float64)], axis=1)
        stamp = np.array(stamps, dtype=np.int64)
    except _OTHER_FIELDS:
        return None
    if len(frames) != 1:
        return None
    with np.errstate(all="ignore"):
        length = np.linalg.norm(values[:, 3:], axis=1, keepdims=True)
        good = np.isfinite(values).all(axis=1) & (np.abs(length[:, 0] - 1.0) < _NORM_TOLERANCE)
        values[:, 3:] /= length
    ((frame, child),) = frames
    return ObservedPoses(topic, rename(frame), rename(child), stamp[good], values[good])
