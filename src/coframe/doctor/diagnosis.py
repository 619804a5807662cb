"""Diagnosis: all checks over one observation, and what came of it."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.doctor import checks
from coframe.doctor.causes import joined
from coframe.doctor.finding import Severity
from coframe.doctor.observation import NEVER

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator

    from coframe.doctor.finding import Finding
    from coframe.doctor.observation import Observation, Sensor

    Check = Callable[[Observation], Iterator[Finding]]

__all__ = ["Report", "SensorFacts", "all_checks", "diagnose"]

_MS = 1_000_000
# How long a consumer may be prepared to wait for a transform.
PATIENCE = (0, 50 * _MS, 100 * _MS, 200 * _MS)


class SensorFacts(NamedTuple):
    """How many of a topic's messages could be brought into the root of their tree, and after which wait.

    Attributes:
        topic: The topic.
        frame: What its messages are told in.
        root: The root of that frame's tree; the frame itself if no transform tells of it.
        messages: How many there are.
        possible: How many are possible at once, within 50, 100 and 200 ms of their arrival.
        median_wait: Of those that are possible at all, in nanoseconds; None without any.
        longest_wait: Likewise.
    """

    topic: str
    frame: str
    root: str
    messages: int
    possible: tuple[int, int, int, int]
    median_wait: int | None
    longest_wait: int | None


class Report(NamedTuple):
    """What is wrong, worst first, and what was looked at.

    Attributes:
        findings: Causes, with what they explain.
        sensors: When their messages could be transformed.
        observation: What was looked at.
    """

    findings: list[Finding]
    sensors: list[SensorFacts]
    observation: Observation

    @property
    def healthy(self) -> bool:
        """Whether there are transforms, and no finding of the level of a warning or above."""
        return len(self.observation.transforms) > 0 and all(
            finding.severity < Severity.WARNING for finding in self.every_finding()
        )

    def every_finding(self) -> list[Finding]:
        """Causes and what they explain, in a row."""
        return [one for finding in self.findings for one in (finding, *finding.explains)]


@cache
def all_checks() -> dict[str, Check]:
    """By code: one module of `coframe.doctor.checks` each."""
    modules = [
        importlib.import_module(f"{checks.__name__}.{module.name}") for module in pkgutil.iter_modules(checks.__path__)
    ]
    return {module.CODE: module.find for module in sorted(modules, key=lambda module: str(module.CODE))}


def diagnose(observation: Observation, *, ignore: Collection[str] = ()) -> Report:
    """All checks but those that are to be ignored.

    Args:
        observation: What was heard or read.
        ignore: Codes, such as ``TF012``.
    """
    unwanted = {code.upper() for code in ignore}
    # What is on the wire may overflow; the checks compare with limits, and NaN is within none.
    with np.errstate(all="ignore"):
        findings = [
            finding for code, check in all_checks().items() if code not in unwanted for finding in check(observation)
        ]
    sensors = [_facts(observation, sensor) for sensor in observation.sensors if len(sensor.stamp)]
    return Report(joined(findings), sensors, observation)


def _facts(observation: Observation, sensor: Sensor) -> SensorFacts:
    known = sensor.frame in observation.frames
    waits = observation.waits(sensor) if known else np.full(len(sensor.stamp), NEVER)
    told = waits[waits != NEVER]
    return SensorFacts(
        sensor.topic,
        sensor.frame,
        observation.root(sensor.frame),
        len(waits),
        tuple(int(np.count_nonzero(waits <= patience)) for patience in PATIENCE),  # type: ignore[arg-type]
        int(np.median(told)) if len(told) else None,
        int(told.max()) if len(told) else None,
    )
