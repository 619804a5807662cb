# SPDX-License-Identifier: Apache-2.0
"""Writes the results of tests as JUnit XML."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

if TYPE_CHECKING:
    import unittest
    from collections.abc import Mapping

__all__ = ["unittestResultsToXml"]

# Characters that XML 1.0 does not allow.
_FORBIDDEN = re.compile("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def unittestResultsToXml(
    *, name: str = "launch_test", test_results: Mapping[Any, unittest.TestResult]
) -> ET.ElementTree[ET.Element]:
    """Return the results as a tree of XML, whose method `write` writes the file.

    Args:
        name: Name of all tests together.
        test_results: The result of each run.
    """
    root = ET.Element("testsuites", name=name)
    totals = {"tests": 0, "failures": 0, "errors": 0, "time": 0.0}
    for run, result in test_results.items():
        suite = _suite(str(run), result)
        root.append(suite)
        for key, value in totals.items():
            totals[key] = value + float(suite.attrib[key])
    root.attrib.update({key: f"{value:.3f}" if key == "time" else str(int(value)) for key, value in totals.items()})
    return ET.ElementTree(root)


def _suite(name: str, result: Any) -> ET.Element:
    cases = list(getattr(result, "testCases", []))
    times = getattr(result, "testTimes", {})
    suite = ET.Element(
        "testsuite",
        name=name,
        tests=str(len(cases)),
        failures=str(len(result.failures) + len(result.unexpectedSuccesses)),
        errors=str(len(result.errors)),
        skipped=str(len(result.skipped)),
        time=f"{sum(times.values()):.3f}",
    )
    outcomes = [
        *((case, "failure", text) for case, text in result.failures),
        *((case, "failure", "unexpected success") for case in result.unexpectedSuccesses),
        *((case, "error", text) for case, text in result.errors),
        *((case, "skipped", text) for case, text in result.skipped),
    ]
    by_id: dict[str, list[tuple[str, str]]] = {}
    for case, kind, text in outcomes:
        by_id.setdefault(case.id(), []).append((kind, text))
    for case in cases:
        class_name, _, test = case.id().partition("[")[0].rpartition(".")
        values = case.id()[len(class_name) + 1 + len(test) :]
        element = ET.SubElement(
            suite, "testcase", classname=class_name, name=f"{test}{values}", time=f"{times.get(case, 0.0):.3f}"
        )
        for kind, text in by_id.pop(case.id(), []):
            _add(element, kind, text)
    for identifier, found in by_id.items():  # errors outside of tests, such as in setUpClass
        element = ET.SubElement(suite, "testcase", classname=identifier, name=identifier, time="0.000")
        for kind, text in found:
            _add(element, kind, text)
    return suite


def _add(case: ET.Element, kind: str, text: str) -> None:
    clean = _FORBIDDEN.sub("?", text)
    last = clean.strip().splitlines()[-1] if clean.strip() else ""
    ET.SubElement(case, kind, message=last).text = clean
