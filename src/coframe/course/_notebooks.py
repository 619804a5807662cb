# SPDX-License-Identifier: Apache-2.0
"""The chapters of the handbook as notebooks. The Markdown files are the source.

A Python block becomes a cell, and so does a comment `<!-- notebook: ... -->`, which contains code for notebooks only.
"""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["Cell", "cells", "notebook"]

_CODE = re.compile(r"^```python\n(?P<block>.*?)^```\n|^<!-- notebook:(?P<comment>.*?)-->\n", re.MULTILINE | re.DOTALL)
# In a notebook, the view replaces the image.
_IMAGE_LINE = re.compile(r"^!\[[^]]*\]\(\d\d_\w+\.webp\)\n+", re.MULTILINE)
_CHAPTER_LINK = re.compile(r"\]\((\d\d_\w+)\.md(#[\w-]*)?\)")
_RELATIVE_LINK = re.compile(r"\]\((?!\w+:|#|\d\d_\w+\.ipynb)([^)]+)\)")


class Cell(NamedTuple):
    """A cell of a notebook.

    Attributes:
        kind: "markdown" or "code".
        text: The content.
    """

    kind: str
    text: str


def cells(chapter: Path) -> Iterator[Cell]:
    """Yield the cells of a chapter."""
    text = _IMAGE_LINE.sub("", chapter.read_text(encoding="utf-8"))
    end = 0
    for found in _CODE.finditer(text):
        yield from _markdown(text[end : found.start()])
        yield Cell("code", (found["block"] or found["comment"]).strip())
        end = found.end()
    yield from _markdown(text[end:])


def _markdown(text: str) -> Iterator[Cell]:
    if text.strip():
        linked = _CHAPTER_LINK.sub(r"](\1.ipynb\2)", text.strip())
        yield Cell("markdown", _RELATIVE_LINK.sub(r"](../\1)", linked))


def notebook(chapter: Path) -> str:
    """Return the notebook of a chapter as JSON, without outputs."""
    source = f"Written from [the chapter](../{chapter.name}). It needs `pip install 'coframe[all]'`."
    contents = [Cell("markdown", source), *cells(chapter)]
    document = {
        "cells": [_cell(number, cell) for number, cell in enumerate(contents)],
        "metadata": {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def _cell(number: int, cell: Cell) -> dict[str, object]:
    output: dict[str, object] = {"execution_count": None, "outputs": []} if cell.kind == "code" else {}
    lines = cell.text.splitlines(keepends=True)
    return {"cell_type": cell.kind, "id": f"cell-{number}", "metadata": {}, **output, "source": lines}
