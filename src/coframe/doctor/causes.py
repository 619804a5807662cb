"""Which findings are the consequence of which, as data: in a report they stand below their cause."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from coframe.doctor.finding import Finding

__all__ = ["CAUSES", "joined"]

# (cause, consequence, whether only about a frame that both are about)
CAUSES: tuple[tuple[str, str, bool], ...] = (
    ("TF012", "TF011", False),  # after a jump back, all that is sent looks old
    ("TF012", "TF013", False),
    ("TF012", "TF008", False),
    ("TF017", "TF001", False),  # without its static transforms a tree falls apart
    ("TF017", "TF014", False),
    ("TF016", "TF001", False),  # likewise if they are not delivered
    ("TF016", "TF014", False),
    ("TF024", "TF022", False),  # no model, no joints
    ("TF024", "TF023", False),
    ("TF006", "TF001", True),  # a name with and without its prefix makes two trees
    ("TF006", "TF014", True),
    ("TF019", "TF001", True),  # a link that tf2 refuses is not there
    ("TF019", "TF014", True),
    ("TF004", "TF001", True),
    ("TF002", "TF004", True),  # two who disagree about parents make the loop
    ("TF002", "TF001", True),
    ("TF002", "TF003", True),
    ("TF003", "TF020", True),  # two who disagree about a pose make it jump
    ("TF003", "TF011", True),
    ("TF003", "TF013", True),
    ("TF005", "TF003", True),
    ("TF005", "TF020", True),
    ("TF009", "TF008", True),
    ("TF009", "TF014", True),
    ("TF009", "TF015", True),
    ("TF010", "TF008", True),
    ("TF010", "TF014", True),
    ("TF018", "TF013", True),  # what never changes needs no rate
    ("TF018", "TF008", True),  # and is sent ahead of time, so that it is there
    ("TF013", "TF014", True),
    ("TF013", "TF025", False),
    ("TF001", "TF014", True),
    ("TF001", "TF025", False),
    ("TF022", "TF001", True),  # joints without states are not told of
    ("TF022", "TF014", True),
    ("TF021", "TF023", True),
)


def joined(findings: list[Finding]) -> list[Finding]:
    """The causes, worst first, with what they explain; a finding stands below one cause only."""
    causes = _causes(findings)
    below: dict[int, list[Finding]] = {}
    for position, cause in causes.items():
        if cause is not None:
            below.setdefault(_outermost(cause, causes), []).append(findings[position])
    roots = [
        finding.explaining(tuple(below.get(position, ())))
        for position, finding in enumerate(findings)
        if causes[position] is None
    ]
    return sorted(roots, key=lambda finding: (-_worst(finding), finding.code))


def _worst(finding: Finding) -> int:
    return max(finding.severity, *(other.severity for other in finding.explains), 0)


def _causes(findings: list[Finding]) -> dict[int, int | None]:
    """By position the first finding of the first code that explains it."""
    first: dict[tuple[str, str | None], int] = {}  # of a code, and of a code and a frame
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


def _outermost(position: int, causes: dict[int, int | None]) -> int:
    seen = {position}
    while (further := causes[position]) is not None and further not in seen:
        position = further
        seen.add(position)
    return position
