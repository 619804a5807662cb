# SPDX-License-Identifier: Apache-2.0
"""A report as plain data, for JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.doctor.codes import page

if TYPE_CHECKING:
    from coframe.doctor._diagnosis import Report
    from coframe.doctor._finding import Finding

__all__ = ["as_data"]


def as_data(report: Report) -> dict[str, Any]:
    """Return the data that ``--json`` prints. All times are integer nanoseconds."""
    seen = report.observation
    return {
        "healthy": report.healthy,
        "live": seen.live,
        "start_ns": seen.start,
        "end_ns": seen.end,
        "transforms": len(seen.transforms),
        "frames": list(seen.frames),
        "trees": {root: list(frames) for root, frames in seen.trees.items()},
        "findings": [_finding_data(finding) for finding in report.findings],
        "sensors": [
            {
                "topic": sensor.topic,
                "frame": sensor.frame,
                "root": sensor.root,
                "messages": sensor.messages,
                "sweep_ns": sensor.sweep,
                "possible_at_once": sensor.possible[0],
                "possible_after_50_ms": sensor.possible[1],
                "possible_after_100_ms": sensor.possible[2],
                "possible_after_200_ms": sensor.possible[3],
                "median_wait_ns": sensor.median_wait,
                "longest_wait_ns": sensor.longest_wait,
            }
            for sensor in report.sensors
        ],
        "clock_offsets": {
            name: {"offset_ns": offset.offset, "spread_ns": offset.spread, "drift_ppm": offset.drift}
            for name, offset in ((name, seen.offset(name)) for name in seen.clocks)
        },
        "topics": {facts.name: {"type": facts.type, "messages": facts.messages} for facts in seen.topics.values()},
        "unread": list(seen.unread),
    }


def _finding_data(finding: Finding) -> dict[str, Any]:
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "title": page(finding.code).title,
        "page": finding.page,
        "text": finding.text,
        "edge": list(finding.edge) if finding.edge else None,
        "edges": [list(edge) for edge in finding.edges or (finding.edge,) if edge],
        "topic": finding.topic or None,
        "topics": list(finding.topics) or [topic for topic in (finding.topic,) if topic],
        "frames": sorted(finding.frames),
        "first_stamp_ns": finding.first_stamp,
        "publishers": list(finding.publishers),
        "why": finding.why,
        "fix": finding.fix,
        "repairs": list(finding.repairs),
        "choices": list(finding.choices),
        "explains": [_finding_data(effect) for effect in finding.explains],
    }
