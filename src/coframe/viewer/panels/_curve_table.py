# SPDX-License-Identifier: Apache-2.0
"""Curves as CSV."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

import numpy as np

from coframe._output.escaping import csv_cell

if TYPE_CHECKING:
    from coframe.viewer.panels._ring import Points

__all__ = ["CurveTable"]


class CurveTable:
    """All points of several curves.

    Args:
        curves: The points by expression.
    """

    def __init__(self, curves: dict[str, Points]) -> None:
        self._curves = curves

    def as_csv(self) -> str:
        """Return one row per stamp in nanoseconds, with one column per curve. A cell without a value is empty."""
        stamps = np.unique(np.concatenate([each.times for each in self._curves.values()]))
        values = np.full((len(stamps), len(self._curves)), np.nan)
        for column, each in enumerate(self._curves.values()):
            values[np.searchsorted(stamps, each.times), column] = each.values
        output = io.StringIO()
        writer = csv.writer(output, lineterminator="\n")
        writer.writerow(["stamp_ns", *map(csv_cell, self._curves)])
        is_gap = np.isnan(values)
        for stamp, row, gaps in zip(stamps.tolist(), values.tolist(), is_gap.tolist(), strict=True):
            writer.writerow([stamp, *("" if gap else repr(value) for value, gap in zip(row, gaps, strict=True))])
        return output.getvalue()
