# SPDX-License-Identifier: Apache-2.0
"""Verdicts as SARIF 2.1.0, which code hosting sites show next to a change."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import coframe
from coframe.doctor.rendering.sarif import SCHEMA, file_uri

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.contract._checks import Result
    from coframe.contract._verdict import Verdict

__all__ = ["as_sarif"]

_RULES = {
    "transform": "A required transform is published, at its rate and with its values",
    "topic": "A required topic is published, with its type, rate and QoS",
    "availability": "A transform is available soon after messages arrive",
    "clock": "The stamps are of the required clock",
    "frames": "There are no other frames",
    "finding": "The doctor finds no problem",
    "unreadable": "The recording can be read",
    "unchecked": "Each requirement can be checked",
}


def as_sarif(verdicts: Iterable[Verdict]) -> dict[str, Any]:
    """Return one run with a result for each problem."""
    rules = [{"id": f"contract/{kind}", "shortDescription": {"text": text}} for kind, text in _RULES.items()]
    results = [each for verdict in verdicts for each in _results(verdict)]
    driver = {"name": "coframe contract", "version": coframe.__version__, "rules": rules}
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [{"tool": {"driver": driver}, "results": results}]}


def _results(verdict: Verdict) -> list[dict[str, Any]]:
    found = [_result(verdict, result, problem) for result in verdict.broken for problem in result.problems]
    found += [_entry(verdict, "unchecked", "", reason, level="note") for reason in verdict.unchecked]
    return [*found, _entry(verdict, "unreadable", "", verdict.unreadable)] if verdict.unreadable else found


def _result(verdict: Verdict, result: Result, problem: str) -> dict[str, Any]:
    return _entry(verdict, result.kind, result.subject, f"{result.subject}: {problem}")


def _entry(verdict: Verdict, kind: str, subject: str, text: str, *, level: str = "error") -> dict[str, Any]:
    location: dict[str, Any] = {}
    if verdict.source != "live":
        location["physicalLocation"] = {"artifactLocation": {"uri": file_uri(Path(verdict.source))}}
    if subject:
        location["logicalLocations"] = [{"name": subject}]
    return {
        "ruleId": f"contract/{kind}",
        "ruleIndex": list(_RULES).index(kind),
        "level": level,
        "message": {"text": text},
        "locations": [location],
    }
