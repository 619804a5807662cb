# SPDX-License-Identifier: Apache-2.0
"""A report as SARIF 2.1.0, which code hosting sites show next to a change."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import coframe
from coframe.doctor._finding import Severity
from coframe.doctor.codes import codes, page

if TYPE_CHECKING:
    from coframe._sources.sources import Readable
    from coframe.doctor._diagnosis import Report
    from coframe.doctor._finding import Finding

__all__ = ["SCHEMA", "as_sarif", "file_uri"]

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_LEVELS = {Severity.NOTE: "note", Severity.WARNING: "warning", Severity.ERROR: "error"}


def as_sarif(reports: dict[str, Report], recording: Readable | None) -> dict[str, Any]:
    """Return one run with a result for every finding.

    Args:
        reports: The reports by namespace.
        recording: The path of the examined recording, or None for a running system.
    """
    rules = [
        {
            "id": code,
            "name": "".join(word.capitalize() for word in page(code).title.replace(",", "").split()),
            "shortDescription": {"text": page(code).title},
            "fullDescription": {"text": page(code).why},
            "help": {"text": page(code).text, "markdown": page(code).text},
        }
        for code in codes()
    ]
    results = [
        _result(finding, namespace, recording)
        for namespace, report in reports.items()
        for finding in report.every_finding()
    ]
    return {
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [
            {
                "tool": {"driver": {"name": "coframe doctor", "version": coframe.__version__, "rules": rules}},
                "results": results,
            }
        ],
    }


def _result(finding: Finding, namespace: str, recording: Readable | None) -> dict[str, Any]:
    subject = f"{finding.subject}: " if finding.subject else ""
    location: dict[str, Any] = {}
    if recording is not None:
        location["physicalLocation"] = {"artifactLocation": {"uri": file_uri(recording)}}
    if finding.subject:
        location["logicalLocations"] = [{"name": finding.subject, "fullyQualifiedName": namespace + finding.subject}]
    return {
        "ruleId": finding.code,
        "ruleIndex": codes().index(finding.code),
        "level": _LEVELS[finding.severity],
        "message": {"text": f"{subject}{finding.text}. {finding.fix}"},
        "locations": [location],
        "properties": {"first_stamp_ns": finding.first_stamp, "publishers": list(finding.publishers)},
    }


def file_uri(path: Readable) -> str:
    """Return the URI of a path; relative for a relative path, which code hosting sites resolve in the repository."""
    if not isinstance(path, Path):
        return str(path)
    return path.as_uri() if path.is_absolute() else quote(path.as_posix())
