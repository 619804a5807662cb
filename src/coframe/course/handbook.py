# SPDX-License-Identifier: Apache-2.0
"""The handbook of the course: its chapters as text for a terminal, and as web pages with images."""

from __future__ import annotations

import html
import re
import shutil
from pathlib import Path
from typing import NamedTuple

from coframe.course._notebooks import notebook
from coframe.errors import CourseError

__all__ = ["Chapter", "chapter_figure", "chapters", "contents", "terminal_text", "write_pages"]

_NOTEBOOKS = "notebooks"
_CONTENTS = "README.md"
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
_EXTERNAL_LINK = re.compile(r"\[([^\]]*)\]\(\.\./[^)]*\)")  # links to documents that are not installed
_PICTURE = re.compile(r"!\[([^\]]*)\]\([^)]*\)")
_PAGE = """<!DOCTYPE html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
body {{ font: 1rem/1.5 sans-serif; max-width: 50rem; margin: 2rem auto; padding: 0 1rem; }}
pre, code {{ background: #f2f2f2; }} pre {{ padding: 0.7rem; overflow-x: auto; }}
table {{ border-collapse: collapse; }} td, th {{ border: 1px solid #bbb; padding: 0.2rem 0.5rem; vertical-align: top; }}
img {{ max-width: 100%; background: white; }}
</style>
<body>
{body}</body></html>
"""


class Chapter(NamedTuple):
    """A chapter: its number, its title and its file."""

    number: int
    title: str
    file: Path


def _folder() -> Path:
    """Return the folder of the handbook: next to this file when installed, in docs in a checkout."""
    here = Path(__file__).resolve().parent
    for folder in (here / "handbook", here.parents[2] / "docs" / "handbook"):
        if (folder / _CONTENTS).is_file():
            return folder
    raise CourseError("The handbook is not installed.", hint="Install coframe again with pip.")


def contents() -> Path:
    """Return the file with the contents of the handbook.

    Raises:
        CourseError: The handbook is not installed.
    """
    return _folder() / _CONTENTS


def chapters() -> list[Chapter]:
    """Return the chapters in order.

    Raises:
        CourseError: The handbook is not installed.
    """
    found = []
    for file in sorted(_folder().glob("[0-9][0-9]_*.md")):
        number, _, title = file.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ").partition(" ")
        found.append(Chapter(int(number), title, file))
    return found


def chapter_figure(number: int) -> str:
    """Return the figure of a chapter as SVG to be embedded in a page, or "" if there is none."""
    for chapter in chapters():
        figure = chapter.file.with_suffix(".svg")
        if chapter.number == number and figure.is_file():
            return re.sub(r"^<\?xml[^>]*\?>\s*", "", figure.read_text(encoding="utf-8"))
    return ""


def terminal_text(file: Path) -> str:
    """Return a file of the handbook as Markdown for a terminal, with images replaced by their descriptions."""
    return _LINK.sub(r"\1", _PICTURE.sub(r"*Picture: \1*", file.read_text(encoding="utf-8")))


def write_pages(folder: Path) -> Path:
    """Write the handbook as web pages with images and notebooks, and return the contents page.

    Args:
        folder: The folder; existing files are replaced.

    Raises:
        CourseError: The handbook is not installed, or a file cannot be written.
    """
    source = _folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for file in source.glob("*.md"):
            _target(folder, file).write_text(_page(file.read_text(encoding="utf-8")), encoding="utf-8")
        for picture in _find_images(source):
            shutil.copyfile(picture, folder / picture.name)
        (folder / _NOTEBOOKS).mkdir(exist_ok=True)
        for chapter in chapters():
            (folder / _NOTEBOOKS / f"{chapter.file.stem}.ipynb").write_text(notebook(chapter.file), encoding="utf-8")
    except OSError as error:
        raise CourseError(
            f"Cannot write {error.filename or folder}: {error.strerror}.", hint="Choose another folder."
        ) from None
    return _target(folder, source / _CONTENTS)


def _target(folder: Path, file: Path) -> Path:
    return folder / ("index.html" if file.name == _CONTENTS else f"{file.stem}.html")


def _find_images(folder: Path) -> list[Path]:
    return [file for file in folder.iterdir() if file.suffix in {".svg", ".png", ".jpg", ".gif", ".webp"}]


def _page(text: str) -> str:
    """Return Markdown as a web page, with links to the other pages."""
    from markdown_it import MarkdownIt  # noqa: PLC0415 - only for web pages

    body = MarkdownIt("commonmark").enable("table").render(_EXTERNAL_LINK.sub(r"\1", text))
    body = body.replace('href="README.md', 'href="index.html')
    body = re.sub(r'href="(\w+)\.md', r'href="\1.html', body)
    return _PAGE.format(title=html.escape(text.partition("\n")[0].removeprefix("# ")), body=body)
