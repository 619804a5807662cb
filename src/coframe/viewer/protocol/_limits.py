# SPDX-License-Identifier: Apache-2.0
"""Numeric limits in the viewer's protocol, for use in ``Annotated``."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Clamp", "Range"]


class Range(NamedTuple):
    """The minimum and maximum. Other numbers are errors."""

    smallest: float
    largest: float


class Clamp(NamedTuple):
    """The minimum and maximum. Other numbers are clamped."""

    smallest: float
    largest: float
