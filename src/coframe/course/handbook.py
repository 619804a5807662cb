# SPDX-License-Identifier: Apache-2.0
"""The handbook of the course: its chapters as text for a terminal, and as web pages with images."""

from __future__ import annotations

import html
import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe.course._notebooks import notebook
from coframe.course.translation.language import ENGLISH
from coframe.errors import CourseError

if TYPE_CHECKING:
    from coframe.course.translation.language import Language

__all__ = ["Chapter", "chapter_figure", "chapters", "contents", "terminal_text", "write_pages"]

_NOTEBOOKS = "notebooks"
_CONTENTS = "README.md"
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
_EXTERNAL_LINK = re.compile(r"\[([^\]]*)\]\(\.\./[^)]*\)")  # links to documents that are not installed
_NOT_SHOWN = re.compile(r"<!-- notebook:[\s\S]*?-->\n*|^(?:Next:|Back to the) .*$", re.MULTILINE)
_PICTURE = re.compile(r"!\[([^\]]*)\]\([^)]*\)")
_SLIDES = "slides.html"
_STYLE = """
:root { color-scheme: light dark; }
body { font: 1rem/1.5 sans-serif; margin: 0; overflow-wrap: break-word; }
pre, code { background: #8882; } pre { padding: 0.7rem; overflow-x: auto; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
td, th { border: 1px solid #8888; padding: 0.2rem 0.5rem; vertical-align: top; }
img { max-width: 100%; height: auto; background: white; }
"""
_PAGE_STYLE = """
main { max-width: 50rem; margin: 1rem auto; padding: 0 1rem; }
nav { padding: 0.5rem 1rem; border-bottom: 1px solid #8888; }
nav summary { cursor: pointer; } nav ol { columns: 16rem; } nav a { display: inline-block; padding: 0.1rem 0; }
nav [aria-current] { font-weight: bold; }
"""
_SLIDE_STYLE = """
html { scroll-snap-type: y mandatory; }
section { box-sizing: border-box; min-height: 100vh; padding: 4vh 6vw; scroll-snap-align: start; font-size: 1.3rem; }
section img { max-height: 60vh; }
@media print { section { break-after: page; min-height: 0; } }
"""
_KEYS = """<script>
addEventListener("keydown", (event) => {
  const step = { ArrowRight: 1, PageDown: 1, ArrowLeft: -1, PageUp: -1 }[event.key];
  if (!step) return;
  event.preventDefault();
  const slides = [...document.querySelectorAll("section")];
  const now = slides.findIndex((slide) => slide.getBoundingClientRect().bottom > innerHeight / 2);
  slides[Math.max(0, Math.min(slides.length - 1, now + step))].scrollIntoView();
});
</script>"""
_PAGE = """<!DOCTYPE html>
<html lang="{language}"><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
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


def terminal_text(file: Path, language: Language = ENGLISH) -> str:
    """Return a file of the handbook as Markdown for a terminal, with images replaced by their descriptions."""
    text = language.markdown(file.read_text(encoding="utf-8"))
    return _LINK.sub(r"\1", _PICTURE.sub(rf"*{language.label('Picture')}: \1*", text))


def write_pages(folder: Path, *, slides: bool = False, language: Language = ENGLISH) -> Path:
    """Write the handbook as web pages with a menu, images and notebooks, and return the contents page.

    Args:
        folder: The folder; existing files are replaced.
        slides: Whether to write ``slides.html`` too: a slide for each section of a chapter.
        language: The language of the pages; the notebooks are in English.

    Raises:
        CourseError: The handbook is not installed, or a file cannot be written.
    """
    source = _folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for file in source.glob("*.md"):
            _target(folder, file).write_text(_page(file, language), encoding="utf-8")
        for picture in _find_images(source):
            if picture.suffix == ".svg":
                figure = language.figure(picture.read_text(encoding="utf-8"))
                (folder / picture.name).write_text(figure, encoding="utf-8")
            else:
                shutil.copyfile(picture, folder / picture.name)
        (folder / _NOTEBOOKS).mkdir(exist_ok=True)
        for chapter in chapters():
            (folder / _NOTEBOOKS / f"{chapter.file.stem}.ipynb").write_text(notebook(chapter.file), encoding="utf-8")
        if slides:
            (folder / _SLIDES).write_text(_slides(language), encoding="utf-8")
    except OSError as error:
        raise CourseError(
            f"Cannot write {error.filename or folder}: {error.strerror}.", hint="Choose another folder."
        ) from None
    return _target(folder, source / _CONTENTS)


def _target(folder: Path, file: Path) -> Path:
    return folder / ("index.html" if file.name == _CONTENTS else f"{file.stem}.html")


def _find_images(folder: Path) -> list[Path]:
    return [file for file in folder.iterdir() if file.suffix in {".svg", ".png", ".jpg", ".gif", ".webp"}]


def _page(file: Path, language: Language) -> str:
    """Return a file of the handbook as a web page, with a menu and links to the other pages."""
    text = language.markdown(file.read_text(encoding="utf-8"))
    title = html.escape(text.partition("\n")[0].removeprefix("# "))
    body = f"{_menu(file, language)}<main>\n{_rendered(text)}</main>\n"
    return _PAGE.format(language=language.code, title=title, style=_STYLE + _PAGE_STYLE, body=body)


def _menu(file: Path, language: Language) -> str:
    """Return the menu of a page: the previous and next chapter, and all chapters."""
    found = chapters()
    files = [chapter.file for chapter in found]
    place = files.index(file) if file in files else -1
    near = [(language.label("Contents"), "index.html")]
    near += [(f"&larr; {found[place - 1].number}", f"{files[place - 1].stem}.html")] if place > 0 else []
    near += [(f"{found[place + 1].number} &rarr;", f"{files[place + 1].stem}.html")] if place + 1 < len(found) else []
    links = " &ensp; ".join(f'<a href="{address}">{name}</a>' for name, address in near)
    items = "".join(
        f'<li><a href="{chapter.file.stem}.html"{" aria-current=page" if chapter.file == file else ""}>'
        f"{html.escape(_title(chapter, language))}</a></li>"
        for chapter in found
    )
    return f"<nav>{links}<details><summary>{language.label('Chapters')}</summary><ol>{items}</ol></details></nav>\n"


def _title(chapter: Chapter, language: Language) -> str:
    heading = language.markdown(f"# {chapter.number} {chapter.title}")
    return heading.removeprefix(f"# {chapter.number} ")


def _slides(language: Language) -> str:
    """Return all chapters as slides, one for each section, without exercises."""
    parts = []
    for chapter in chapters():
        text = _NOT_SHOWN.sub("", chapter.file.read_text(encoding="utf-8"))
        sections = re.split(r"^(?=##? )", text, flags=re.MULTILINE)
        shown = [section for section in sections if section.strip() and not section.startswith("## Exercises")]
        parts += [language.markdown(section) for section in shown]
    body = "".join(f"<section>\n{_rendered(part)}</section>\n" for part in parts)
    title = language.label("Coordinate frames and tf2")
    return _PAGE.format(language=language.code, title=title, style=_STYLE + _SLIDE_STYLE, body=body + _KEYS)


def _rendered(text: str) -> str:
    """Return Markdown as HTML, with links to the other pages."""
    from markdown_it import MarkdownIt  # noqa: PLC0415 - only for web pages

    body = MarkdownIt("commonmark").enable("table").render(_EXTERNAL_LINK.sub(r"\1", text))
    body = body.replace('href="README.md', 'href="index.html')
    return re.sub(r'href="(\w+)\.md', r'href="\1.html', body)
