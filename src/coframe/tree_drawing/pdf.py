# SPDX-License-Identifier: Apache-2.0
"""A drawing as one page of PDF in the standard fonts. Missing characters are written as escapes."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import pydyf

from coframe._output.escaping import display_name
from coframe.tree_drawing._layout import Box, Line, draw

if TYPE_CHECKING:
    from coframe.tree_drawing._forest import Forest
    from coframe.tree_drawing._layout import Label

__all__ = ["as_pdf"]

_POINT = 0.75  # points of 1/72 inch per pixel of the drawing
_ENCODING = "cp1252"  # the name of WinAnsiEncoding in Python
_FONTS = {"F": "Helvetica", "B": "Helvetica-Bold"}
_MAX_PAGE_LENGTH = 14_400.0  # points; PDF readers may not support larger pages


def as_pdf(forest: Forest, title: str) -> bytes:
    """Return the file as bytes."""
    drawing = draw(forest, title, _replace_unsupported)
    scale = min(_POINT, _MAX_PAGE_LENGTH / max(drawing.width, drawing.height))
    page = pydyf.Stream(compress=True)
    page.set_matrix(scale, 0, 0, -scale, 0, drawing.height * scale)
    page.set_line_width(1)
    for shape in drawing.shapes:
        _draw(page, shape)
    document = pydyf.PDF()
    document.info["Title"] = pydyf.String(display_name(title))
    document.add_object(page)
    fonts = pydyf.Dictionary({name: _font(base) for name, base in _FONTS.items()})
    document.add_page(
        pydyf.Dictionary(
            {
                "Type": "/Page",
                "Parent": document.pages.reference,
                "Contents": page.reference,
                "MediaBox": pydyf.Array([0, 0, drawing.width * scale, drawing.height * scale]),
                "Resources": pydyf.Dictionary({"Font": fonts}),
            }
        )
    )
    file = io.BytesIO()
    document.write(file)
    return file.getvalue()


def _font(base: str) -> pydyf.Dictionary:
    return pydyf.Dictionary(
        {"Type": "/Font", "Subtype": "/Type1", "BaseFont": f"/{base}", "Encoding": "/WinAnsiEncoding"}
    )


def _draw(page: pydyf.Stream, shape: Box | Line | Label) -> None:
    if isinstance(shape, Box):
        page.set_color_rgb(*_rgb(shape.fill))
        page.set_color_rgb(*_rgb(shape.border), stroke=True)
        page.rectangle(shape.x, shape.y, shape.width, shape.height)
        page.fill_and_stroke()
    elif isinstance(shape, Line):
        page.set_color_rgb(*_rgb(shape.color), stroke=True)
        page.set_dash([6, 4] if shape.is_dashed else [], 0)
        page.move_to(*shape.points[0])
        for point in shape.points[1:]:
            page.line_to(*point)
        page.stroke()
        page.set_dash([], 0)
    else:
        page.set_color_rgb(*_rgb(shape.color))
        page.begin_text()
        page.set_font_size("B" if shape.bold else "F", shape.size)
        page.set_text_matrix(1, 0, 0, -1, shape.x, shape.y)
        page.show_text_string(shape.text.encode(_ENCODING))
        page.end_text()


def _rgb(color: str) -> tuple[float, float, float]:
    red, green, blue = bytes.fromhex(color.removeprefix("#"))
    return red / 255, green / 255, blue / 255


def _replace_unsupported(text: str) -> str:
    return text.encode(_ENCODING, "backslashreplace").decode(_ENCODING)
