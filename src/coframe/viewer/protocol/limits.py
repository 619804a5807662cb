# SPDX-License-Identifier: Apache-2.0
"""Limits of numbers in the viewer's protocol, for use in ``Annotated``."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Clamp", "Range"]


class Range(NamedTuple):
    """The smallest and the largest valid number; other numbers are errors."""

    smallest: float
    largest: float


class Clamp(NamedTuple):
    """The smallest and the largest number that has an effect; other numbers are set to the nearer of the two."""

    smallest: float
    largest: float
