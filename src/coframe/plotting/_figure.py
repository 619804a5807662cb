# SPDX-License-Identifier: Apache-2.0
"""Figures: curves over time, in one panel for each unit, written as SVG, PNG or HTML."""

from __future__ import annotations

import datetime
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from coframe._files.complete_files import write_complete
from coframe.errors import PlotError
from coframe.time import SECOND

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

__all__ = ["COLORS", "FIGURE_FORMATS", "Figure", "Series", "figure_format"]

FIGURE_FORMATS = ("svg", "png", "html")
# Each has a contrast of at least 3.5 with a white and with a dark background.
COLORS = ("#2f7de1", "#d9542b", "#1f9a5b", "#a45ee0", "#a17a12", "#d6497f", "#128f9e", "#7b7f87")
MAX_DRAWN_VALUE = 1e300  # Plotting libraries compute differences of values, which could otherwise overflow.
_EARLIEST_DATE = 1_000_000_000 * SECOND  # Earlier stamps are assumed to come from simulations.


@dataclass(frozen=True, eq=False)
class Series:
    """A curve.

    Attributes:
        label: Its name in the legend.
        stamps: (N,) nanoseconds, in order; or numbers of poses if the figure has no time.
        values: (N,); NaN is a gap in the curve.
        panel: The title of the axis of the values, with the unit in brackets. Series with the same title share a panel.
        skipped: The number of messages without a value, because they are damaged or lack the element.
    """

    label: str
    stamps: NDArray[np.int64]
    values: NDArray[np.float64]
    panel: str
    skipped: int = 0

    @property
    def drawn(self) -> NDArray[np.float64]:
        """The values with those that cannot be drawn as gaps: infinite ones and those above `MAX_DRAWN_VALUE`."""
        return np.where(np.abs(self.values) <= MAX_DRAWN_VALUE, self.values, np.nan)


@dataclass(frozen=True, eq=False)
class Figure:
    """Curves over time.

    Attributes:
        title: The title of the plot.
        series: The curves.
        has_time: False if the curves are drawn over numbers of poses.
    """

    title: str
    series: list[Series] = field(default_factory=list)
    has_time: bool = True

    @property
    def panels(self) -> dict[str, list[Series]]:
        """The curves by the title of their axis, in the order of their first curve."""
        panels: dict[str, list[Series]] = {}
        for each in self.series:
            panels.setdefault(each.panel, []).append(each)
        return panels

    @property
    def origin(self) -> int:
        """The stamp at which the time axis begins, in nanoseconds: the first stamp of all curves."""
        first = [int(each.stamps[0]) for each in self.series if each.stamps.size]
        return min(first, default=0) if self.has_time else 0

    @property
    def x_title(self) -> str:
        """The title of the horizontal axis."""
        if not self.has_time:
            return "pose"
        if self.origin < _EARLIEST_DATE:
            return f"time since {self.origin / SECOND:g} s [s]"
        date = datetime.datetime.fromtimestamp(self.origin // SECOND, datetime.timezone.utc)
        milliseconds = self.origin % SECOND // 1_000_000
        return f"time since {date:%Y-%m-%d %H:%M:%S}.{milliseconds:03d} UTC [s]"

    def x_values(self, series: Series) -> NDArray[np.float64]:
        """Return the positions of a curve's values on the horizontal axis."""
        return np.asarray((series.stamps - self.origin) / (SECOND if self.has_time else 1))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the figure. Its suffix selects the format: ``.svg``, ``.png`` or ``.html``.

        An HTML file contains everything that it needs: it works without a network, zooms, and follows the light or dark
        theme of the browser.

        Raises:
            PlotError: The suffix is unknown, or the package matplotlib (for SVG and PNG) is not installed.
            OSError: The file cannot be written.
        """
        kind = figure_format(path)
        if kind == "html":
            from coframe.plotting._html_page import as_html  # noqa: PLC0415 - reads files

            content = as_html(self).encode(errors="backslashreplace")
        else:
            from coframe.plotting.image import as_image  # noqa: PLC0415 - needs an extra package

            content = as_image(self, kind)
        write_complete(path, content)


def figure_format(path: str | os.PathLike[str]) -> str:
    """Return the format for a file name.

    Raises:
        PlotError: The suffix is not a plot format.
    """
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in FIGURE_FORMATS:
        known = ", ".join(f".{each}" for each in FIGURE_FORMATS)
        raise PlotError(f"Unknown suffix of {str(path)!r}", hint=f"Known suffixes of plots: {known}.")
    return kind
