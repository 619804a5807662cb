# SPDX-License-Identifier: Apache-2.0
"""Read mounts from calibration files: Kalibr's camchain, Autoware's sensor kits, ROS's camera_info of a stereo pair.

Autoware's files name the frames: a parent with its children, each with x, y, z in meters and roll, pitch, yaw in
radians. Kalibr names cameras ``cam0``, ``cam1``, ... and the IMU ``imu``; a camera's frame is the one that the messages
on its ``rostopic`` name. A camera_info file has the frames ``left`` and ``right``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe import quaternion
from coframe._files.bounded_yaml import MAX_BYTES, read_yaml
from coframe._files.regular_files import read_regular
from coframe._process.optional_imports import pip_install
from coframe.errors import EditError
from coframe.frame_names import absolute

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from coframe.bags.editing._survey import Survey

__all__ = ["calibrated_transforms"]

Mount = tuple[str, str, tuple[float, ...]]  # parent, child, pose

_TRANSLATION, _ROTATION = ("x", "y", "z"), ("roll", "pitch", "yaw")
_QUATERNION = ("qx", "qy", "qz", "qw")
_MAX_ROTATION_ERROR = 1e-4  # how far the matrix of a rotation may be off


def calibrated_transforms(path: Path, names: dict[str, str], survey: Survey) -> list[Mount]:
    """Return the transforms in a calibration file: parent, child, and x, y, z, qx, qy, qz, qw.

    Raises:
        EditError: The file has none, or does not say in which frames.
        OSError: The file cannot be read.
    """
    try:
        content = read_yaml(read_regular(path, MAX_BYTES))
    except ModuleNotFoundError:
        raise EditError(
            "reading YAML needs the package PyYAML, which is not installed", hint=pip_install("bags")
        ) from None
    except ValueError as error:
        raise EditError(f"{path} is not valid YAML: {' '.join(str(error).split())[:200]}") from None
    if not isinstance(content, dict):
        raise EditError(f"{path} is not a calibration file")
    try:
        if "projection_matrix" in content:
            return _stereo(path, content, names)
        if any(isinstance(value, dict) and "camera_model" in value for value in content.values()):
            return list(_kalibr(path, content, names, survey))
        return list(_sensor_kit(content))
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        if isinstance(error, EditError):
            raise
        raise EditError(f"{path} is not a calibration in a known format: {type(error).__name__}: {error}") from None


def _sensor_kit(content: dict[str, Any]) -> Iterator[Mount]:
    for parent, children in content.items():
        for child, values in children.items() if isinstance(children, dict) else ():
            if isinstance(values, dict) and "x" in values:
                translation = [_number(values.get(name, 0.0)) for name in _TRANSLATION]
                if "qw" in values:
                    rotation = np.array([_number(values[name]) for name in _QUATERNION])
                    rotation /= np.linalg.norm(rotation)
                else:
                    rotation = quaternion.from_rpy(np.array([_number(values.get(name, 0.0)) for name in _ROTATION]))
                yield str(parent), str(child), (*translation, *rotation.tolist())


def _kalibr(path: Path, content: dict[str, Any], names: dict[str, str], survey: Survey) -> Iterator[Mount]:
    cameras = {name: value for name, value in content.items() if isinstance(value, dict) and "camera_model" in value}
    frames = {
        name: names.get(name) or _frame_of(str(value.get("rostopic", "")), survey) or name
        for name, value in cameras.items()
    }
    before = ""
    for name, values in cameras.items():
        if "T_cam_imu" in values:  # maps points of the IMU to the camera
            yield _imu(names, survey), frames[name], _pose(path, values["T_cam_imu"])
        elif "T_cn_cnm1" in values and before:  # maps points of the camera before to this one
            yield frames[before], frames[name], _pose(path, values["T_cn_cnm1"])
        before = name


def _frame_of(topic: str, survey: Survey) -> str:
    """Return the frame that the messages on a topic name, or "" if there are none."""
    if not topic.strip("/"):
        return ""
    for found, _, message in survey.messages(
        lambda one: absolute(one.name) == absolute(topic) and one.frames is not None
    ):
        if found.frames is not None:
            return found.frames.of_header(message.data).removeprefix("/")
    return ""


def _imu(names: dict[str, str], survey: Survey) -> str:
    """Return the frame of the IMU: the given one, or that of the only topic with messages of an IMU."""
    if given := names.get("imu") or names.get("imu0"):
        return given
    topics = [name for name, channel in survey.topics.items() if channel.type == "sensor_msgs/msg/Imu"]
    if len(topics) == 1 and (frame := _frame_of(topics[0], survey)):
        return frame
    raise EditError(
        "Kalibr's file does not name the frame of the IMU, and the recording has "
        f"{f'{len(topics)} IMU topics' if topics else 'no IMU topic'}",
        hint="Give its name after the file: imu=imu_link.",
    )


def _pose(path: Path, matrix: Any) -> tuple[float, ...]:
    """Return the pose of the camera in the other frame: the inverse of the matrix that maps points to the camera."""
    values = np.array(matrix, dtype=np.float64)
    if values.shape not in {(4, 4), (3, 4)}:
        raise EditError(f"{path}: a transform is not a matrix of 4 rows and 4 columns")
    rotation = _rotation(path, values[:3, :3])
    translation = -rotation.T @ values[:3, 3]
    return (*translation.tolist(), *_quaternion(rotation.T))


def _quaternion(rotation: NDArray[np.float64]) -> list[float]:
    """Return the quaternion of a rotation whose w is not negative, without negative zeros."""
    found = quaternion.from_matrix(rotation)
    values: list[float] = (found if found[3] >= 0.0 else -found).tolist()
    return [value + 0.0 for value in values]


def _rotation(path: Path, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    if not np.allclose(matrix @ matrix.T, np.eye(3), atol=_MAX_ROTATION_ERROR) or np.linalg.det(matrix) < 0.0:
        raise EditError(f"{path}: a matrix in it is not a rotation")
    return matrix


def _stereo(path: Path, content: dict[str, Any], names: dict[str, str]) -> list[Mount]:
    """Return the mount of the right camera of a stereo pair in the left one, from its rectification."""
    projection = np.array(content["projection_matrix"]["data"], dtype=np.float64).reshape(3, 4)
    if projection[0, 3] == 0.0:
        raise EditError(
            f"{path} contains no mount: it has the intrinsic parameters of one camera, or of the left one of a pair",
            hint="Give the file of the right camera, whose projection matrix contains the baseline.",
        )
    rectification = np.array(content.get("rectification_matrix", {}).get("data", np.eye(3)), dtype=np.float64)
    rotation = _rotation(path, rectification.reshape(3, 3)).T
    baseline = -projection[0, 3] / projection[0, 0]
    missing = [name for name in ("left", "right") if name not in names]
    if missing or not math.isfinite(baseline):
        raise EditError(
            f"{path} does not name the frames of the cameras",
            hint="Give them after the file: left=left_optical_frame right=right_optical_frame.",
        )
    return [(names["left"], names["right"], (baseline, 0.0, 0.0, *_quaternion(rotation)))]


def _number(value: Any) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise EditError(f"{value!r} is not a finite number")
    return number
