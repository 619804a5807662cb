"""TF019: quaternions that are no rotations, and numbers that are none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.transforms import NORM_TOLERANCE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor.observation import Observation
    from coframe.doctor.transforms import Transforms

__all__ = ["CODE", "find"]

CODE = "TF019"
# What is calculated in single precision is off by less.
_ROUNDING = 1e-6
_NORMALIZE = "normalise before sending: q / numpy.linalg.norm(q)"


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a link and a kind."""
    told = observation.transforms
    if not len(told):
        return
    with np.errstate(invalid="ignore", over="ignore"):
        off = np.abs(np.sqrt(told.squared_norms) - 1.0)
        zero = told.finite & (told.squared_norms == 0.0)
        refused = told.finite & ~zero & (np.abs(told.squared_norms - 1.0) >= NORM_TOLERANCE)
        rounded = told.finite & ~zero & ~refused & (off > _ROUNDING)
    yield from _kind(
        told,
        ~told.finite,
        Severity.ERROR,
        "{count} of {all} transforms hold NaN or infinity: tf2 refuses them",
        "Find the division by zero or the field that was never set, and check before sending: "
        "if all(map(math.isfinite, values)): broadcaster.sendTransform(t)",
        off,
    )
    yield from _kind(
        told,
        zero,
        Severity.ERROR,
        "{count} of {all} transforms have the quaternion 0, 0, 0, 0, that of a message whose rotation was never set: "
        "tf2 refuses them",
        "Set it: t.transform.rotation.w = 1.0",
        off,
    )
    yield from _kind(
        told,
        refused,
        Severity.ERROR,
        "{count} of {all} transforms have a quaternion that is no rotation, its length is off by up to {off:.3g}: "
        "tf2 refuses them",
        f"Check the order, x, y, z, w, and {_NORMALIZE}.",
        off,
    )
    yield from _kind(
        told,
        rounded,
        Severity.NOTE,
        "{count} of {all} quaternions are not quite of length 1, by up to {off:.2g}: tf2 takes them",
        f"Write more digits (0.70710678 instead of 0.707), or {_NORMALIZE}.",
        off,
        "It adds up along a chain of links, and other programs are stricter than tf2, which takes half a percent.",
    )


def _kind(
    told: Transforms,
    which: NDArray[np.bool_],
    severity: Severity,
    text: str,
    fix: str,
    off: NDArray[np.float64],
    harm: str = "",
) -> Iterator[Finding]:
    rows = np.flatnonzero(which)
    for link in np.unique(told.link[rows]).tolist():
        mine = rows[told.link[rows] == link]
        parent, child = told.pair(link)
        worst = float(off[mine].max()) if np.isfinite(off[mine]).all() else float("nan")
        yield Finding(
            code=CODE,
            severity=severity,
            text=text.format(count=len(mine), all=int(np.count_nonzero(told.link == link)), off=worst),
            fix=fix,
            harm=harm,
            edge=(parent.lstrip("/"), child.lstrip("/")),
            first_stamp=int(told.stamp[mine[0]]),
            publishers=told.senders(mine),
        )
