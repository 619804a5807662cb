# SPDX-License-Identifier: Apache-2.0
"""The names of the two ways to interpolate between poses."""

from __future__ import annotations

from typing import Literal, TypeAlias

__all__ = ["Interpolation", "is_screw"]

Interpolation: TypeAlias = Literal["decoupled", "screw"]


def is_screw(interpolation: str) -> bool:
    """Return whether poses are interpolated along screws.

    Raises:
        ValueError: The name of the interpolation is unknown.
    """
    if interpolation not in {"decoupled", "screw"}:
        raise ValueError(f"interpolation must be 'decoupled' or 'screw', not {interpolation!r}")
    return interpolation == "screw"
