# SPDX-License-Identifier: Apache-2.0
"""The repair of a recording: rules for problems with one safe repair, and choices for the others."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe.bags.editing import RULES, Recipe
from coframe.doctor._finding import Severity
from coframe.errors import EditError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.doctor._diagnosis import Report
    from coframe.doctor._finding import Finding

__all__ = ["RepairPlan", "plan_repair"]

# Rules find the names that earlier rules have written, and findings have the names of the recording. So the rules that
# change names come last.
_RULE_ORDER = [name for name in RULES if name not in {"rename-frame", "prefix", "strip-slashes"}]
_RULE_ORDER += ["rename-frame", "prefix", "strip-slashes"]


class RepairPlan(NamedTuple):
    """What repairs a recording.

    Attributes:
        recipe: The rules for the findings that have one safe repair.
        choices: The findings that have none, each with the rules of which one repairs it; there may be no such rule.
    """

    recipe: Recipe
    choices: list[tuple[Finding, list[str]]]


def plan_repair(reports: Iterable[Report]) -> RepairPlan:
    """Return the repair plan for reports about a recording, one report for each namespace.

    If two findings need different values for the same thing, such as two poses of one mount, they become choices.
    """
    found = [one for report in reports for one in report.findings]
    values: dict[tuple[str, str], dict[str, None]] = {}
    for finding in found:
        for rule in (*finding.repairs, *finding.choices):
            values.setdefault(_subject(rule), {})[rule] = None
    rules: dict[str, int] = {}
    choices = []
    for finding in found:
        if finding.severity < Severity.WARNING:
            continue
        is_safe = bool(finding.repairs) and all(len(values[_subject(rule)]) == 1 for rule in finding.repairs)
        if is_safe and _are_valid(finding.repairs):
            rules.update({rule: _RULE_ORDER.index(rule.partition(" ")[0]) for rule in finding.repairs})
        else:
            own = (*finding.repairs, *finding.choices)
            choices.append((finding, list(dict.fromkeys(each for rule in own for each in values[_subject(rule)]))))
    return RepairPlan(Recipe(sorted(rules, key=lambda rule: rules[str(rule)])), choices)


def _subject(rule: str) -> tuple[str, str]:
    """Return the name of a rule and what it changes: ``replace-mount lidar`` for ``replace-mount lidar 1 2 3 ...``."""
    name, _, value = rule.partition(" ")
    separator = "=" if "=" in value and name != "replace-mount" else " "
    return name, value.partition(separator)[0]


def _are_valid(rules: Iterable[str]) -> bool:
    """Return whether rules can be written: names of frames in recordings can contain anything."""
    try:
        Recipe(rules)
    except EditError:
        return False
    return True
