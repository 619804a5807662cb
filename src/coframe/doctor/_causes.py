# SPDX-License-Identifier: Apache-2.0
"""Causal relations between findings. A report lists consequences below their cause."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from coframe.doctor._finding import Finding

__all__ = ["CAUSES", "group_by_cause"]

# (cause, consequence, whether both must concern the same frame)
CAUSES: tuple[tuple[str, str, bool], ...] = (
    ("TF012", "TF011", False),  # after time jumps back, all new transforms look old
    ("TF012", "TF013", False),
    ("TF012", "TF008", False),
    ("TF017", "TF001", False),  # without its static transforms, a tree is split
    ("TF017", "TF014", False),
    ("TF016", "TF001", False),  # and if these are not delivered
    ("TF016", "TF014", False),
    ("TF024", "TF022", False),  # without a model there are no joints
    ("TF024", "TF023", False),
    ("TF006", "TF001", True),  # a name with and without its prefix is in two trees
    ("TF006", "TF014", True),
    ("TF019", "TF001", True),  # an edge that tf2 rejects does not exist
    ("TF019", "TF014", True),
    ("TF004", "TF001", True),
    ("TF002", "TF004", True),  # two publishers with different parents can form a loop
    ("TF002", "TF001", True),
    ("TF002", "TF003", True),
    ("TF003", "TF020", True),  # two publishers with different poses make it jump
    ("TF003", "TF011", True),
    ("TF003", "TF013", True),
    ("TF005", "TF003", True),
    ("TF005", "TF020", True),
    ("TF009", "TF008", True),
    ("TF009", "TF014", True),
    ("TF009", "TF015", True),
    ("TF010", "TF008", True),
    ("TF010", "TF014", True),
    ("TF018", "TF013", True),  # a constant transform needs no rate
    ("TF018", "TF008", True),  # and is stamped ahead, so that it is available
    ("TF013", "TF014", True),
    ("TF013", "TF025", False),
    ("TF001", "TF014", True),
    ("TF001", "TF025", False),
    ("TF022", "TF001", True),  # joints without states have no transform
    ("TF022", "TF014", True),
    ("TF021", "TF023", True),
    ("TF026", "TF022", False),  # joints whose states are never published
)


def group_by_cause(findings: list[Finding]) -> list[Finding]:
    """Return the causes with their consequences, the worst first. Each consequence is below only one cause."""
    causes = _causes(findings)
    below: dict[int, list[Finding]] = {}
    for position, cause in causes.items():
        if cause is not None:
            below.setdefault(_outermost_cause(cause, causes), []).append(findings[position])
    roots = [
        finding.with_consequences(tuple(below.get(position, ())))
        for position, finding in enumerate(findings)
        if causes[position] is None
    ]
    return sorted(roots, key=lambda finding: (-_severity_key(finding), finding.code))


def _severity_key(finding: Finding) -> int:
    return max(finding.severity, *(other.severity for other in finding.explains), 0)


def _causes(findings: list[Finding]) -> dict[int, int | None]:
    """Return the cause of each finding, by index: the first finding of the first matching code."""
    first: dict[tuple[str, str | None], int] = {}  # by code, and by code and frame
    for position, finding in enumerate(findings):
        for frame in (None, *finding.frames):
            first.setdefault((finding.code, frame), position)
    found: dict[int, int | None] = {}
    for position, effect in enumerate(findings):
        causes = (
            min((first[code, frame] for frame in effect.frames if (code, frame) in first), default=None)
            if share_frames
            else first.get((code, None))
            for code, consequence, share_frames in CAUSES
            if consequence == effect.code
        )
        found[position] = next((cause for cause in causes if cause is not None), None)
    return found


def _outermost_cause(position: int, causes: dict[int, int | None]) -> int:
    seen = {position}
    while (further := causes[position]) is not None and further not in seen:
        position = further
        seen.add(position)
    return position
