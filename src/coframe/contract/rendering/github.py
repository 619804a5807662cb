# SPDX-License-Identifier: Apache-2.0
"""Verdicts as workflow commands of GitHub Actions, which show each problem as an annotation."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from coframe.contract._verdict import Verdict

__all__ = ["as_annotations"]


def as_annotations(verdicts: Iterable[Verdict]) -> Iterator[str]:
    """Yield a line for each problem and each requirement that was not checked."""
    for verdict in verdicts:
        file = "" if verdict.source == "live" else f"file={_property(verdict.source)},"
        if verdict.unreadable:
            yield f"::error {file}title=unreadable recording::{_text(verdict.unreadable)}"
        for result in verdict.broken:
            title = _property(f"{result.kind} {result.subject}")
            for problem in result.problems:
                yield f"::error {file}title={title}::{_text(f'{result.subject}: {problem}')}"
        for reason in verdict.unchecked:
            yield f"::warning {file}title=not checked::{_text(reason)}"


def _text(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _text(text).replace(":", "%3A").replace(",", "%2C")
