"""What the doctor finds in what is shown, in a thread of its own and only while somebody looks.

The verdict is that of `coframe doctor`: of a recording once, of the graph again and again on the last seconds.
"""

from __future__ import annotations

import logging
import threading
import time
from contextlib import closing
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from coframe.errors import RecordingError, ViewerError, WireError

if TYPE_CHECKING:
    from collections.abc import Generator

    from coframe.doctor import Report
    from coframe.viewer.sources.source import Source

__all__ = ["Findings", "Told", "rows"]

_logger = logging.getLogger("coframe.viewer")

# In seconds: the first picture comes first; how often an examination goes on; who has not looked for so long is gone.
_DELAY, _STEP, _PATIENCE = 1.0, 0.5, 5.0
_END_TIMEOUT = 2.0
# What comes from the wire may be as much as it likes; a page shows so much of it.
_MOST, _MOST_FRAMES, _LONGEST = 200, 50, 2000


class Told(NamedTuple):
    """What there is to tell.

    Attributes:
        state: "none" where nothing is examined, "waiting" before the first verdict.
        text: Why nothing could be examined, or "".
        findings: As `coframe doctor --json` has them, causes first, with the namespace of each.
    """

    state: Literal["none", "waiting", "told", "failed"]
    text: str = ""
    findings: tuple[dict[str, Any], ...] = ()


class Findings:
    """The findings in one source after the other."""

    def __init__(self) -> None:
        self.told = Told("none")
        self._examiner: _Examiner | None = None
        self._source: Source | None = None

    def watch(self, source: Source) -> None:
        """Has a source examined from now on, as long as this is called every few seconds."""
        if source is not self._source:
            if self._examiner is not None:
                self._examiner.end()
                self._examiner = None
            self._source, self.told = source, Told("none")
        if self._examiner is None or self._examiner.has_lost_interest:
            self._examiner = _Examiner(source)
        self._examiner.watched = time.monotonic()
        self.told = self._examiner.told

    def close(self) -> None:
        """Ends the examination that goes on, and waits for that."""
        if self._examiner is not None:
            self._examiner.end()
            self._examiner.join()
            self._examiner = None


class _Examiner:
    """The examination of one source."""

    def __init__(self, source: Source) -> None:
        self.told = Told("none")
        self.watched = time.monotonic()
        self.has_lost_interest = False
        self._end = threading.Event()
        self._thread: threading.Thread | None = None
        examination = source.examine()
        if examination is not None:
            self.told = Told("waiting")
            name = "coframe-viewer-doctor"
            self._thread = threading.Thread(target=self._run, args=(examination,), name=name, daemon=True)
            self._thread.start()

    def end(self) -> None:
        """Ends it soon; what it holds is given back by its own thread."""
        self._end.set()

    def join(self) -> None:
        """Waits a moment for its end."""
        if self._thread is not None:
            self._thread.join(_END_TIMEOUT)

    def _run(self, examination: Generator[dict[str, Report] | None, None, None]) -> None:
        try:
            with closing(examination):
                pause = _DELAY
                while not self._end.wait(pause):
                    if time.monotonic() > self.watched + _PATIENCE:
                        self.has_lost_interest = True
                        return
                    reports = next(examination)
                    if reports is not None:
                        self.told = Told("told", findings=_data(reports))
                    pause = _STEP
        except StopIteration:
            return
        except (RecordingError, ViewerError, WireError) as error:
            self.told = Told("failed", f"{error} {error.hint}".strip())
        except Exception:
            _logger.exception("the transforms could not be examined; the viewer goes on")
            self.told = Told("failed", "The doctor failed; the server's log says how.")


def rows(told: Told, origin: int) -> list[dict[str, Any]]:
    """The findings for a page: their stamps relative to an origin."""
    return [_row(finding, origin) for finding in told.findings]


def _data(reports: dict[str, Report]) -> tuple[dict[str, Any], ...]:
    from coframe.doctor.rendering.plain import as_data  # noqa: PLC0415 - the viewer starts without the doctor

    named = ((name, as_data(report)["findings"]) for name, report in reports.items())
    found = [{**finding, "namespace": name} for name, findings in named for finding in findings]
    return tuple(found[:_MOST])


def _row(finding: dict[str, Any], origin: int) -> dict[str, Any]:
    stamp = finding["first_stamp_ns"]
    return {
        "code": finding["code"],
        "severity": finding["severity"],
        "title": finding["title"],
        "subject": _cut(" → ".join(finding["edge"]) if finding["edge"] else finding["topic"] or ""),
        # A link stands on its child's row.
        "frames": finding["edge"][1:] if finding["edge"] else finding["frames"][:_MOST_FRAMES],
        "text": _cut(finding["text"]),
        "why": finding["why"],
        "fix": _cut(finding["fix"]),
        "publishers": finding["publishers"][:_MOST_FRAMES],
        "first": None if stamp is None else stamp - origin,
        "namespace": finding.get("namespace", ""),
        "explains": [_row(effect, origin) for effect in finding["explains"][:_MOST]],
    }


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]} …"
