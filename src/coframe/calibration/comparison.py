# SPDX-License-Identifier: Apache-2.0
"""Compare two calibrations: how far each mount and camera differs, and the mistake that explains it."""

from __future__ import annotations

import re
from math import pi
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe._output.formatting import did_you_mean
from coframe.analysis.tree import FrameTrees
from coframe.doctor.pose_mistakes import explain_mutual_difference
from coframe.errors import CalibrationError, TransformException

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from coframe.calibration.rig import Rig
    from coframe.cameras import CameraModel

__all__ = ["CameraDifference", "Difference", "MountDifference", "OffsetDifference", "Tolerance", "compare_rigs"]

_DEGREE = pi / 180.0
# Two calibrations of one rig by different programs agree within these limits; a mistake must explain more.
_MAX_CAUSE_DISTANCE = 5e-3  # meters
_MAX_CAUSE_ANGLE = 0.3 * _DEGREE
_GRID_POINTS = 15  # points along each side of an image that are compared
_LIMIT_PATTERN = re.compile(r"([\d.]+(?:e-?\d+)?)\s*(mm|cm|m|deg|rad|px|ms|us|s)")
_UNIT_FACTORS = {
    "mm": 1e-3,
    "cm": 1e-2,
    "m": 1.0,
    "deg": _DEGREE,
    "rad": 1.0,
    "px": 1.0,
    "us": 1e-6,
    "ms": 1e-3,
    "s": 1.0,
}


class Tolerance(NamedTuple):
    """The differences that are accepted: meters, radians, pixels and seconds."""

    meters: float = 1e-3
    radians: float = 0.1 * _DEGREE
    pixels: float = 0.5
    seconds: float = 1e-3

    @classmethod
    def parse(cls, text: str) -> Tolerance:
        """Return the tolerance from a string such as ``5mm,0.2deg``. A missing part keeps its default.

        Raises:
            ValueError: A part is not a positive number with a unit: mm, cm, m, deg, rad, px, us, ms or s.

        Example:
            >>> Tolerance.parse("5mm,0.5px").meters
            0.005
        """
        values = {}
        for part in text.split(","):
            match = _LIMIT_PATTERN.fullmatch(part.strip())
            if not match:
                raise ValueError(f"{part.strip()!r} is not a number with one of the units {', '.join(_UNIT_FACTORS)}")
            unit = match[2]
            field = {"deg": "radians", "rad": "radians", "px": "pixels"}.get(
                unit, "meters" if unit.endswith("m") else "seconds"
            )
            values[field] = float(match[1]) * _UNIT_FACTORS[unit]
        return cls(**values)


class MountDifference(NamedTuple):
    """The difference of a mount: meters and radians, and what explains it.

    Attributes:
        parent: The parent frame.
        child: The child frame.
        meters: The distance between both positions of the child.
        radians: The angle between both rotations.
        cause: A sentence about the mistake that explains the difference, or "".
        fix: What to do about it, or "".
    """

    parent: str
    child: str
    meters: float
    radians: float
    cause: str = ""
    fix: str = ""

    def exceeds(self, tolerance: Tolerance) -> bool:
        """Return whether the difference is larger than a tolerance."""
        return self.meters > tolerance.meters or self.radians > tolerance.radians


class CameraDifference(NamedTuple):
    """The largest difference of the pixels of one ray, or the reason why two cameras cannot be compared."""

    camera: str
    pixels: float
    reason: str = ""

    def exceeds(self, tolerance: Tolerance) -> bool:
        """Return whether the difference is larger than a tolerance."""
        return bool(self.reason) or self.pixels > tolerance.pixels


class OffsetDifference(NamedTuple):
    """The difference of a time offset in seconds."""

    frame: str
    seconds: float
    cause: str = ""

    def exceeds(self, tolerance: Tolerance) -> bool:
        """Return whether the difference is larger than a tolerance."""
        return abs(self.seconds) > tolerance.seconds


class Difference(NamedTuple):
    """How two calibrations differ.

    Attributes:
        mounts: The mounts that both have.
        cameras: The cameras that both have.
        offsets: The time offsets that both have.
        only_first: Frames and cameras that only the first one has.
        only_second: Frames and cameras that only the second one has.
    """

    mounts: tuple[MountDifference, ...]
    cameras: tuple[CameraDifference, ...]
    offsets: tuple[OffsetDifference, ...]
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]

    def exceeds(self, tolerance: Tolerance) -> bool:
        """Return whether any difference is larger than a tolerance."""
        parts: tuple[MountDifference | CameraDifference | OffsetDifference, ...]
        parts = (*self.mounts, *self.cameras, *self.offsets)
        return any(part.exceeds(tolerance) for part in parts)


