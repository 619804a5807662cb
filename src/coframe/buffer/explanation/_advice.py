# SPDX-License-Identifier: Apache-2.0
"""Advice about a missing transform: the hint of the exception, or a more specific hint derived from the edges."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import duration, seconds
from coframe.errors import ExtrapolationException, looks_like_seconds
from coframe.errors.lookup_hints import hint
from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe.buffer.explanation._facts import ChainEdge, Explanation
    from coframe.errors import TransformException

__all__ = ["advice", "no_common_time"]

# The timeouts to suggest, in seconds. If a transform is later than the longest timeout, waiting is not useful.
_TIMEOUTS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)


def advice(explanation: Explanation, error: TransformException, *, is_recorded: bool) -> str:
    """Return what to do, and the code page with more details.

    Args:
        explanation: The explanation so far.
        error: The exception that the lookup raises.
        is_recorded: Whether the buffer contains recorded data, so that no more transforms will arrive.
    """
    edge = next((edge for edge in explanation.broken if error.edge and edge.child == error.edge[1]), None)
    edge = edge or next(iter(explanation.broken), None)
    if edge is None or explanation.code == "loop" or looks_like_seconds(error):
        return error.hint
    if edge.state == "no_data":
        return hint("no_data", child=edge.child)
    if explanation.roots is not None:
        return error.hint
    if explanation.span is None:
        return _no_common_time(explanation)
    if is_recorded:
        first, last = explanation.span
        return hint("outside", first=seconds(first), last=seconds(last))
    return _late_advice(explanation, edge) if edge.by > 0 else _early_advice(explanation, edge)


def no_common_time(explanation: Explanation) -> ExtrapolationException:
    """Return the error for frames between which the edges have no common time."""
    moving_edges = [edge for edge in explanation.edges if not edge.static]
    intervals = ", ".join(f"{edge.name} from {seconds(edge.oldest)} to {seconds(edge.newest)}" for edge in moving_edges)
    return ExtrapolationException.with_details(
        f"The edges between {explanation.target!r} and {explanation.source!r} have no common time: {intervals}",
        target=explanation.target,
        source=explanation.source,
        hint=_no_common_time(explanation) if moving_edges else "",
        code="too_old",
        doctor_code="TF013",
    )


def _no_common_time(explanation: Explanation) -> str:
    moving_edges = [edge for edge in explanation.edges if not edge.static]
    ends = min(moving_edges, key=lambda edge: edge.newest)
    begins = max(moving_edges, key=lambda edge: edge.oldest)
    return hint("no_common_time", limit=ends.name, parent=begins.parent, child=begins.child)


def _late_advice(explanation: Explanation, edge: ChainEdge) -> str:
    facts = {"parent": edge.parent, "child": edge.child, "target": explanation.target, "source": explanation.source}
    if explanation.now is not None and edge.stale:
        publisher = f", {edge.publisher}," if edge.publisher else ""
        return hint("stopped", age=duration(explanation.now - edge.newest), publisher=publisher, **facts)
    # One sample may just have been missed and the next one may be late, hence two periods.
    wait = edge.by + 2 * edge.period
    timeout = next((timeout for timeout in _TIMEOUTS if timeout * SECOND >= wait), None)
    if timeout is None:
        return hint("far_ahead", by=duration(edge.by), **facts)
    return hint("too_new", timeout=f"{timeout:g}", **facts)


def _early_advice(explanation: Explanation, edge: ChainEdge) -> str:
    cache_is_full = 0 <= explanation.cache <= edge.newest - edge.oldest + 2 * edge.period
    if cache_is_full:
        return hint("too_old", parent=edge.parent, child=edge.child)
    return hint("not_begun", parent=edge.parent, child=edge.child, first=seconds(edge.oldest))
