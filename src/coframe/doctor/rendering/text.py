"""A report for people: one finding a line, then why it matters and what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor.phrases import listed
from coframe.formatting import duration, seconds

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.diagnosis import Report, SensorFacts
    from coframe.doctor.finding import Finding
    from coframe.doctor.observation import Observation

__all__ = ["lines"]


def lines(report: Report) -> Iterator[tuple[str, str]]:
    """Pairs of a style (``error``, ``warning``, ``note``, ``good``, ``dim`` or ``plain``) and a line."""
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
    """Code, severity, edge, numbers, first stamp and publishers, in one line."""
    subject = f"{finding.subject}: " if finding.subject else ""
    stamp = "" if finding.first_stamp is None else f"; first stamp {seconds(finding.first_stamp)}"
    who = f"; published by {listed(finding.publishers)}" if finding.publishers else ""
    return f"{finding.code} {finding.severity}: {subject}{finding.text}{stamp}{who}"


def _summary(report: Report) -> Iterator[tuple[str, str]]:
    seen = report.observation
    looked_at = (
        f"{_count(len(seen.transforms), 'transform')} of {_count(len({edge.key for edge in seen.edges}), 'link')}, "
        f"{_count(len(seen.frames), 'frame')} in {_count(len(seen.trees), 'tree')}, "
        f"{_count(len(report.sensors), 'sensor')}, "
        f"{duration(seen.duration)}"
    )
    every = report.every_finding()
    if not len(seen.transforms):
        yield (
            "warning",
            f"no transforms at all in {duration(seen.duration)}: nothing could be judged" + _elsewhere(seen),
        )
    elif not every:
        yield "good", f"healthy: {looked_at}"
    else:
        counts = {
            kind: sum(str(finding.severity) == kind for finding in every) for kind in ("error", "warning", "note")
        }
        told = ", ".join(_count(count, kind) for kind, count in counts.items() if count)
        yield "plain", f"{told}; looked at {looked_at}. `coframe doctor --explain {every[0].code}` says more."


def _elsewhere(seen: Observation) -> str:
    """Where there are transforms, if not where they were looked for."""
    told = (topic for topic in seen.topics.values() if topic.type.lower().endswith("/tfmessage"))  # ROS 1: tf/tfMessage
    topics = [topic.name for topic in told if topic.messages]
    return f"; there are some on {listed(topics)}" if topics else ""


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _sensor(sensor: SensorFacts) -> str:
    at_once, *later = sensor.possible
    waits = (
        ""
        if sensor.median_wait is None
        else f" (median wait {duration(sensor.median_wait)}, longest {duration(sensor.longest_wait or 0)})"
    )
    return (
        f"{sensor.topic}: {sensor.frame} to {sensor.root}: of {sensor.messages} messages {at_once} at once, "
        + ", ".join(f"{count} after {after} ms" for count, after in zip(later, (50, 100, 200), strict=True))
        + waits
    )
