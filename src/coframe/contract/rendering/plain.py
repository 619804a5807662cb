# SPDX-License-Identifier: Apache-2.0
"""Verdicts as plain data, for JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.contract._verdict import Verdict

__all__ = ["as_data"]


def as_data(verdicts: Iterable[Verdict]) -> list[dict[str, Any]]:
    """Return a mapping for each verdict."""
    return [
        {
            "source": verdict.source,
            "kept": verdict.is_kept,
            "unreadable": verdict.unreadable or None,
            "unchecked": list(verdict.unchecked),
            "requirements": [
                {"kind": each.kind, "subject": each.subject, "met": each.is_met, "problems": list(each.problems)}
                for each in verdict.results
            ],
        }
        for verdict in verdicts
    ]
