# SPDX-License-Identifier: Apache-2.0
"""The page of each code, printed by `coframe doctor --explain` and linked from the documentation.

A page is Markdown: a title ``# TF001: ...``, then sections. The first paragraph of "Why it matters" is printed below
every finding of the code. The checks of other distributions bring their own pages.
"""

from __future__ import annotations

import functools
import re
from pathlib import Path
from typing import NamedTuple

from coframe.doctor._plugin_checks import plugin_checks

__all__ = ["Page", "built_in_codes", "codes", "page"]

_PAGES = Path(__file__).with_name("code_pages")
_CODE = re.compile(r"TF\d{3}")


class Page(NamedTuple):
    """The page of a code.

    Attributes:
        code: The code, such as ``TF001``.
        title: The title of the page.
        why: Why it matters.
        text: The whole page in Markdown.
    """

    code: str
    title: str
    why: str
    text: str

    @property
    def location(self) -> str:
        """The page and section of the documentation site that describe the code, or "" for the code of a plug-in."""
        if self.code not in built_in_codes():
            return ""
        return f"reference/doctor-codes.html#{self.code.lower()}"


def codes() -> tuple[str, ...]:
    """Return all codes in order: coframe's codes, then the codes of other distributions."""
    return (*built_in_codes(), *plugin_checks())


@functools.cache
def built_in_codes() -> tuple[str, ...]:
    """Return the codes of coframe's own checks, in order."""
    names = (file.name.removesuffix(".md") for file in _PAGES.iterdir())
    return tuple(sorted(name for name in names if _CODE.fullmatch(name)))


@functools.cache
def page(code: str) -> Page:
    """Return the page of a code, in upper or lower case.

    Raises:
        KeyError: There is no such code.
    """
    name = code.upper()
    if name in built_in_codes():
        text = (_PAGES / f"{name}.md").read_text(encoding="utf-8")
    else:
        text = plugin_checks()[name].page
    title = text.partition("\n")[0].removeprefix(f"# {name}: ").strip()
    why = text.partition("## Why it matters\n\n")[2].partition("\n\n")[0]
    return Page(name, title, " ".join(why.split()), text)
