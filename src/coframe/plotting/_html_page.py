# SPDX-License-Identifier: Apache-2.0
"""Figures as a page that contains its data and uPlot (MIT license), so that it works without a network."""

from __future__ import annotations

import json
from html import escape
from importlib.resources import files
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.plotting._figure import COLORS
from coframe.plotting.thinning import extremes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.plotting._figure import Figure

__all__ = ["MAX_POINTS", "as_html"]

MAX_POINTS = 50_000  # per curve; drawing more would be slow in a browser


def as_html(figure: Figure) -> str:
    """Return the page as text."""
    folder = files("coframe.plotting")
    colors = cycle(COLORS)
    panels = [
        {
            "title": title,
            "curves": [
                {"label": curve.label, "color": next(colors), **_points(figure.x_values(curve), curve.drawn)}
                for curve in curves
            ],
        }
        for title, curves in figure.panels.items()
    ]
    parts = {
        "TITLE": escape(figure.title),
        "LICENSE": folder.joinpath("uplot.LICENSE").read_text(encoding="utf-8").replace("--", "- -"),
        "UPLOT_CSS": folder.joinpath("uplot.min.css").read_text(encoding="utf-8"),
        "UPLOT_JS": folder.joinpath("uplot.min.js").read_text(encoding="utf-8"),
        # A label may contain the end tag of a script.
        "DATA": json.dumps({"x": figure.x_title, "panels": panels}).replace("<", "\\u003c"),
    }
    page = folder.joinpath("page.html").read_text(encoding="utf-8")
    head, *rest = page.split("@@")
    # Every second part is a name; inserted values are not searched for names again.
    return head + "".join(parts[part] if i % 2 == 0 else part for i, part in enumerate(rest))


def _points(x: NDArray[np.float64], values: NDArray[np.float64]) -> dict[str, Any]:
    kept = extremes(values, MAX_POINTS)
    thinned_x, thinned = x[kept], values[kept]
    return {
        "x": thinned_x.round(9).tolist(),
        "y": [value if np.isfinite(value) else None for value in thinned.tolist()],
        "of": len(values) if len(thinned) < len(values) else 0,
    }
