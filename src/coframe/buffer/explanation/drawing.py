# SPDX-License-Identifier: Apache-2.0
"""An explanation as lines of text: the verdict, the chain with one line per frame, and advice."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe._output import html_tables
from coframe._output.escaping import display_name, one_line
from coframe._output.formatting import count, duration, seconds
from coframe.analysis.liveness import stale_limit, usual_gap

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from coframe.buffer.explanation._facts import ChainEdge, Explanation

__all__ = ["draw", "draw_html", "edge_remark", "verdict_text"]

_MAX_INDENTED_LEVELS = 20  # levels of indentation; more would leave no room for the columns
_LOOP_LINES = "\nFrame "  # after the first line of tf2's message about a loop, which lists all frames
_TITLES = ("  frame", "oldest", "newest", "age", "rate", "publisher")


class _Row(NamedTuple):
    cells: tuple[str, ...]
    remark: str


def draw(explanation: Explanation) -> Iterator[str]:
    """Yield the verdict, the chain, what to do, and the message of tf2."""
    yield verdict_text(explanation)
    yield from _table(explanation)
    yield from _advice(explanation)


def draw_html(explanation: Explanation) -> str:
    """Return the explanation as an HTML table for notebooks."""
    rows = [(*row.cells, row.remark) for row in _rows(explanation)] if explanation.edges else []
    titles = (*(title.strip() for title in _TITLES), "")
    return html_tables.section(
        verdict_text(explanation),
        html_tables.table(titles, rows, len(rows), "frame"),
        *(html_tables.paragraph(line) for line in _advice(explanation)),
    )


def _advice(explanation: Explanation) -> Iterator[str]:
    if explanation.possible_at is not None:
        other = f"at {seconds(explanation.possible_at)}" if explanation.possible_at else "at the latest time"
        yield f"the tree has changed: there is a transform {other}"
    if explanation.hint:
        yield f"do:  {one_line(explanation.hint)}"
    if explanation.text:
        yield f"tf2: {one_line(explanation.text.split(_LOOP_LINES)[0])}"


def verdict_text(explanation: Explanation) -> str:
    """Return a sentence that states whether the transform exists and, if not, which edge prevents it."""
    frames = f"from {display_name(explanation.source)} to {display_name(explanation.target)}"
    if explanation.answered is None:
        when = f" at {seconds(explanation.stamp)}" if explanation.stamp else ""
        return f"no: there is no transform {frames}{when}: {_reason(explanation)}"
    if explanation.stamp:
        return f"yes: there is a transform {frames} at {seconds(explanation.stamp)}"
    if not explanation.answered:
        return f"yes: there is a transform {frames} at any time"
    age = f", {duration(explanation.now - explanation.answered)} old" if explanation.now is not None else ""
    limit = (
        f", limited by {' -> '.join(map(display_name, explanation.limit))}"
        if explanation.limit and len(explanation.edges) > 1
        else ""
    )
    return f"yes: there is a transform {frames}, the latest at {seconds(explanation.answered)}{age}{limit}"


def edge_remark(explanation: Explanation, edge: ChainEdge) -> str:
    """Return what is wrong or unusual about an edge, and by how much, or "" if nothing is."""
    return _anomaly_text(explanation, edge) if edge.state == "ok" else _fault_text(explanation, edge)


def _fault_text(explanation: Explanation, edge: ChainEdge) -> str:
    by = duration(abs(edge.by))
    if edge.state == "too_new":
        due = (
            f"; the next transform is due {duration(edge.due)} after that time"
            if edge.due and edge.by < stale_limit(edge.period)
            else ""
        )
        return f"{by} behind the requested time{due}"
    if edge.state == "too_old":
        keeps = f"; the buffer keeps {duration(explanation.cache)}" if explanation.cache >= 0 else ""
        return f"first available {by} after the requested time{keeps}"
    if edge.state == "only_other":
        return f"available only at one time, {by} {'before' if edge.by > 0 else 'after'} the requested time"
    return "no longer available"


def _anomaly_text(explanation: Explanation, edge: ChainEdge) -> str:
    if edge.later:
        return f"the parent is now {display_name(edge.later)}"
    if edge.gap > usual_gap(edge.period):
        return f"in a gap of {duration(edge.gap)}"
    return f"stale: no transform for {duration(edge.age or 0)}" if explanation.stamp == 0 and edge.stale else ""


def _reason(explanation: Explanation) -> str:
    if explanation.code in _REASONS:
        return _REASONS[explanation.code]
    if explanation.unknown:
        frames = "frame" if len(explanation.unknown) == 1 else "frames"
        return f"no transform with the {frames} {' and '.join(map(_quote, explanation.unknown))} was received"
    reasons = []
    if explanation.broken:
        worst = max(explanation.broken, key=lambda edge: abs(edge.by))
        more = len(explanation.broken) - 1
        others = f"; {count(more, 'more edge')} {'has' if more == 1 else 'have'} no data for that time" if more else ""
        reasons.append(
            f"{display_name(worst.parent or '?')} -> {display_name(worst.child)} is "
            f"{edge_remark(explanation, worst)}{others}"
        )
    if explanation.roots is not None:
        reasons.append(
            f"{_quote(explanation.roots[0])} and {_quote(explanation.roots[1])} are roots of two trees "
            "that are not connected"
        )
    if explanation.missing is not None:
        edge = f"{display_name(explanation.missing.parent)} -> {display_name(explanation.missing.child)}"
        fault_text = f"a transform such as {edge} is missing"
        reasons.append(fault_text if explanation.missing[:2] == explanation.roots else explanation.missing.text)
    return "; ".join(reasons)


def _quote(name: str) -> str:
    return f"'{display_name(name)}'"


_REASONS = {
    "empty_name": "a frame name is empty",
    "leading_slash": "frame names must not begin with a slash",
    "loop": "the tree has a loop",
}


def _table(explanation: Explanation) -> list[str]:
    """Return the chain from the common frame, or from both roots, down to the two frames; one line per frame."""
    if not explanation.edges:
        return []
    rows = [_Row(_TITLES, ""), *_rows(explanation)]
    widths = [max(len(row.cells[column]) for row in rows) for column in range(len(_TITLES))]
    return [
        "  ".join([*(cell.ljust(width) for cell, width in zip(row.cells, widths, strict=True)), row.remark]).rstrip()
        for row in rows
    ]


def _rows(explanation: Explanation) -> Iterator[_Row]:
    edges = {edge.child: edge for edge in explanation.edges}
    for indent, frame in _tree(explanation, edges):
        role = {explanation.target: " (target)", explanation.source: " (source)"}.get(frame, "")
        edge = edges.get(frame)
        cells = ("",) * (len(_TITLES) - 1) if edge is None else _edge_cells(edge)
        yield _Row(
            (f"  {indent}{display_name(frame)}{role}", *cells), "" if edge is None else edge_remark(explanation, edge)
        )


def _edge_cells(edge: ChainEdge) -> tuple[str, ...]:
    if edge.static:
        return "static", "", "", "", display_name(edge.publisher)
    if edge.state == "no_data":
        return "", "", "", "", display_name(edge.publisher)
    age = duration(edge.age) if edge.age is not None and edge.age >= 0 else ""
    return seconds(edge.oldest), seconds(edge.newest), age, f"{edge.rate:.3g} Hz", display_name(edge.publisher)


def _tree(explanation: Explanation, edges: dict[str, ChainEdge]) -> Iterator[tuple[str, str]]:
    """Yield the frames in drawing order, each with the branch lines in front of its name."""
    frames = explanation.frames
    if explanation.roots is not None:
        cut = frames.index(explanation.roots[1])
        for root, *below in (frames[:cut][::-1], frames[cut:]):
            yield "", root
            yield from _branch_lines(below, last=True)
        return
    top = next((position for position, frame in enumerate(frames) if frame not in edges), 0)
    yield "", frames[top]
    yield from _branch_lines(frames[:top][::-1], last=top + 1 == len(frames))
    yield from _branch_lines(frames[top + 1 :], last=True)


def _branch_lines(frames: Sequence[str], *, last: bool) -> Iterator[tuple[str, str]]:
    first, further = ("└─ ", "   ") if last else ("├─ ", "│  ")
    for depth, frame in enumerate(frames):
        yield first if depth == 0 else f"{further}{'   ' * min(depth - 1, _MAX_INDENTED_LEVELS)}└─ ", frame
