# SPDX-License-Identifier: Apache-2.0
"""A drawing as SVG without external resources."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from coframe.tree_drawing._layout import Box, Line, draw

if TYPE_CHECKING:
    from coframe.tree_drawing._forest import Forest
    from coframe.tree_drawing._layout import Label

__all__ = ["as_svg"]

_FONT = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"


def as_svg(forest: Forest, title: str) -> str:
    """Return the file as text."""
    drawing = draw(forest, title)
    size = f"{drawing.width:.0f}", f"{drawing.height:.0f}"
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]}" height="{size[1]}" '
        f'viewBox="0 0 {size[0]} {size[1]}" font-family="{_FONT}">\n'
        f"<title>{_text(title)}</title>\n"
        f'<rect width="100%" height="100%" fill="#ffffff"/>\n'
    )
    return head + "\n".join(map(_shape, drawing.shapes)) + "\n</svg>\n"


def _shape(shape: Box | Line | Label) -> str:
    if isinstance(shape, Box):
        title = f"<title>{_text(shape.title)}</title>" if shape.title else ""
        return (
            f'<rect x="{shape.x:.1f}" y="{shape.y:.1f}" width="{shape.width:.1f}" height="{shape.height:.1f}" rx="4" '
            f'fill="{shape.fill}" stroke="{shape.border}">{title}</rect>'
        )
    if isinstance(shape, Line):
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in shape.points)
        dashes = ' stroke-dasharray="6 4"' if shape.is_dashed else ""
        return f'<polyline points="{points}" fill="none" stroke="{shape.color}"{dashes}/>'
    weight = ' font-weight="bold"' if shape.bold else ""
    return (
        f'<text x="{shape.x:.1f}" y="{shape.y:.1f}" font-size="{shape.size:g}" fill="{shape.color}"{weight} '
        f'xml:space="preserve">{_text(shape.text)}</text>'
    )


def _text(text: str) -> str:
    """Return escaped text without the characters that XML does not allow."""
    return escape("".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text), quote=False)
