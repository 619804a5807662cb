# SPDX-License-Identifier: Apache-2.0
"""Reports as text, and in the result formats of Gradescope and of GitHub Classroom."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

from coframe.course.submitted import MISSING_FILE
from coframe.course.translation.language import ENGLISH

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.course.translation.language import Language

__all__ = [
    "UNFINISHED_NOTICE",
    "classroom",
    "csv_row",
    "details",
    "gradescope",
    "is_skipped",
    "text",
    "total_line",
    "ungraded_report",
]

UNFINISHED_NOTICE = "The check was interrupted; only the criteria before that count."
_WIDTH = 100
_FOLDER = "Folder"  # represents all criteria of a folder that could not be graded


def text(report: dict[str, Any], language: Language = ENGLISH) -> Iterator[str]:
    """Yield the lines of a report for a terminal: each criterion with its facts, and the reasons for lost points."""
    for criterion in report["criteria"]:
        if is_skipped(criterion):
            continue
        bonus = f" {language.label('bonus')}" if criterion["bonus"] else ""
        yield f"{language.text(criterion['name'])} ({criterion['file']}): {_points_text(criterion)}{bonus}"
        if criterion["problem"]:
            yield from _indent(language.text(criterion["problem"]), "  ! ")
            yield from (f"    | {line}" for line in criterion["last_lines"])
            if cause := _common_cause(criterion):
                yield from _indent(language.text(cause), f"    {language.label('likely cause')}: ")
        for fact in criterion["facts"]:
            lost = fact["earned"] < fact["points"]
            yield f"  {'-' if lost else '+'} {_points_text(fact)}  {language.text(fact['name'])}"
            if lost and not _is_explained(criterion, fact):
                for label, content in details(fact, language):
                    yield from _indent(content, f"        {label}: ")
        yield ""
    yield from map(language.text, report["notices"])
    yield total_line(report, language)


def details(fact: dict[str, Any], language: Language = ENGLISH) -> list[tuple[str, str]]:
    """Return the explanations of lost points, each with its label."""
    labels = (
        (language.label("expected"), "expected"),
        (language.label("observed"), "observed"),
        (language.label("likely cause"), "cause"),
        (language.label("read"), "read"),
    )
    return [(label, language.text(fact[key])) for label, key in labels if fact[key]]


def _is_explained(criterion: dict[str, Any], fact: dict[str, Any]) -> bool:
    """Return whether the problem above the facts explains why this one lost points."""
    problem = criterion["problem"].casefold()
    if fact["cause"] and fact["cause"] != _common_cause(criterion):
        return fact["cause"].casefold() in problem
    return fact["observed"].casefold() in problem


def _common_cause(criterion: dict[str, Any]) -> str:
    """Return the cause of all lost points if the program did nothing, or ""."""
    lost = [fact for fact in criterion["facts"] if fact["earned"] < fact["points"]]
    causes = {fact["cause"] for fact in lost}
    has_one = len(causes) == 1 and all(fact["observed"] and fact["observed"] in criterion["problem"] for fact in lost)
    cause: str = causes.pop() if has_one else ""
    return "" if cause.casefold() in criterion["problem"].casefold() else cause


def total_line(report: dict[str, Any], language: Language = ENGLISH) -> str:
    """Return the last line of a report: the grade, or the points of a part of the check."""
    points, bonus_points = (
        sum(each["points"] for each in report["criteria"] if each["bonus"] is bonus) for bonus in (False, True)
    )
    if points == report["points"]:
        bonus = f" + {report['bonus']:g} bonus" if report["bonus"] else ""
        return language.text(f"Grade: {report['earned']:g} of {points:g}{bonus}")
    parts = [f"{report['earned']:g} of {points:g}"] if points else []
    parts += [f"{report['bonus']:g} of {bonus_points:g} bonus"] if bonus_points else []
    return language.text(f"Points in this part of the check: {' + '.join(parts)}. The grade requires all parts.")


def is_skipped(criterion: dict[str, Any]) -> bool:
    """Return whether a criterion is an extension that the student has not attempted."""
    return bool(criterion["bonus"]) and criterion["problem"].startswith(MISSING_FILE)


def _points_text(item: dict[str, Any]) -> str:
    return f"{item['earned']:g} / {item['points']:g}"


def _indent(content: str, start: str) -> list[str]:
    if not content:
        return []
    return textwrap.wrap(content, _WIDTH, initial_indent=start, subsequent_indent=" " * len(start))


def ungraded_report(folder: str, problem: str) -> dict[str, Any]:
    """Return the report of a folder that could not be graded: no points, and the reason."""
    fact = {"name": "the folder can be graded", "points": 100, "earned": 0.0, "cause": "", "read": ""}
    fact |= {"expected": "a folder that can be graded", "observed": problem}
    criterion = {"name": _FOLDER, "file": folder, "bonus": False, "earned": 0.0, "points": 100, "problem": problem}
    return {
        "folder": folder,
        "variant": None,
        "earned": 0.0,
        "points": 100,
        "bonus": 0.0,
        "notices": [problem],
        "criteria": [{**criterion, "last_lines": [], "facts": [fact]}],
    }


def gradescope(report: dict[str, Any], language: Language = ENGLISH) -> dict[str, Any]:
    """Return a report as Gradescope's ``results.json``: one test for each fact."""
    return {
        "score": report["earned"] + report["bonus"],
        "output": "\n".join(map(language.text, report["notices"])),
        "tests": [
            {
                "name": f"{language.text(criterion['name'])}: {language.text(fact['name'])}",
                "score": fact["earned"],
                "max_score": 0 if criterion["bonus"] else fact["points"],
                "status": "passed" if fact["earned"] == fact["points"] else "failed",
                "output": _explanation(criterion, fact, language),
            }
            for criterion, fact in _graded_facts(report)
        ],
    }


