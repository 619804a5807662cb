"""A page for every code, which `coframe doctor --explain` prints and the documentation links to.

A page is Markdown: a title ``# TF001: ...``, then sections. "Why it matters" opens with the sentence that stands below
every finding of that code.
"""

from __future__ import annotations

import functools
import re
from pathlib import Path
from typing import NamedTuple

__all__ = ["Page", "codes", "page"]

_PAGES = Path(__file__).with_name("code_pages")
_CODE = re.compile(r"TF\d{3}")


class Page(NamedTuple):
    """One code's page.

    Attributes:
        code: ``TF001``.
        title: In a few words.
        why: Why it matters, in a sentence.
        text: The whole page, Markdown.
    """

    code: str
    title: str
    why: str
    text: str


@functools.cache
def codes() -> tuple[str, ...]:
    """All codes that have a page, in order."""
    names = (file.name.removesuffix(".md") for file in _PAGES.iterdir())
    return tuple(sorted(name for name in names if _CODE.fullmatch(name)))


@functools.cache
def page(code: str) -> Page:
    """The page of a code, in any case of its letters.

    Raises:
        KeyError: There is none.
    """
    name = code.upper()
    if name not in codes():
        raise KeyError(code)
    text = (_PAGES / f"{name}.md").read_text(encoding="utf-8")
    title = text.partition("\n")[0].removeprefix(f"# {name}: ").strip()
    why = text.partition("## Why it matters\n\n")[2].partition("\n\n")[0]
    return Page(name, title, " ".join(why.split()), text)
