# SPDX-License-Identifier: Apache-2.0
"""Numbers, matrices and poses in calibration files, checked; each error names the file and the place in it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from coframe import quaternion
from coframe.cameras import CameraModel, lens_of
from coframe.errors import CalibrationError, CameraError
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["OPENGL_TO_OPTICAL", "Place", "camera"]

_MAX_ROTATION_ERROR = 5e-3  # of a matrix with three decimals
_MAX_SCALE = 1e6
OPENGL_TO_OPTICAL = np.diag([1.0, -1.0, -1.0, 1.0])
"""The axes of OpenGL and Blender (x right, y up, z backward) and those of an optical frame in each other."""


class Place:
    """A value in a file, with the path to it for errors: ``camchain.yaml: cam0.T_cam_imu``."""

    def __init__(self, value: Any, file: str, path: str = "") -> None:
        self.value = value
        self.file = file
        self.path = path

    def fail(self, reason: str, hint: str = "") -> NoReturn:
        """Raise an error about this value."""
        raise CalibrationError(f"{self.file}: {self.path + ' ' if self.path else ''}{reason}", hint=hint)

    def __contains__(self, key: str) -> bool:
        return isinstance(self.value, dict) and key in self.value

    def __getitem__(self, key: str) -> Place:
        if key not in self:
            self.fail(f"has no {key!r}")
        return Place(self.value[key], self.file, f"{self.path}.{key}" if self.path else key)

    def items(self) -> list[tuple[str, Place]]:
        """Return the keys and values of a mapping."""
        if not isinstance(self.value, dict):
            self.fail("is not a mapping")
        return [(str(key), Place(each, self.file, f"{self.path}.{key}" if self.path else str(key)))
                for key, each in self.value.items()]  # fmt: skip

    def elements(self) -> list[Place]:
        """Return the elements of a list."""
        if not isinstance(self.value, list):
            self.fail("is not a list")
        return [Place(each, self.file, f"{self.path}[{number}]") for number, each in enumerate(self.value)]

    def number(self) -> float:
        """Return a finite number."""
        try:
            found = float(self.value)
        except (TypeError, ValueError, OverflowError):
            self.fail(f"is not a number: {str(self.value)[:60]!r}")
        if not math.isfinite(found) or isinstance(self.value, bool):
            self.fail(f"is not a finite number: {self.value!r}")
        return found

    def integer(self) -> int:
        """Return a whole number of pixels."""
        found = self.number()
        if found != round(found) or not 0 <= found < 1 << 31:
            self.fail(f"is not an integer of at least 0: {self.value!r}")
        return int(found)

    def text(self) -> str:
        """Return a text."""
        if not isinstance(self.value, str):
            self.fail(f"is not a string: {str(self.value)[:60]!r}")
        return self.value

    def numbers(self, *counts: int) -> Array:
        """Return finite numbers, of any of some counts; nested lists are flattened."""
        value = self.value["data"] if isinstance(self.value, dict) and "data" in self.value else self.value
        try:
            found = np.array(value, np.float64).ravel()
        except (TypeError, ValueError, OverflowError):
            self.fail(f"is not a list of numbers: {str(value)[:60]!r}")
        if counts and len(found) not in counts:
            self.fail(f"has {len(found)} numbers, not {' or '.join(map(str, counts))}")
        if not np.isfinite(found).all():
            self.fail("contains numbers that are not finite")
        return found

    def matrix(self) -> Transform:
        """Return the rigid motion of a 3x4 or 4x4 matrix."""
        found = self.numbers(12, 16).reshape(-1, 4)
        if len(found) == 4 and np.abs(found[3] - [0.0, 0.0, 0.0, 1.0]).max() > _MAX_ROTATION_ERROR:
            self.fail(f"has the last row {found[3].tolist()}, not 0, 0, 0, 1", "Is the matrix transposed?")
        return self.rigid(found[:3, :3], found[:3, 3])

    def rigid(self, rotation: Array, translation: Array) -> Transform:
        """Return the rigid motion of a rotation matrix (3, 3), whose rounded numbers are made orthogonal."""
        if np.abs(rotation).max() > _MAX_SCALE:
            self.fail("is not a rotation: its numbers are too large")
        deviation = float(np.abs(rotation @ rotation.T - np.eye(3)).max())
        if deviation > _MAX_ROTATION_ERROR or np.linalg.det(rotation) < 0.0:
            scale = float(np.cbrt(abs(np.linalg.det(rotation))))
            reason = "mirrors the axes" if np.linalg.det(rotation) < 0.0 else f"is scaled by about {scale:.4g}"
            self.fail(f"is not a rotation: it {reason}")
        left, _, right = np.linalg.svd(rotation)
        return Transform(translation, quaternion.from_matrix(left @ right))

    def pose(self, translation: Sequence[float] | Array, xyzw: Sequence[float] | Array) -> Transform:
        """Return the rigid motion of a quaternion x, y, z, w."""
        with np.errstate(over="ignore"):
            length = float(np.linalg.norm(xyzw))
        if not abs(length - 1.0) <= _MAX_ROTATION_ERROR:
            self.fail(f"has a quaternion with the norm {length:.4g}, not 1")
        return Transform(translation, xyzw)

    def fields(self, names: str) -> Array:
        """Return the values of several keys of a mapping as numbers."""
        return np.array([self[name].number() for name in names.split()])


def camera(
    place: Place,
    size: tuple[int, int],
    focal: Sequence[float] | Array,
    lens: tuple[str, Sequence[float] | Array],
    frame: str,
    others: Mapping[str, Any] | None = None,
) -> CameraModel:
    """Return the camera with fx, fy, cx, cy, a lens by its name and coefficients, and the matrices r and p."""
    fx, fy, cx, cy = (float(value) for value in focal)
    if not (fx > 0.0 and fy > 0.0):
        place.fail(f"has the focal lengths {fx:g} and {fy:g}, which must be positive")
    k = np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])
    try:
        return CameraModel(*size, k, lens_of(lens[0], list(lens[1])), frame=frame, **(others or {}))
    except CameraError as error:
        place.fail(f"cannot be used: {error}", error.hint)
