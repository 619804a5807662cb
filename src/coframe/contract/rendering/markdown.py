# SPDX-License-Identifier: Apache-2.0
"""Verdicts as Markdown, for job summaries and comments."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.escaping import one_line

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.contract._verdict import Verdict

__all__ = ["as_markdown"]


def as_markdown(verdicts: Sequence[Verdict]) -> str:
    """Return a table of the recordings, and a table of the problems if there are any."""
    kept = sum(verdict.is_kept for verdict in verdicts)
    lines = [
        f"## Contract: {kept} of {len(verdicts)} kept",
        "",
        "| recording | requirements met | verdict |",
        "|---|---|---|",
    ]
    lines += [f"| {_cell(each.source)} | {_met_text(each)} | {_result_word(each)} |" for each in verdicts]
    problems = [
        f"| {_cell(verdict.source)} | {result.kind} | {_cell(result.subject)} | {_cell(problem)} |"
        for verdict in verdicts
        for result in verdict.broken
        for problem in result.problems
    ]
    problems += [
        f"| {_cell(each.source)} | recording | | {_cell(each.unreadable)} |" for each in verdicts if each.unreadable
    ]
    problems += [
        f"| {_cell(each.source)} | not checked | | {_cell(why)} |" for each in verdicts for why in each.unchecked
    ]
    if problems:
        lines += ["", "| recording | requirement | subject | problem |", "|---|---|---|---|", *problems]
    return "\n".join(lines) + "\n"


def _met_text(verdict: Verdict) -> str:
    return f"{len(verdict.results) - len(verdict.broken)} of {len(verdict.results)}" if verdict.results else ""


def _result_word(verdict: Verdict) -> str:
    return "unreadable" if verdict.unreadable else "kept" if verdict.is_kept else "**broken**"


def _cell(text: str) -> str:
    """Return text that neither ends the cell nor becomes markup or HTML."""
    text = one_line(text).replace("&", "&amp;").replace("<", "&lt;")
    return "".join(f"\\{letter}" if letter in "\\`*_[]|#~" else letter for letter in text)
