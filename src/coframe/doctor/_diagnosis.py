# SPDX-License-Identifier: Apache-2.0
"""Diagnosis: runs all checks on an observation."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe._output import html_tables
from coframe._output.escaping import one_line
from coframe._output.formatting import count
from coframe.doctor import checks
from coframe.doctor._causes import group_by_cause
from coframe.doctor._finding import Finding, Severity, findings_table
from coframe.doctor._grouping import merge_similar
from coframe.doctor._plugin_checks import plugin_checks
from coframe.doctor.observation import NEVER
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator

    from coframe.doctor._plugin_checks import PluginCheck
    from coframe.doctor.observation import Observation, Sensor

    Check = Callable[[Observation], Iterator[Finding]]

__all__ = ["Report", "SensorFacts", "all_checks", "built_in_checks", "diagnose"]

# Typical timeouts with which a consumer waits for a transform.
TIMEOUTS = (0, 50 * MILLISECOND, 100 * MILLISECOND, 200 * MILLISECOND)


class SensorFacts(NamedTuple):
    """The number of messages on a topic that could be transformed to the root of their tree, and the delays.

    Attributes:
        topic: The name of the topic.
        frame: The frame in which its messages are expressed.
        root: The root of the tree of that frame; the frame itself if no transform contains it.
        messages: The number of messages.
        sweep: The time from the stamp of a message to its last point, which also needs a transform; nanoseconds.
        possible: The numbers of messages that can be transformed immediately, and within 50, 100 and 200 ms of their
        arrival.
        median_wait: The median wait of the messages that can be transformed, in nanoseconds, or None if there are none.
        longest_wait: The longest wait of these messages.
    """

    topic: str
    frame: str
    root: str
    messages: int
    sweep: int
    possible: tuple[int, int, int, int]
    median_wait: int | None
    longest_wait: int | None


class Report(NamedTuple):
    """The result of a diagnosis.

    Attributes:
        findings: The causes with their consequences, the worst first.
        sensors: Statistics of the transformable messages of each sensor.
        observation: The observation that was examined.
    """

    findings: list[Finding]
    sensors: list[SensorFacts]
    observation: Observation

    @property
    def healthy(self) -> bool:
        """Whether there are transforms and no warnings or errors."""
        return len(self.observation.transforms) > 0 and all(
            finding.severity < Severity.WARNING for finding in self.every_finding()
        )

    def every_finding(self) -> list[Finding]:
        """Return the causes and their consequences as one list."""
        return [one for finding in self.findings for one in (finding, *finding.explains)]

    def _repr_html_(self) -> str:
        findings = self.every_finding()
        return html_tables.section(count(len(findings), "finding"), findings_table(findings))


def all_checks() -> dict[str, Check]:
    """Return the checks by code: coframe's checks, then the checks of other distributions."""
    return built_in_checks() | {code: partial(_run_guarded, check) for code, check in plugin_checks().items()}


@cache
def built_in_checks() -> dict[str, Check]:
    """Return coframe's own checks by code: one per module of `coframe.doctor.checks`."""
    modules = [
        importlib.import_module(f"{checks.__name__}.{module.name}") for module in pkgutil.iter_modules(checks.__path__)
    ]
    return {module.CODE: module.find for module in sorted(modules, key=lambda module: str(module.CODE))}


def diagnose(observation: Observation, *, ignore: Collection[str] = ()) -> Report:
    """Run all checks except those to ignore.

    Args:
        observation: The data to examine.
        ignore: The codes of checks to ignore, such as ``TF012``.
    """
    ignored = {code.upper() for code in ignore}
    # Published values may overflow; comparisons with NaN are false.
    with np.errstate(all="ignore"):
        findings = [
            finding for code, check in all_checks().items() if code not in ignored for finding in check(observation)
        ]
    sensors = [_facts(observation, sensor) for sensor in observation.sensors if len(sensor.stamp)]
    return Report(group_by_cause(merge_similar(findings)), sensors, observation)


def _run_guarded(check: PluginCheck, observation: Observation) -> Iterator[Finding]:
    """Yield the findings of a check of another distribution. An error in it becomes a note and ends only this check."""
    try:
        for finding in check.find(observation):
            _require_finding(finding, check.code)
            yield finding
    except (Exception, SystemExit) as error:  # noqa: BLE001 - the code is not ours
        yield Finding(
            code=check.code,
            severity=Severity.NOTE,
            text=one_line(f"the check failed and may have missed problems: {type(error).__name__}: {error}"),
            fix=f"Update the package {check.plugin.package}, or skip the check: coframe doctor --ignore {check.code}",
            harm=f"The check of the package {check.plugin.package} did not examine everything.",
        )


def _require_finding(found: Any, code: str) -> None:
    if not isinstance(found, Finding) or found.code != code:
        raise TypeError(f"find() yielded {found!r:.100}, which is not a Finding with the code {code}")
    values: tuple[Any, ...] = (found.severity, found.text, found.fix)
    if not all(map(isinstance, values, (Severity, str, str))):
        raise TypeError(f"find() yielded {found!r:.100}, whose severity is not a Severity or whose text is not a str")


def _facts(observation: Observation, sensor: Sensor) -> SensorFacts:
    known = sensor.frame in observation.frames
    waits = observation.waits(sensor) if known else np.full(len(sensor.stamp), NEVER)
    finite = waits[waits != NEVER]
    return SensorFacts(
        sensor.topic,
        sensor.frame,
        observation.root(sensor.frame),
        len(waits),
        sensor.sweep,
        tuple(int(np.count_nonzero(waits <= timeout)) for timeout in TIMEOUTS),  # type: ignore[arg-type]
        int(np.median(finite)) if len(finite) else None,
        int(finite.max()) if len(finite) else None,
    )
