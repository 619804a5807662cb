# SPDX-License-Identifier: Apache-2.0
"""Figures as SVG and PNG, drawn by matplotlib."""

from __future__ import annotations

import importlib
import io
from itertools import cycle
from typing import TYPE_CHECKING, Any

from coframe._process.optional_imports import importing_matplotlib, pip_install
from coframe.errors import PlotError
from coframe.plotting._figure import COLORS

if TYPE_CHECKING:
    from coframe.plotting._figure import Figure

__all__ = ["as_image", "check_installed"]

_WIDTH, _PANEL_HEIGHT, _TITLE_HEIGHT = 10.0, 2.8, 0.8  # inches
_STYLE = {"svg.fonttype": "none", "svg.hashsalt": "coframe", "axes.unicode_minus": False}


def check_installed() -> None:
    """Raise a PlotError unless matplotlib is installed."""
    try:
        with importing_matplotlib():
            importlib.import_module("matplotlib.figure")
    except ModuleNotFoundError:
        raise PlotError(
            "SVG and PNG plots need the package matplotlib, which is not installed",
            hint=f"{pip_install('plot')}, or write an .html file, which needs no package.",
        ) from None


def as_image(figure: Figure, kind: str) -> bytes:
    """Return the file as bytes; ``kind`` is ``svg`` or ``png``.

    Raises:
        PlotError: matplotlib is not installed.
    """
    check_installed()
    matplotlib: Any = importlib.import_module("matplotlib")
    drawing: Any = importlib.import_module("matplotlib.figure")
    panels = figure.panels
    size = (_WIDTH, _TITLE_HEIGHT + _PANEL_HEIGHT * len(panels))
    stream = io.BytesIO()
    with matplotlib.rc_context(_STYLE):
        image = drawing.Figure(figsize=size, layout="constrained")
        axes = image.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        image.suptitle(_escape_formula(figure.title), fontsize="medium")
        colors = cycle(COLORS)
        for axis, (title, curves) in zip(axes, panels.items(), strict=True):
            lines = []
            for curve in curves:
                is_single = curve.values.size == 1
                lines += axis.plot(
                    figure.x_values(curve),
                    curve.drawn,
                    color=next(colors),
                    linewidth=1.2,
                    marker="o" if is_single else None,
                )
            axis.set_ylabel(_escape_formula(title))
            axis.grid(alpha=0.3)
            # matplotlib omits labels that begin with an underscore.
            axis.legend(
                lines, [f"\N{ZERO WIDTH SPACE}{_escape_formula(curve.label)}" for curve in curves], fontsize="small"
            )
        axes[-1].set_xlabel(_escape_formula(figure.x_title))
        metadata = {"Date": None} if kind == "svg" else None
        image.savefig(stream, format=kind, dpi=120, metadata=metadata)
    return stream.getvalue()


def _escape_formula(text: str) -> str:
    """Return a string that matplotlib does not interpret as a formula, without characters that XML does not allow."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text).replace("$", r"\$")
