# SPDX-License-Identifier: Apache-2.0
"""Thin curves with more points than a screen can show."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["extremes"]


def extremes(values: NDArray[np.float64], limit: int) -> NDArray[np.intp]:
    """Return the indices of about ``limit`` values: the minimum and maximum of equal parts, so that no peak is lost.

    Args:
        values: (N,); NaN is a gap.
        limit: The number of values to keep, at least 4; all indices are returned if there are no more values than this.

    Returns:
        The indices in order. They include the first and the last one.
    """
    if len(values) <= limit:
        return np.arange(len(values))
    size = -(-len(values) * 2 // limit)
    padded = np.full(-(-len(values) // size) * size, np.nan)
    padded[: len(values)] = values
    parts = padded.reshape(-1, size)
    starts = np.arange(len(parts)) * size
    smallest = starts + np.argmin(np.where(np.isnan(parts), np.inf, parts), axis=1)
    largest = starts + np.argmax(np.where(np.isnan(parts), -np.inf, parts), axis=1)
    return np.unique(np.concatenate([[0], smallest, largest, [len(values) - 1]]))
