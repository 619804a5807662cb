# SPDX-License-Identifier: Apache-2.0
"""Combine findings about the same problem of many edges, such as all joints of an arm with one publisher."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from coframe._output.formatting import listed

if TYPE_CHECKING:
    from collections.abc import Hashable

    from coframe.doctor._finding import Finding

__all__ = ["grouped"]

_MIN_EDGES = 3
# A number with its unit, in which the texts about the edges may differ.
_FIGURE = re.compile(r"[-+]?\d[\d.,_]*(?:e[-+]?\d+)?\s?(?:ns|us|ms|min|s|h|Hz|mm|m|%|deg(?:rees)?)?\b")


def grouped(findings: list[Finding]) -> list[Finding]:
    """Return the findings, with one instead of several that differ only in their edges and numbers."""
    groups: dict[Hashable, list[Finding]] = {}
    for position, finding in enumerate(findings):
        groups.setdefault(position if finding.edge is None else _kind(finding), []).append(finding)
    return [one for group in groups.values() for one in ([_merged(group)] if _edges(group) >= _MIN_EDGES else group)]


def _edges(group: list[Finding]) -> int:
    return len({finding.edge for finding in group if finding.edge is not None})


def _kind(finding: Finding) -> Hashable:
    """Return a key that is equal for findings about the same problem of different edges."""
    return finding.code, finding.severity, finding.publishers, finding.harm, _pattern(finding)


def _pattern(finding: Finding) -> str:
    """Return the text without numbers and without the names of the edge."""
    text = finding.text
    for name in sorted(finding.edge or (), key=len, reverse=True):
        text = text.replace(name, "\0")
    return _FIGURE.sub("\1", text)


def _merged(group: list[Finding]) -> Finding:
    """Return the first finding, extended by the other edges."""
    first = group[0]
    edges = tuple(dict.fromkeys(finding.edge for finding in group if finding.edge is not None))
    others = listed(" -> ".join(edge) for edge in edges[1:])
    stamps = [finding.first_stamp for finding in group if finding.first_stamp is not None]
    same_fix = all(finding.fix == first.fix for finding in group)
    return replace(
        first,
        text=f"{first.text}; the same for {len(edges) - 1} other edges: {others}",
        fix=first.fix if same_fix else f"{first.fix} Do the same for the other edges.",
        edges=edges,
        frames=frozenset().union(*(finding.frames for finding in group)),
        first_stamp=min(stamps, default=None),
    )
