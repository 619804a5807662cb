# SPDX-License-Identifier: Apache-2.0
"""Read static transforms from numbers, robot descriptions, calibration files and other recordings."""

from __future__ import annotations

import math
import shlex
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe._base_error import CoframeError
from coframe._files.os_errors import reason
from coframe.bags.editing._calibrations import calibrated_transforms
from coframe.bags.formats import is_recording
from coframe.bags.recording import open_bag
from coframe.errors import EditError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from coframe.bags.editing._survey import Survey

__all__ = ["StaticTransform", "parse_pose", "read_static_transforms", "split_words"]

_YAML, _ROBOTS = {".yaml", ".yml"}, {".urdf", ".xacro", ".xml"}
_MIN_LENGTH = 1e-6  # of a quaternion that is normalized


class StaticTransform(NamedTuple):
    """A static transform.

    Attributes:
        parent: The parent frame.
        child: The child frame.
        pose: x, y, z in meters and qx, qy, qz, qw.
    """

    parent: str
    child: str
    pose: tuple[float, ...]


def split_words(text: str) -> list[str]:
    """Return the words of a value, in which quotes keep spaces together.

    Raises:
        EditError: A quote has no end.
    """
    try:
        return shlex.split(text)
    except ValueError as error:
        raise EditError(f"{text[:60]!r}: {error}") from None


def parse_pose(words: Sequence[str]) -> tuple[float, ...]:
    """Return the pose for x, y, z and roll, pitch, yaw in radians, or for x, y, z, qx, qy, qz, qw.

    Raises:
        EditError: These are not six or seven finite numbers, or the quaternion is 0.
    """
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = [math.nan]
    if len(numbers) not in {6, 7} or not all(map(math.isfinite, numbers)):
        raise EditError(
            f"{' '.join(words)[:80]!r} is not a pose: x y z roll pitch yaw in meters and radians, or x y z qx qy qz qw"
        )
    rotation = quaternion.from_rpy(np.array(numbers[3:])) if len(numbers) == 6 else np.array(numbers[3:])
    length = float(np.linalg.norm(rotation))
    if length < _MIN_LENGTH:
        raise EditError(f"the quaternion in {' '.join(words)[:80]!r} is 0")
    # Adding 0.0 turns -0.0 into 0.0.
    return tuple(value + 0.0 for value in [*numbers[:3], *(rotation / length).tolist()])


def read_static_transforms(path: Path, names: dict[str, str], survey: Survey) -> list[StaticTransform]:
    """Return the static transforms in a file.

    Args:
        path: A robot description, a calibration file or a recording.
        names: The frames of cameras and other sensors that the file names in another way.
        survey: The recording that is edited, for the frames of topics that a calibration names.

    Raises:
        EditError: There are none, or the file cannot be read.
    """
    try:
        found = _read(path, names, survey)
    except EditError:
        raise
    except CoframeError as error:
        raise EditError(str(error), hint=error.hint) from error
    except OSError as error:
        raise EditError(f"{path} cannot be read: {reason(error)}") from None
    found = [
        mount._replace(parent=names.get(mount.parent, mount.parent), child=names.get(mount.child, mount.child))
        for mount in found
    ]
    if not found:
        raise EditError(f"{path} contains no static transforms")
    return found


def _read(path: Path, names: dict[str, str], survey: Survey) -> list[StaticTransform]:
    if path.is_dir() or is_recording(path):
        return _of_recording(path)
    if path.suffix.lower() in _YAML:
        return [StaticTransform(*mount) for mount in calibrated_transforms(path, names, survey)]
    if path.suffix.lower() in _ROBOTS:
        return _of_robot(path)
    raise EditError(
        f"{path} has no static transforms: give a robot description (.urdf, .xacro), a calibration (.yaml) "
        "or a recording"
    )


def _of_recording(path: Path) -> list[StaticTransform]:
    with open_bag(path) as other:
        return [
            StaticTransform(edge.parent, edge.child, other.buffer.lookup(edge.parent, edge.child).values)
            for edge in other.buffer.edges()
            if edge.static and edge.parent
        ]


def _of_robot(path: Path) -> list[StaticTransform]:
    from coframe.robots.files import load  # noqa: PLC0415 - slow import, and rarely needed

    return [
        StaticTransform(joint.parent, joint.child, joint.origin.values)
        for joint in load(path).joints.values()
        if joint.type == "fixed"
    ]
