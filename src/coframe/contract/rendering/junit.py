# SPDX-License-Identifier: Apache-2.0
"""Verdicts as JUnit XML: a test suite for each recording, and a test case for each requirement.

The elements are those that Jenkins, GitLab and GitHub's test reporters read.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from xml.etree import ElementTree

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.contract._verdict import Verdict

__all__ = ["as_junit"]

# XML 1.0 has no representation of these characters, not even escaped.
_NOT_IN_XML = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def as_junit(verdicts: Sequence[Verdict]) -> bytes:
    """Return an XML document in UTF-8."""
    root = ElementTree.Element("testsuites", name="coframe contract")
    for verdict in verdicts:
        root.append(_suite(verdict))
    for name in ("tests", "failures", "errors"):
        root.set(name, str(sum(int(suite.get(name, "0")) for suite in root)))
    ElementTree.indent(root)
    return bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))


def _suite(verdict: Verdict) -> ElementTree.Element:
    unreadable = int(bool(verdict.unreadable))
    suite = ElementTree.Element(
        "testsuite",
        name=_clean(verdict.source),
        tests=str(len(verdict.results) + unreadable),
        failures=str(len(verdict.broken)),
        errors=str(unreadable),
    )
    for result in verdict.results:
        case = ElementTree.SubElement(
            suite, "testcase", classname=f"contract.{result.kind}", name=_clean(result.subject)
        )
        if not result.is_met:
            text = _clean("\n".join(result.problems))
            ElementTree.SubElement(case, "failure", message=text.partition("\n")[0], type=result.kind).text = text
    if verdict.unchecked:
        lines = "\n".join(f"not checked: {each}" for each in verdict.unchecked)
        ElementTree.SubElement(suite, "system-out").text = _clean(lines)
    if verdict.unreadable:
        case = ElementTree.SubElement(suite, "testcase", classname="contract.recording", name="can be read")
        ElementTree.SubElement(case, "error", message=_clean(verdict.unreadable), type="unreadable")
    return suite


def _clean(text: str) -> str:
    return _NOT_IN_XML.sub("?", text)
