# SPDX-License-Identifier: Apache-2.0
"""A forest in the DOT language of Graphviz."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.escaping import display_name
from coframe.tree_drawing.labels import edge_statistics, figures, position_problems, summary

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from coframe.doctor.statistics import EdgeStatistics
    from coframe.tree_drawing._forest import Forest, Frame

__all__ = ["as_graphviz"]

_MAX_LABEL_LENGTH = 200
_MAX_LISTED = 5


def as_graphviz(forest: Forest, title: str) -> str:
    """Return the file as text: one cluster per tree; edges from other parents and those that close a loop in red."""
    ids = {name: _id(number, name) for number, name in enumerate(forest.frames)}
    head = ["digraph frames {", "  rankdir=LR;", "  node [shape=box, fontname=Helvetica];"]
    head += [
        "  edge [fontname=Helvetica, fontsize=10];",
        f"  label={_quote_lines([display_name(title), summary(forest)])};",
    ]
    return "\n".join([*head, *_trees(forest, ids), *_edges(forest, ids), "}", ""])


def _trees(forest: Forest, ids: dict[str, str]) -> Iterator[str]:
    for number, tree in enumerate(forest.by_tree()):
        yield f"  subgraph cluster_{number} {{"
        yield f"    label={_quote_lines([f'tree of {display_name(tree[0].name)}'])};"
        for name in (frame.name for frame in tree):
            # Without a label Graphviz shows the name, in which it reads backslashes as escapes.
            is_label = display_name(name) == ids[name] and "\\" not in name
            label = "" if is_label else f" [label={_quote_lines([display_name(name)])}]"
            yield f"    {_quote_lines([ids[name]])}{label};"
        yield "  }"


def _edges(forest: Forest, ids: dict[str, str]) -> Iterator[str]:
    for frame in forest.frames.values():
        if frame.parent:
            style = _style(forest, frame)
            label = _quote_lines([*figures(frame), *position_problems(frame)])
            yield f"  {_quote_lines([ids[frame.parent]])} -> {_quote_lines([ids[frame.name]])} [label={label}{style}];"
        for parent, edges in _group_by_parent(frame.other_edges).items():
            lines = [line for edge in edges[:_MAX_LISTED] for line in edge_statistics(edge)]
            ends = f"{_quote_lines([ids[parent]])} -> {_quote_lines([ids[frame.name]])}"
            yield f"  {ends} [label={_quote_lines(lines)}, color=red, constraint=false];"


def _style(forest: Forest, frame: Frame) -> str:
    if frame.name in forest.loops:
        return ", color=red, constraint=false"
    if frame.silence is not None:
        return ", color=red, style=dashed"
    return ", style=dashed" if frame.static else ""


def _group_by_parent(edges: Iterable[EdgeStatistics]) -> dict[str, list[EdgeStatistics]]:
    found: dict[str, list[EdgeStatistics]] = {}
    for edge in edges:
        found.setdefault(edge.parent, []).append(edge)
    return found


def _id(number: int, name: str) -> str:
    """Return the name as identifier if it is short and printable; else a number."""
    is_plain = len(name) <= _MAX_LABEL_LENGTH and name.isprintable() and not name.startswith("#")
    return name if is_plain else f"#{number}"


def _quote_lines(lines: list[str]) -> str:
    return '"' + "\\n".join(line.replace("\\", "\\\\").replace('"', '\\"') for line in lines) + '"'
