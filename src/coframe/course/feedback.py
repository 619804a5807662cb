# SPDX-License-Identifier: Apache-2.0
"""Feedback for a student: one HTML file with the figures of the handbook, or one text file."""

from __future__ import annotations

import html
import re
from typing import TYPE_CHECKING, Any

from coframe.course.formats import details, is_skipped, text, total_line
from coframe.course.handbook import chapter_figure
from coframe.course.translation.language import ENGLISH

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.course.translation.language import Language

__all__ = ["FEEDBACK_FORMATS", "feedback"]

FEEDBACK_FORMATS = ("html", "txt")
_CHAPTER = re.compile(r"chapter (\d+)")
_PAGE = """<!DOCTYPE html>
<html lang="{language}"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
body {{ font: 1rem/1.5 sans-serif; max-width: 46rem; margin: 2rem auto; padding: 0 1rem; color-scheme: light dark; }}
section {{ border-top: 1px solid #8888; padding: 0.5rem 0; }}
h2 {{ font-size: 1.1rem; margin: 0.5rem 0; }} h2 svg {{ vertical-align: middle; margin-left: 0.6rem; }}
dl {{ display: grid; grid-template-columns: 8rem 1fr; gap: 0.1rem 0.6rem; margin: 0.2rem 0 0.8rem 1.6rem; }}
dt {{ opacity: 0.7; }} dd {{ margin: 0; overflow-wrap: anywhere; }}
p.fact {{ margin: 0.2rem 0; }} p.lost {{ font-weight: bold; }}
pre {{ overflow-x: auto; background: #8882; padding: 0.5rem; }}
figure {{ margin: 0.5rem 0; }} figure svg {{ max-width: 100%; height: auto; background: white; }}
@media (max-width: 30rem) {{ dl {{ grid-template-columns: 1fr; }} }}
</style>
<body>
<h1>{title}</h1>
{body}</body></html>
"""
_BAR_WIDTH, _BAR_HEIGHT = 160, 12  # pixels
_BLUE, _ORANGE = "#0072b2", "#e69f00"  # distinguishable with all kinds of color vision


def feedback(name: str, report: dict[str, Any], kind: str, language: Language = ENGLISH) -> str:
    """Return the feedback about a submission.

    Args:
        name: The name of the student, the title of the page.
        report: The report of the grade.
        kind: One of FEEDBACK_FORMATS.
        language: The language of the feedback.
    """
    if kind == "txt":
        return "\n".join([name, "", *text(report, language), ""])
    body = "\n".join(_sections(report, language))
    return _PAGE.format(language=language.code, title=html.escape(f"Lab 09-02: {name}"), body=body)


def _sections(report: dict[str, Any], language: Language) -> Iterator[str]:
    bar = _bar(report["earned"], report["points"], language)
    yield f"<p><strong>{html.escape(total_line(report, language))}</strong>{bar}</p>"
    yield from (f"<p>{html.escape(language.text(notice))}</p>" for notice in report["notices"])
    shown: set[int] = set()
    for criterion in report["criteria"]:
        if is_skipped(criterion):
            continue
        earned, points = criterion["earned"], criterion["points"]
        title = f"{html.escape(language.text(criterion['name']))}: {earned:g} / {points:g}"
        yield f"<section><h2>{title}{_bar(earned, points, language)}</h2>"
        if criterion["problem"]:
            yield f"<p>{html.escape(language.text(criterion['problem']))}</p>"
        if criterion["last_lines"]:
            yield f"<pre>{html.escape(chr(10).join(criterion['last_lines']))}</pre>"
        for fact in criterion["facts"]:
            yield from _fact(fact, language)
        yield from _figures(criterion, shown, language)
        yield "</section>"


def _fact(fact: dict[str, Any], language: Language) -> Iterator[str]:
    is_lost = fact["earned"] < fact["points"]
    kind, mark = ("lost", "&minus;") if is_lost else ("kept", "+")
    points = f"{fact['earned']:g} / {fact['points']:g}"
    yield f'<p class="fact {kind}">{mark} {points} &ensp;{html.escape(language.text(fact["name"]))}</p>'
    if is_lost:
        yield (
            "<dl>"
            + "".join(f"<dt>{title}</dt><dd>{html.escape(value)}</dd>" for title, value in details(fact, language))
            + "</dl>"
        )


def _figures(criterion: dict[str, Any], shown_figures: set[int], language: Language) -> Iterator[str]:
    """Yield the figures of the chapters to read about lost points, each once."""
    for fact in criterion["facts"]:
        match = _CHAPTER.search(fact["read"]) if fact["earned"] < fact["points"] else None
        if match and int(match[1]) not in shown_figures:
            shown_figures.add(int(match[1]))
            if figure := chapter_figure(int(match[1])):
                caption = html.escape(language.text(fact["read"]))
                yield f"<figure>{language.figure(figure)}<figcaption>{caption}</figcaption></figure>"


def _bar(earned: float, points: float, language: Language) -> str:
    """Return a picture of a share of points, as SVG."""
    width = _BAR_WIDTH * min(1.0, max(0.0, earned / points)) if points else 0.0
    missing_bar = f'<rect x="{width:.1f}" width="{_BAR_WIDTH - width:.1f}" height="{_BAR_HEIGHT}" fill="{_ORANGE}"/>'
    earned_bar = f'<rect width="{width:.1f}" height="{_BAR_HEIGHT}" fill="{_BLUE}"/>'
    label = html.escape(language.text(f"{earned:g} of {points:g} points"))
    size = f'width="{_BAR_WIDTH}" height="{_BAR_HEIGHT}"'
    return f'<svg role="img" aria-label="{label}" {size}>{earned_bar}{missing_bar}</svg>'