def classroom(report: dict[str, Any], language: Language = ENGLISH) -> dict[str, Any]:
    """Return a report as the result of a runner of GitHub Classroom's autograding."""
    tests = [
        {
            "name": f"{language.text(criterion['name'])}: {language.text(fact['name'])}",
            "status": "pass" if fact["earned"] == fact["points"] else "fail",
            "line_no": 0,  # The reporter prints "line undefined" without it.
            "message": _explanation(criterion, fact, language),
            "test_code": _explanation(criterion, fact, language),  # The reporter prints only this for a failed test.
            "score": fact["earned"],
            "max_score": 0 if criterion["bonus"] else fact["points"],
            "filename": criterion["file"],
        }
        for criterion, fact in _graded_facts(report)
    ]
    status = "pass" if report["earned"] == report["points"] else "fail"
    return {"version": 1, "status": status, "max_score": report["points"], "tests": tests}


def _graded_facts(report: dict[str, Any]) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """Yield each fact with its criterion, without extensions that the student has not attempted."""
    for criterion in report["criteria"]:
        if not is_skipped(criterion):
            yield from ((criterion, fact) for fact in criterion["facts"])


def csv_row(submission: str, report: dict[str, Any]) -> dict[str, Any]:
    """Return the row of a submission in the table of grades: variant, total, each criterion, first problem."""
    problems = [each["problem"] for each in report["criteria"] if each["problem"] and not is_skipped(each)]
    return {
        "submission": submission,
        "variant": report["variant"],
        "grade": report["earned"],
        "bonus": report["bonus"],
        **{criterion["name"]: criterion["earned"] for criterion in report["criteria"] if criterion["name"] != _FOLDER},
        "problem": next(iter(problems), ""),
    }


def _explanation(criterion: dict[str, Any], fact: dict[str, Any], language: Language) -> str:
    if fact["earned"] == fact["points"]:
        return ""
    problem = [language.text(criterion["problem"])] if criterion["problem"] else []
    return "\n".join([*problem, *(f"{label}: {content}" for label, content in details(fact, language))])
