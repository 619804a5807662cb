# SPDX-License-Identifier: Apache-2.0
"""The examination of each middleware, for `coframe doctor --system`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe.system import _dds_examination as dds_examination
from coframe.system import _zenoh_examination as zenoh_examination
from coframe.system._examination import Examination, Examined
from coframe.wire import selection

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from coframe.system._examination import Attempts
    from coframe.system.report import SystemReport
    from coframe.wire.selection import Selection

__all__ = ["EXAMINATIONS", "examination_of"]

EXAMINATIONS: Final = (dds_examination.EXAMINATION, zenoh_examination.EXAMINATION)


def examination_of(selected: Selection | None) -> Examination:
    """Return the check of the selected middleware; the DDS check if the selection is invalid.

    A middleware without an examination of its own describes itself, and joins the graph.
    """
    if selected is None:
        return dds_examination.EXAMINATION
    for examination in EXAMINATIONS:
        if examination.wire == selected.wire:
            return examination
    return Examination(selected.wire, _examine, _lines, ())


def _examine(domain: int | None, environment: Mapping[str, str], attempt: Attempts) -> Examined:
    wire = selection.select(environment).wire
    lines = attempt(lambda: selection.row_of(wire).load().describe())
    return Examined(domain is not None and lines is not None, {"middleware": lines or []})


def _lines(report: SystemReport) -> Iterator[str]:
    yield from report.middleware
