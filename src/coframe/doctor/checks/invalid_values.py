# SPDX-License-Identifier: Apache-2.0
"""TF019: quaternions that are not rotations, and values that are not finite."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor._finding import Finding, Severity
from coframe.doctor._transforms import NORM_TOLERANCE
from coframe.doctor.quaternion_causes import likely_cause

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor._transforms import Transforms
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF019"
# Quaternions computed in single precision deviate less.
_ROUNDING = 1e-6
_MAX_DROPPED = 0.5  # of the transforms of an edge that can be left out without a question
_NORMALIZE_ADVICE = "normalize it before publishing: q / numpy.linalg.norm(q)"


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per edge and kind of problem."""
    transforms = observation.transforms
    if not len(transforms):
        return
    with np.errstate(invalid="ignore", over="ignore"):
        deviations = np.abs(np.sqrt(transforms.squared_norms) - 1.0)
        zero = transforms.finite & (transforms.squared_norms == 0.0)
        refused = transforms.finite & ~zero & (np.abs(transforms.squared_norms - 1.0) >= NORM_TOLERANCE)
        rounded = transforms.finite & ~zero & ~refused & (deviations > _ROUNDING)
        # With the same mistake, quaternions of a moving edge can be nearly normalized at some angles.
        rounded &= ~np.isin(transforms.edge, transforms.edge[refused])
    yield from _kind(
        transforms,
        ~transforms.finite,
        Severity.ERROR,
        "{count} of {all} transforms contain NaN or infinity; tf2 rejects them",
        "Find the division by zero or the field that was not set, and check before publishing: "
        "if all(map(math.isfinite, values)): broadcaster.sendTransform(t)",
    )
    yield from _kind(
        transforms,
        zero,
        Severity.ERROR,
        "{count} of {all} transforms have the quaternion 0, 0, 0, 0, which means that the rotation was not set; tf2 "
        "rejects them",
        "Set the rotation: t.transform.rotation.w = 1.0",
    )
    yield from _kind(
        transforms,
        refused,
        Severity.ERROR,
        "{count} of {all} transforms have a quaternion that is not normalized: its length differs from 1 by up to "
        "{off:.3g}; "
        "tf2 rejects them",
        f"Check the order x, y, z, w, and {_NORMALIZE_ADVICE}.",
        explained=True,
    )
    yield from _kind(
        transforms,
        rounded,
        Severity.NOTE,
        "{count} of {all} quaternions are not exactly normalized: their length differs from 1 by up to {off:.2g}; "
        "tf2 accepts "
        "them",
        f"Use more digits (0.70710678 instead of 0.707), or {_NORMALIZE_ADVICE}.",
        "The error grows along the chain, and other programs are stricter than tf2, which accepts half a percent.",
    )


def _kind(
    transforms: Transforms,
    affected: NDArray[np.bool_],
    severity: Severity,
    text: str,
    fix: str,
    harm: str = "",
    *,
    explained: bool = False,
) -> Iterator[Finding]:
    rows = np.flatnonzero(affected)
    for number in np.unique(transforms.edge[rows]).tolist():
        own = rows[transforms.edge[rows] == number]
        parent, child = transforms.pair(number)
        cause = likely_cause(transforms.values[own, 3:]) if explained else None
        every = int(np.count_nonzero(transforms.edge == number))
        described = text.format(count=len(own), all=every, off=_largest_deviation(transforms.values[own, 3:]))
        yield Finding(
            code=CODE,
            severity=severity,
            text=f"{described}; {cause.text}" if cause else described,
            fix=cause.fix if cause else fix,
            harm=harm,
            edge=(parent.lstrip("/"), child.lstrip("/")),
            first_stamp=int(transforms.stamp[own[0]]),
            publishers=transforms.publishers_of(own),
            repairs=("drop-invalid",) if severity is Severity.ERROR and len(own) < _MAX_DROPPED * every else (),
            choices=("drop-invalid",) if severity is Severity.ERROR and len(own) >= _MAX_DROPPED * every else (),
        )


def _largest_deviation(quaternions: NDArray[np.float64]) -> float:
    """Return the largest difference of a quaternion's length from 1, (N, 4), without overflow."""
    x, y, z, w = quaternions.T
    return float(np.abs(np.hypot(np.hypot(x, y), np.hypot(z, w)) - 1.0).max())
