# SPDX-License-Identifier: Apache-2.0
"""Combine findings about the same problem of many edges or topics, such as all joints of an arm."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from coframe._output.formatting import join_names

if TYPE_CHECKING:
    from collections.abc import Hashable

    from coframe.doctor._finding import Finding

__all__ = ["merge_similar"]

_MIN_SUBJECTS = 3  # edges or topics
# A number with its unit, in which the texts about the edges may differ.
_NUMBER_WITH_UNIT = re.compile(r"[-+]?\d[\d.,_]*(?:e[-+]?\d+)?\s?(?:ns|us|ms|min|s|h|Hz|mm|m|%|deg(?:rees)?)?\b")


def merge_similar(findings: list[Finding]) -> list[Finding]:
    """Return the findings, with one instead of several that differ only in their edges or topics, and in numbers."""
    groups: dict[Hashable, list[Finding]] = {}
    for position, finding in enumerate(findings):
        groups.setdefault(_kind(finding) if finding.subject else position, []).append(finding)
    return [one for group in groups.values() for one in ([_merge_group(group)] if _has_many_subjects(group) else group)]


def _has_many_subjects(group: list[Finding]) -> bool:
    return len({finding.subject for finding in group}) >= _MIN_SUBJECTS


def _kind(finding: Finding) -> Hashable:
    """Return a key that is equal for findings about the same problem of different edges or topics."""
    about_edge = finding.edge is not None
    # The messages of several sensors have a publisher each; the transforms of one arm have the same one.
    publishers = finding.publishers if about_edge else ()
    return finding.code, finding.severity, about_edge, publishers, finding.harm, _pattern(finding)


def _pattern(finding: Finding) -> str:
    """Return the text without numbers and without the names of the edge, of the topic and of frames."""
    text = finding.text
    for name in sorted({*finding.frames, finding.topic} - {""}, key=lambda name: (-len(name), name)):
        text = re.sub(rf"(?<![\w/]){re.escape(name)}(?![\w/])", "\0", text)
    return _NUMBER_WITH_UNIT.sub("\1", text)


def _merge_group(group: list[Finding]) -> Finding:
    """Return the first finding, extended by the other edges or topics."""
    first = group[0]
    edges = tuple(dict.fromkeys(edge for finding in group if finding.edge for edge in (finding.edge, *finding.edges)))
    topics = () if edges else tuple(dict.fromkeys(finding.topic for finding in group))
    others = join_names(map(" -> ".join, edges[1:])) if edges else join_names(topics[1:])
    noun = "edges" if edges else "topics"
    stamps = [finding.first_stamp for finding in group if finding.first_stamp is not None]
    same_fix = all(finding.fix == first.fix for finding in group)
    return replace(
        first,
        text=f"{first.text}; the same for {len(edges or topics) - 1} other {noun}: {others}",
        fix=first.fix if same_fix else f"{first.fix} Do the same for the other {noun}.",
        edges=edges,
        topics=topics,
        frames=frozenset().union(*(finding.frames for finding in group)),
        first_stamp=min(stamps, default=None),
        publishers=tuple(dict.fromkeys(name for finding in group for name in finding.publishers)),
        repairs=tuple(dict.fromkeys(rule for finding in group for rule in finding.repairs)),
        choices=tuple(dict.fromkeys(rule for finding in group for rule in finding.choices)),
    )
