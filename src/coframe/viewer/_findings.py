# SPDX-License-Identifier: Apache-2.0
"""The doctor's findings on the displayed source, computed in a thread while a page is open.

A recording is examined once; of the ROS graph, the last few seconds are examined repeatedly, as in `coframe doctor
--watch`.
"""

from __future__ import annotations

import logging
import threading
import time
from contextlib import closing
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._output.formatting import error_text
from coframe.errors import RecordingError, ViewerError, WireError
from coframe.viewer.protocol.server_messages import FindingEntry

if TYPE_CHECKING:
    from collections.abc import Generator

    from coframe.doctor import Report
    from coframe.viewer.protocol.common import FindingsState
    from coframe.viewer.sources.source import ViewerSource

__all__ = ["FindingsReport", "FindingsWatcher", "finding_rows"]

_logger = logging.getLogger("coframe.viewer")

# In seconds: the delay before an examination starts, so that the page shows the frames first; the time between two
# steps of an examination; and the time without a request after which it ends.
_DELAY, _STEP, _IDLE_TIMEOUT = 1.0, 0.5, 5.0
_END_TIMEOUT = 2.0
# Limits on what is sent to a page, because the data on the graph is unlimited.
_MAX_FINDINGS, _MAX_FRAMES, _MAX_TEXT = 200, 50, 2000


class FindingsReport(NamedTuple):
    """The state of an examination.

    Attributes:
        state: "none" if nothing is examined, "waiting" before the first report.
        text: The reason for a failure, or "".
        findings: The findings as in the output of `coframe doctor --json`, causes first, each with its namespace.
    """

    state: FindingsState
    text: str = ""
    findings: tuple[dict[str, Any], ...] = ()


class FindingsWatcher:
    """Examines one source at a time."""

    def __init__(self) -> None:
        self.report = FindingsReport("none")
        self._job: _FindingsJob | None = None
        self._source: ViewerSource | None = None

    def watch(self, source: ViewerSource) -> None:
        """Examine a source and update the report, as long as this is called every few seconds."""
        if source is not self._source:
            if self._job is not None:
                self._job.end()
                self._job = None
            self._source, self.report = source, FindingsReport("none")
        if self._job is None or self._job.has_timed_out:
            self._job = _FindingsJob(source)
        self._job.last_request = time.monotonic()
        self.report = self._job.report

    def close(self) -> None:
        """End the examination and wait for its thread."""
        if self._job is not None:
            self._job.end()
            self._job.join()
            self._job = None


class _FindingsJob:
    """The examination of one source."""

    def __init__(self, source: ViewerSource) -> None:
        self.report = FindingsReport("none")
        self.last_request = time.monotonic()
        self.has_timed_out = False
        self._end = threading.Event()
        self._thread: threading.Thread | None = None
        examination = source.examine()
        if examination is not None:
            self.report = FindingsReport("waiting")
            name = "coframe-viewer-doctor"
            self._thread = threading.Thread(target=self._run, args=(examination,), name=name, daemon=True)
            self._thread.start()

    def end(self) -> None:
        """End the examination soon. Its thread releases its resources."""
        self._end.set()

    def join(self) -> None:
        """Wait briefly for the end of the examination."""
        if self._thread is not None:
            self._thread.join(_END_TIMEOUT)

    def _run(self, examination: Generator[dict[str, Report] | None, None, None]) -> None:
        try:
            with closing(examination):
                pause = _DELAY
                while not self._end.wait(pause):
                    if time.monotonic() > self.last_request + _IDLE_TIMEOUT:
                        self.has_timed_out = True
                        return
                    self._update(next(examination))
                    pause = _STEP
        except StopIteration:
            return
        except (RecordingError, ViewerError, WireError) as error:
            self.report = FindingsReport("failed", error_text(error))
        except Exception:
            _logger.exception("the doctor failed; the viewer continues without findings")
            self.report = FindingsReport("failed", "The doctor failed. The server's log contains the error.")

    def _update(self, reports: dict[str, Report] | None) -> None:
        # A separate method, because a loop variable would keep the last report alive until the next one is complete.
        if reports is not None:
            self.report = FindingsReport("ready", findings=_findings(reports))


def finding_rows(report: FindingsReport, origin: int) -> list[FindingEntry]:
    """Return the findings for a page, with stamps relative to an origin in nanoseconds."""
    return [_row(finding, origin) for finding in report.findings]


def _findings(reports: dict[str, Report]) -> tuple[dict[str, Any], ...]:
    # Imported here so that the viewer starts without loading the doctor.
    from coframe.doctor.rendering.plain import as_data  # noqa: PLC0415

    named = ((name, as_data(report)["findings"]) for name, report in reports.items())
    found = [{**finding, "namespace": name} for name, findings in named for finding in findings]
    return tuple(found[:_MAX_FINDINGS])


def _row(finding: dict[str, Any], origin: int) -> FindingEntry:
    stamp = finding["first_stamp_ns"]
    edge = finding["edge"]
    return FindingEntry(
        code=finding["code"],
        severity=finding["severity"],
        title=finding["title"],
        subject=_shorten(" → ".join(edge) if edge else finding["topic"] or ""),
        # An edge is shown in the row of its child.
        frames=[child for _, child in finding["edges"][:_MAX_FRAMES]] if edge else finding["frames"][:_MAX_FRAMES],
        text=_shorten(finding["text"]),
        why=finding["why"],
        fix=_shorten(finding["fix"]),
        publishers=finding["publishers"][:_MAX_FRAMES],
        first=None if stamp is None else stamp - origin,
        namespace=finding.get("namespace", ""),
        explains=[_row(effect, origin) for effect in finding["explains"][:_MAX_FINDINGS]],
    )


def _shorten(text: str) -> str:
    return text if len(text) <= _MAX_TEXT else f"{text[:_MAX_TEXT]} …"