def compare_rigs(first: Rig, second: Rig, renamed: Mapping[str, str] | None = None) -> Difference:
    """Return how two calibrations differ.

    Args:
        first: The calibration that is taken for right.
        second: The other one.
        renamed: Names of frames and cameras in the first one, by their names in the second one.

    Raises:
        CalibrationError: They have no frame pair and no camera in common.
    """
    names = dict(renamed or {})
    known = {*second.frames, *second.cameras}
    for name in names:
        if name not in known:
            raise CalibrationError(f"no frame or camera {name!r} in the second calibration{did_you_mean(name, known)}")
    back = {new: old for old, new in names.items()}
    mounts = tuple(_mount_differences(first, second, back))
    own = {back.get(name, name): name for name in first.cameras}
    cameras = tuple(
        _camera_difference(name, first.cameras[name], second.cameras[second_buffer])
        for second_buffer, name in own.items()
        if second_buffer in second.cameras
    )
    offsets = tuple(
        _offset_difference(name, first.time_offsets[name], second.time_offsets[back.get(name, name)])
        for name in first.time_offsets
        if back.get(name, name) in second.time_offsets
    )
    if not mounts and not cameras:
        have = [f"{', '.join([*rig.frames, *rig.cameras][:8]) or 'none'}" for rig in (first, second)]
        raise CalibrationError(
            f"the calibrations have no two frames and no camera in common: the first one has {have[0]}; the second one "
            f"has {have[1]}",
            hint="Name frames that are the same: `coframe calib diff A B --rename NAME_IN_B=NAME_IN_A`.",
        )
    in_first = {*first.frames, *first.cameras}
    in_second = {names.get(name, name) for name in known}
    return Difference(
        mounts,
        cameras,
        offsets,
        tuple(sorted(in_first - in_second)),
        tuple(sorted(in_second - in_first)),
    )


def _mount_differences(first: Rig, second: Rig, names: Mapping[str, str]) -> list[MountDifference]:
    """Return the differences of each common frame relative to the next common frame above it, in the first rig."""
    first_buffer, second_buffer = first.buffer(), second.buffer()
    shared = {name for name in first.frames if names.get(name, name) in second.frames}
    tree = FrameTrees.from_parents({str(m.source): str(m.target) for m in first.transforms}, first.frames)
    found, roots = [], dict[str, str]()
    for child in first.frames:
        if child not in shared:
            continue
        above = [name for name in tree.path(child)[1:] if name in shared]
        # Frames without a common frame above them are compared with the first one of their tree.
        parent = above[0] if above else roots.setdefault(tree.root(child), child)
        if parent == child:
            continue
        try:
            expected = first_buffer.lookup(parent, child)
            published = second_buffer.lookup(names.get(parent, parent), names.get(child, child))
        except TransformException:
            continue
        found.append(_mount_difference(parent, child, np.array(expected.values), np.array(published.values)))
    return found


def _mount_difference(
    parent: str, child: str, expected: NDArray[np.float64], published: NDArray[np.float64]
) -> MountDifference:
    meters = float(np.linalg.norm(published[:3] - expected[:3]))
    angle = 2.0 * float(np.arctan2(*_sine_and_cosine(published[3:], expected[3:])))
    mutual = explain_mutual_difference(
        published[None], expected[None], meters=_MAX_CAUSE_DISTANCE, radians=_MAX_CAUSE_ANGLE
    )
    if mutual is None:
        return MountDifference(parent, child, meters, angle)
    cause, is_in_second = mutual
    text = cause.text("A", "B") if is_in_second else cause.text("B", "A")
    return MountDifference(parent, child, meters, angle, text, cause.fix)


def _sine_and_cosine(first: NDArray[np.float64], second: NDArray[np.float64]) -> tuple[float, float]:
    """Return the sine and cosine of half the angle between two rotations, exact also for small angles."""
    sign = 1.0 if float(first @ second) >= 0.0 else -1.0
    return float(np.linalg.norm(first - sign * second)) / 2.0, float(np.linalg.norm(first + sign * second)) / 2.0


def _camera_difference(name: str, first: CameraModel, second: CameraModel) -> CameraDifference:
    size = first.image_size if all(first.image_size) else second.image_size
    if all(first.image_size) and all(second.image_size) and first.image_size != second.image_size:
        (w1, h1), (w2, h2) = first.image_size, second.image_size
        return CameraDifference(name, float("nan"), f"images of {w1} x {h1} and of {w2} x {h2} pixels")
    if not all(size):
        size = (int(2 * first.k[0, 2]) + 1, int(2 * first.k[1, 2]) + 1)
    grid = np.stack(np.meshgrid(*(np.linspace(0, side - 1, _GRID_POINTS) for side in size)), axis=-1).reshape(-1, 2)
    second_pixels = second.project(first.rays(grid))
    distances = np.linalg.norm(second_pixels - grid, axis=1)
    if not np.isfinite(distances).any():
        return CameraDifference(name, float("nan"), "no ray is seen by both lenses")
    return CameraDifference(name, float(np.nanmax(distances)))


def _offset_difference(name: str, first: float, second: float) -> OffsetDifference:
    difference = second - first
    if abs(first) > 1e-4 and abs(second + first) < 0.1 * abs(first):
        return OffsetDifference(name, difference, "B has the other sign")
    return OffsetDifference(name, difference)
