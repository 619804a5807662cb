# SPDX-License-Identifier: Apache-2.0
"""A drawing as a PNG image by matplotlib, in its own font; characters that this font lacks are written as escapes."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.lines import Line2D
from matplotlib.patches import FancyBboxPatch

from coframe.tree_drawing._layout import Box, Line, draw

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from coframe.tree_drawing._forest import Forest
    from coframe.tree_drawing._layout import Label

__all__ = ["as_png"]

_PIXELS_PER_INCH = 96.0  # pixels of the drawing
_DENSITY = 192.0  # pixels of the image per inch: sharp on any screen
_MAX_SIDE = 16_000.0  # Pixels of the image; matplotlib supports 2**16, at a memory of 4 bytes per pixel.
_MAX_PIXELS = 100e6
# The layout is for Helvetica; matplotlib's default font, DejaVu Sans, is wider.
_FONT_SCALE = 0.92
_CORNER_RADIUS = 4.0
_FONT = "DejaVu Sans"
_POINT = 0.75  # points of 1/72 inch per pixel of the drawing


def as_png(forest: Forest, title: str) -> bytes:
    """Return the file as bytes."""
    drawing = draw(forest, title, _replace_unsupported)
    width, height = drawing.width / _PIXELS_PER_INCH, drawing.height / _PIXELS_PER_INCH
    density = min(_DENSITY, _MAX_SIDE / max(width, height), (_MAX_PIXELS / (width * height)) ** 0.5)
    figure = Figure(figsize=(width, height), facecolor="white")
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, drawing.width)
    axes.set_ylim(drawing.height, 0.0)
    for shape in drawing.shapes:
        _draw(axes, shape)
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=density)
    return stream.getvalue()


def _draw(axes: Axes, shape: Box | Line | Label) -> None:
    if isinstance(shape, Box):
        corner = f"round,pad=0,rounding_size={_CORNER_RADIUS}"
        box = FancyBboxPatch((shape.x, shape.y), shape.width, shape.height, boxstyle=corner, linewidth=_POINT)
        box.set(facecolor=shape.fill, edgecolor=shape.border)
        axes.add_patch(box)
    elif isinstance(shape, Line):
        x, y = zip(*shape.points, strict=True)
        line = Line2D(x, y, color=shape.color, linewidth=_POINT)
        if shape.is_dashed:
            line.set_dashes((6, 4))
        axes.add_line(line)
    else:
        axes.text(
            shape.x,
            shape.y,
            shape.text,
            color=shape.color,
            fontfamily=_FONT,
            fontsize=shape.size * _POINT * _FONT_SCALE,
            fontweight="bold" if shape.bold else "normal",
            parse_math=False,  # A name that contains $...$ is not a formula.
        )


def _replace_unsupported(text: str) -> str:
    known = get_font(findfont(FontProperties(family=[_FONT]))).get_charmap()
    return "".join(c if ord(c) in known else c.encode("ascii", "backslashreplace").decode() for c in text)
