# SPDX-License-Identifier: Apache-2.0
"""A report as text: each finding in one line, followed by why it matters and what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import count, duration, join_names, seconds
from coframe.type_names import is_tf_message

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._diagnosis import Report, SensorFacts
    from coframe.doctor._finding import Finding
    from coframe.doctor.observation import Observation

__all__ = ["report_lines"]


def report_lines(report: Report) -> Iterator[tuple[str, str]]:
    """Yield pairs of a style (``error``, ``warning``, ``note``, ``good``, ``dim`` or ``plain``) and a line."""
    for finding in report.findings:
        yield str(finding.severity), headline(finding)
        yield "dim", f"      why: {finding.why}"
        yield "plain", f"      do:  {finding.fix}"
        for effect in finding.explains:
            yield "dim", f"      so:  {headline(effect)}"
    yield from _summary(report)
    for sensor in report.sensors:
        if sensor.frame != sensor.root:
            yield "dim", _sensor(sensor)


def headline(finding: Finding) -> str:
    """Return the code, severity, subject, text, first stamp and publishers of a finding in one line."""
    subject = f"{finding.subject}: " if finding.subject else ""
    stamp = "" if not finding.first_stamp else f"; first stamp {seconds(finding.first_stamp)}"
    publishers = f"; published by {join_names(finding.publishers)}" if finding.publishers else ""
    return f"{finding.code} {finding.severity}: {subject}{finding.text}{stamp}{publishers}"


def _summary(report: Report) -> Iterator[tuple[str, str]]:
    seen = report.observation
    examined = (
        f"{count(len(seen.transforms), 'transform')} of {count(len({edge.key for edge in seen.edges}), 'edge')}, "
        f"{count(len(seen.frames), 'frame')} in {count(len(seen.trees), 'tree')}, "
        f"{count(len(report.sensors), 'sensor')}, "
        f"{duration(seen.duration)}"
    )
    every = report.every_finding()
    if not len(seen.transforms):
        yield "warning", f"no transforms in {duration(seen.duration)}: nothing to examine" + _other_transforms(seen)
    elif not every:
        yield "good", f"healthy: {examined}"
    else:
        counts = {
            kind: sum(str(finding.severity) == kind for finding in every) for kind in ("error", "warning", "note")
        }
        found = ", ".join(count(number, kind) for kind, number in counts.items() if number)
        yield "plain", f"{found}; examined {examined}. For details: `coframe doctor --explain {every[0].code}`"


def _other_transforms(observation: Observation) -> str:
    """Return the other topics with transforms, or what to check."""
    topics = [topic.name for topic in observation.topics.values() if is_tf_message(topic.type) and topic.messages]
    if topics:
        return f"; there are transforms on {join_names(topics)}"
    return ". Is a broadcaster running in the same ROS domain?" if observation.live else ""


def _sensor(sensor: SensorFacts) -> str:
    at_once, *later = sensor.possible
    waits = (
        ""
        if sensor.median_wait is None
        else f" (median wait {duration(sensor.median_wait)}, longest {duration(sensor.longest_wait or 0)})"
    )
    until = f" until the end of each sweep, {duration(sensor.sweep)} after its stamp" if sensor.sweep else ""
    return (
        f"{sensor.topic}: from {sensor.frame} to {sensor.root}{until}: {at_once} of {sensor.messages} messages can be "
        "transformed immediately, "
        + ", ".join(f"{number} after {after} ms" for number, after in zip(later, (50, 100, 200), strict=True))
        + waits
    )
