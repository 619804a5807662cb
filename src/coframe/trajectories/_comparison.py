# SPDX-License-Identifier: Apache-2.0
"""Absolute and relative pose errors of an estimated trajectory (Sturm et al., 2012), with their statistics."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from coframe import quaternion
from coframe._output import html_tables
from coframe._output.formatting import count
from coframe.errors import TrajectoryError
from coframe.time import MILLISECOND, SECOND, duration_ns
from coframe.trajectories._alignment import (
    ALIGNMENTS,
    Alignment,
    align,
    align_origin,
    align_scale,
    check_positions,
)
from coframe.trajectories._association import MAX_DIFFERENCE, associate
from coframe.trajectories._offsets import BodyOffset, TimeShift, find_body_offset, find_time_shift
from coframe.trajectories._resampling import median_period, resample
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.time import DurationLike

__all__ = ["PLANES", "Comparison", "Delta", "PoseErrors", "Statistics", "compare_trajectories", "parse_delta"]

# The axis that a projection to a plane removes.
PLANES = {"xy": 2, "xz": 1, "yz": 0}
_NUMBER = re.compile(r"\s*(\d+(?:\.\d*)?|\.\d+)\s*([a-z]*)\s*", re.ASCII)
_FRAME_UNITS, _METER_UNITS = {"", "f", "frame", "frames"}, {"m", "meter", "meters", "metre", "metres"}


class Delta(NamedTuple):
    """The distance between the two poses of a relative error.

    Attributes:
        value: A number of poses, meters along the path of the estimate, or seconds between the stamps.
        unit: ``frames``, ``meters`` or ``seconds``.
    """

    value: float
    unit: Literal["frames", "meters", "seconds"] = "frames"

    def __str__(self) -> str:
        if self.unit == "frames":
            return count(int(self.value), "frame")
        return f"{self.value:g} {self.unit[0]}"


class Statistics(NamedTuple):
    """Statistics of errors, in the unit of the errors; ``sse``, the sum of squared errors, in its square."""

    rmse: float
    mean: float
    median: float
    std: float
    min: float
    max: float
    sse: float

    @classmethod
    def of(cls, errors: NDArray[np.float64]) -> Statistics:
        """Return the statistics of at least one error; ``std`` is the population standard deviation, as in NumPy."""
        squares = errors**2
        return cls(
            rmse=float(np.sqrt(squares.mean())),
            mean=float(errors.mean()),
            median=float(np.median(errors)),
            std=float(errors.std()),
            min=float(errors.min()),
            max=float(errors.max()),
            sse=float(squares.sum()),
        )


@dataclass(frozen=True)
class PoseErrors:
    """The errors of poses, or of motions between two poses.

    Attributes:
        translation: Distances in meters, (N,).
        rotation: Angles in radians, (N,).
        index: The index of the pose to which each error belongs, (N,); for a motion, its later pose.
    """

    translation: NDArray[np.float64]
    rotation: NDArray[np.float64]
    index: NDArray[np.intp]

    @property
    def translation_statistics(self) -> Statistics:
        """The statistics of the distances, in meters."""
        return Statistics.of(self.translation)

    @property
    def rotation_statistics(self) -> Statistics:
        """The statistics of the angles, in radians."""
        return Statistics.of(self.rotation)


@dataclass(frozen=True)
class Comparison:
    """The result of :func:`compare_trajectories`.

    Attributes:
        reference: The paired poses of the reference, (N,).
        estimate: The paired poses of the estimate after the alignment, (N,).
        alignment: The alignment that was applied to the estimate, or None without one.
        ape: The absolute pose errors, (N,).
        rpe: The relative pose errors, one for each pair of poses that are ``delta`` apart.
        delta: The distance between the poses of a relative error.
        body_offset: The constant pose between the frames of both trajectories, if it explains most of the error.
        time_shift: The constant difference between the clocks of both, if it explains most of the error.
        t_offset: What was added to the stamps of the estimate, in nanoseconds.
        applied_body_offset: The pose by which the poses of the estimate were multiplied, or None without one.
    """

    reference: Transform
    estimate: Transform
    alignment: Alignment | None
    ape: PoseErrors
    rpe: PoseErrors
    delta: Delta
    body_offset: BodyOffset | None = None
    time_shift: TimeShift | None = None
    t_offset: int = 0
    applied_body_offset: Transform | None = None

    def _repr_html_(self) -> str:
        statistics = {
            "APE, m": self.ape.translation_statistics,
            "APE, rad": self.ape.rotation_statistics,
            f"RPE over {self.delta}, m": self.rpe.translation_statistics,
            f"RPE over {self.delta}, rad": self.rpe.rotation_statistics,
        }
        rows = [(name, *(f"{value:.6g}" for value in values)) for name, values in statistics.items()]
        title = f"{count(len(self.reference), 'pair')} of poses"
        return html_tables.section(title, html_tables.table(("", *Statistics._fields), rows, len(rows)))

    def as_dict(self) -> dict[str, Any]:
        """Return the statistics and the alignment as a dictionary for JSON; meters and radians."""
        aligned = self.alignment and {
            "translation": self.alignment.transform.translation.tolist(),
            "quaternion": self.alignment.transform.quaternion.tolist(),
            "scale": self.alignment.scale,
        }
        return {
            "pairs": len(self.reference),
            "units": {"translation": "m", "rotation": "rad"},
            "alignment": aligned,
            "t_offset_ns": self.t_offset,
            "applied_body_offset": self.applied_body_offset
            and {
                "translation": self.applied_body_offset.translation.tolist(),
                "quaternion": self.applied_body_offset.quaternion.tolist(),
            },
            "ape": _as_dict(self.ape),
            "rpe": {"delta": self.delta.value, "delta_unit": self.delta.unit, **_as_dict(self.rpe)},
            "body_offset": self.body_offset
            and {
                "translation": self.body_offset.transform.translation.tolist(),
                "quaternion": self.body_offset.transform.quaternion.tolist(),
                "translation_rmse": list(self.body_offset.translation_rmse),
                "rotation_rmse": list(self.body_offset.rotation_rmse),
            },
            "time_shift": self.time_shift
            and {
                "offset_ns": self.time_shift.offset,
                "translation_rmse": list(self.time_shift.translation_rmse),
            },
        }


def compare_trajectories(
    reference: Transform,
    estimate: Transform,
    *,
    align: str = "none",
    max_difference: DurationLike = MAX_DIFFERENCE,
    delta: float | str | Delta = 1,
    t_offset: DurationLike | Literal["auto"] = 0,
    n_to_align: int | None = None,
    align_origin: bool = False,
    project: str | None = None,
    body_offset: Transform | None = None,
) -> Comparison:
    """Compare an estimated trajectory with a reference: absolute (APE) and relative (RPE) pose errors.

    The absolute error is the pose of the reference relative to the estimate. The relative error compares the motions of
    both between two poses that are ``delta`` apart; each pair begins where the previous one ends. The errors match
    those of evo.

    Args:
        reference: A batch of shape (N,), such as from :func:`read_trajectory` or :meth:`coframe.Buffer.trajectory`.
        estimate: A batch of shape (M,). The names of the frames are not compared.
        align: ``none``, ``se3`` for a rigid motion of the estimate, ``sim3`` to also scale it, ``scale`` to only scale
            it, ``hand-eye`` for a rigid motion and the constant pose between two frames of one body, such as a camera
            and a robot: what remains are the errors of two sensors on it.
        max_difference: The maximum difference between the stamps of two compared poses.
        delta: A number of poses, or a string for :func:`parse_delta`.
        t_offset: What to add to the stamps of the estimate: nanoseconds, or a string such as ``"-35ms"``; ``"auto"``
            for the shift of up to 2 s with the smallest translation error. The shifted estimate is interpolated at the
            stamps of the reference, but not over gaps of more than four periods.
        n_to_align: The number of pairs for the alignment, from the first one; None means all.
        align_origin: Whether to move the estimate so that the first poses are equal; not with ``se3`` and ``sim3``.
        project: The plane to which both are projected after the alignment: ``xy``, ``xz`` or ``yz``. Rotations are
            those about the axis that is perpendicular to it.
        body_offset: The pose of the reference's frame relative to the frame of the estimate, such as of a camera on a
            robot: the poses of the estimate are multiplied by it first. Not with ``align="hand-eye"``, which finds it.

    Raises:
        TrajectoryError: No stamps match, the alignment is not determined, no two poses are ``delta`` apart, or a
            position is too large for the computation.
        ValueError: An argument is not valid.

    Example:
        >>> import numpy as np
        >>> from coframe import Transform
        >>> angles, stamps = np.linspace(0, 3, 31), np.arange(31) * 100_000_000
        >>> circle = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
        >>> truth, moved = Transform(circle, stamp=stamps), Transform(circle + [1, 0, 0], stamp=stamps)
        >>> compare_trajectories(truth, moved).ape.translation_statistics.rmse
        1.0
        >>> round(compare_trajectories(truth, moved, align="se3").ape.translation_statistics.rmse, 9)
        0.0
    """
    _check_options(align, n_to_align, project, align_origin=align_origin)
    if align == "hand-eye" and body_offset is not None:
        raise ValueError("align='hand-eye' estimates the body offset: give one of them")
    for name, poses in (("reference", reference), ("estimate", estimate)):
        if len(poses.shape) != 1 or not len(poses):
            raise ValueError(f"The {name} must be a batch of shape (N,) with at least one pose, not {poses.shape}.")
        check_positions(poses)
    checked_delta = _checked_delta(delta)
    if body_offset is not None:
        estimate = estimate @ body_offset.replace(target=estimate.source, source=estimate.source, stamp=None)
    method = _Method(align, n_to_align, align_origin)
    if t_offset == "auto":
        shift = _best_shift(reference, estimate, method)
        shifted = resample(_shift_stamps(estimate, shift), np.asarray(reference.stamps))
        estimate = shifted if len(shifted) else _shift_stamps(estimate, shift)
    else:
        shift = _signed_duration(t_offset)
        estimate = _shift_stamps(estimate, shift)
    if align == "hand-eye":
        body_offset = _best_body_offset(*_associate_poses(reference, estimate, method, max_difference), method)
        estimate = estimate @ body_offset
    every = reference, estimate
    reference, estimate = _associate_poses(*every, method, max_difference)
    time_shift, found = _constant_differences(*every, method, max_difference)
    if time_shift is not None:
        time_shift = time_shift._replace(offset=time_shift.offset + shift)
    if found is not None and body_offset is not None:
        found = found._replace(transform=body_offset.replace(target=None, source=None, stamp=None) @ found.transform)
    alignment = method.alignment(reference, estimate)
    estimate = estimate if alignment is None else alignment.apply(estimate)
    if project is not None:
        reference, estimate = _project_poses(reference, PLANES[project]), _project_poses(estimate, PLANES[project])
    return Comparison(
        reference,
        estimate,
        alignment,
        _absolute_errors(reference, estimate),
        _relative_errors(reference, estimate, checked_delta),
        checked_delta,
        found,
        time_shift,
        shift,
        None if body_offset is None else body_offset.replace(target=None, source=None, stamp=None),
    )


class _Method(NamedTuple):
    """How the estimate is aligned."""

    align: str
    pairs: int | None
    origin: bool

    def alignment(self, reference: Transform, estimate: Transform) -> Alignment | None:
        """Return the alignment of paired poses, or None without one."""
        first = slice(None, self.pairs)
        used = reference[first], estimate[first]
        if self.align in {"se3", "sim3", "hand-eye"}:
            return align(*used, with_scale=self.align == "sim3")
        scaled = align_scale(*used) if self.align == "scale" else None
        if self.origin:
            return align_origin(reference, estimate, scale=1.0 if scaled is None else scaled.scale)
        return scaled


def _check_options(align: str, n_to_align: int | None, project: str | None, *, align_origin: bool) -> None:
    if align not in ALIGNMENTS:
        raise ValueError(f"No alignment named {align!r}. Alignments: {', '.join(ALIGNMENTS)}.")
    if align_origin and align in {"se3", "sim3", "hand-eye"}:
        raise ValueError(f"align={align!r} and align_origin are mutually exclusive: give one of them")
    if n_to_align is not None and n_to_align < 1:
        raise ValueError(f"n_to_align must be at least 1, not {n_to_align}")
    if project is not None and project not in PLANES:
        raise ValueError(f"No plane named {project!r}. Planes: {', '.join(PLANES)}.")


def _signed_duration(given: DurationLike) -> int:
    """Return a duration in nanoseconds, which may be negative."""
    if isinstance(given, str):
        text = given.strip()
        return -duration_ns(text[1:]) if text.startswith("-") else duration_ns(text.removeprefix("+"))
    return int(given) if isinstance(given, int) else duration_ns(given)


def _shift_stamps(poses: Transform, offset: int) -> Transform:
    if poses.stamps is None or not offset:
        return poses
    return poses.replace(stamp=poses.stamps + offset)


def _best_shift(reference: Transform, estimate: Transform, method: _Method) -> int:
    """Return the time shift with the smallest error in nanoseconds, 0 if no other one is better."""
    if reference.stamps is None or estimate.stamps is None:
        raise TrajectoryError(
            "No time offset can be estimated: a trajectory has no stamps", hint="Give it as a duration, or omit it."
        )
    with_offset = method.align == "hand-eye"
    found = find_time_shift(reference, estimate, method.alignment, with_offset=with_offset, always=True)
    return 0 if found is None else found.offset


def _best_body_offset(reference: Transform, estimate: Transform, method: _Method) -> Transform:
    found = find_body_offset(reference, estimate, method.alignment, always=True)
    if found is None:
        raise TrajectoryError(
            f"No body offset can be estimated from {count(len(reference), 'pair')} of poses: too few, or on one line",
            hint="Use a trajectory with turns, or another alignment.",
        )
    return found.transform


def _associate_poses(
    reference: Transform, estimate: Transform, method: _Method, max_difference: DurationLike
) -> tuple[Transform, Transform]:
    """Return the pairs of poses; the error for none names the time shift after which both are alike."""
    try:
        return associate(reference, estimate, max_difference)
    except TrajectoryError as error:
        shift = find_time_shift(reference, estimate, method.alignment)
        if shift is None:
            raise
        hint = (
            f"Both are alike after a time shift: add {shift.offset / MILLISECOND:.3f} ms to the stamps of the estimate."
        )
        raise TrajectoryError(str(error).partition("\nHint:")[0], hint=hint) from None


def _constant_differences(
    reference: Transform, estimate: Transform, method: _Method, max_difference: DurationLike
) -> tuple[TimeShift | None, BodyOffset | None]:
    """Return a time shift and a body offset that explain most of the errors."""
    offset = find_body_offset(*associate(reference, estimate, max_difference), method.alignment)
    shift = find_time_shift(reference, estimate, method.alignment, with_offset=offset is not None)
    if shift is None:
        return None, offset
    # The shift may lie between the stamps.
    nearest = max(duration_ns(max_difference), *map(median_period, (reference, estimate)))
    with suppress(TrajectoryError):
        offset = find_body_offset(
            *associate(reference, _shift_stamps(estimate, shift.offset), nearest), method.alignment
        )
    return shift, offset


def _project_poses(poses: Transform, axis: int) -> Transform:
    """Return poses without the coordinate along an axis, and with only the rotation about it."""
    positions, angles = poses.translation.copy(), np.zeros((len(poses), 3))
    positions[:, axis] = 0.0
    angles[:, axis] = poses.rpy[:, axis]
    return Transform(
        positions, quaternion.from_rpy(angles), target=poses.target, source=poses.source, stamp=poses.stamps
    )


def parse_delta(text: str) -> Delta:
    """Parse the distance between the poses of a relative error: ``10`` (poses), ``0.5m`` (meters), ``100ms``.

    Raises:
        ValueError: The text is none of these, or is not positive.

    Example:
        >>> parse_delta("10"), parse_delta("0.5m").unit, parse_delta("100ms").value
        (Delta(value=10, unit='frames'), 'meters', 0.1)
    """
    match = _NUMBER.fullmatch(text)
    if match and match[2] in _FRAME_UNITS | _METER_UNITS:
        value = float(match[1])
        is_meters = match[2] in _METER_UNITS
        if value > 0 and (is_meters or value.is_integer()):
            return Delta(value, "meters") if is_meters else Delta(int(value))
    elif match and (nanoseconds := duration_ns(text)) > 0:
        return Delta(nanoseconds / SECOND, "seconds")
    raise ValueError(
        f"{text!r} is not a distance between poses: write a positive number of poses (10), meters (0.5m) or a duration "
        "(100ms)"
    )


def _checked_delta(delta: float | str | Delta) -> Delta:
    if isinstance(delta, str):
        return parse_delta(delta)
    checked_delta = delta if isinstance(delta, Delta) else Delta(delta)
    is_whole = checked_delta.unit != "frames" or float(checked_delta.value).is_integer()
    if not checked_delta.value > 0 or not is_whole:
        raise ValueError(
            f"delta must be positive, and a whole number for poses, not {checked_delta.value:g} {checked_delta.unit}"
        )
    return checked_delta


def _as_dict(errors: PoseErrors) -> dict[str, Any]:
    return {
        "count": len(errors.translation),
        "translation": errors.translation_statistics._asdict(),
        "rotation": errors.rotation_statistics._asdict(),
    }


def _absolute_errors(reference: Transform, estimate: Transform) -> PoseErrors:
    distance = np.linalg.norm(estimate.translation - reference.translation, axis=1)
    rotation_difference = quaternion.multiply(quaternion.inverse(estimate.quaternion), reference.quaternion)
    return PoseErrors(distance, _rotation_angles(rotation_difference), np.arange(len(distance)))


def _relative_errors(reference: Transform, estimate: Transform, delta: Delta) -> PoseErrors:
    ends = _motion_ends(estimate, reference.stamps if estimate.stamps is None else estimate.stamps, delta)
    if len(ends) < 2:
        raise TrajectoryError(
            f"The relative error needs two poses that are {delta} apart; the {len(estimate)} paired poses have none",
            hint="Choose a smaller delta.",
        )
    (true_t, true_q), (found_t, found_q) = (_motions(poses, ends) for poses in (reference, estimate))
    inverse = quaternion.inverse(true_q)
    distance = np.linalg.norm(quaternion.rotate(inverse, found_t - true_t), axis=1)
    return PoseErrors(distance, _rotation_angles(quaternion.multiply(inverse, found_q)), ends[1:])


def _motions(poses: Transform, ends: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return translations and rotations of the motions from each pose in `ends` to the next one."""
    t, q = poses.translation[ends], poses.quaternion[ends]
    inverse = quaternion.inverse(q[:-1])
    return quaternion.rotate(inverse, t[1:] - t[:-1]), quaternion.multiply(inverse, q[1:])


def _motion_ends(poses: Transform, stamps: NDArray[np.int64] | None, delta: Delta) -> NDArray[np.intp]:
    """Return the indices at which the relative errors begin and end."""
    if delta.unit == "frames":
        return np.arange(0, len(poses), int(delta.value))
    if delta.unit == "seconds":
        if stamps is None:
            raise TrajectoryError(
                f"The trajectories have no stamps, so no poses are {delta} apart",
                hint="Give the delta as a number of poses or in meters.",
            )
        steps: list[float] = np.diff(stamps).tolist()
        limit: float = round(delta.value * SECOND)
    else:
        steps = np.linalg.norm(np.diff(poses.translation, axis=0), axis=1).tolist()
        limit = delta.value
    ends = [0]
    done: float = 0
    for index, step in enumerate(steps, start=1):
        done += step
        if done >= limit:
            ends.append(index)
            done = 0
    return np.array(ends, dtype=np.intp)


def _rotation_angles(q: NDArray[np.float64]) -> NDArray[np.float64]:
    angles: NDArray[np.float64] = 2.0 * np.arctan2(np.linalg.norm(q[:, :3], axis=1), np.abs(q[:, 3]))
    return angles
