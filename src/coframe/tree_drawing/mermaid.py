# SPDX-License-Identifier: Apache-2.0
"""A forest as a Mermaid flowchart, which code hosting sites draw inside Markdown."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from coframe._output.escaping import display_name
from coframe.tree_drawing.labels import figures, position_problems, summary

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.tree_drawing._forest import Forest

__all__ = ["MAX_EDGES", "as_markdown", "as_mermaid"]

MAX_EDGES = 500
"""The default limit of edges that Mermaid draws."""
_STYLES = {
    "root": "fill:#fff6da,stroke:#9a6b00,color:#1a1a1a",
    "moving": "fill:#e8f1fd,stroke:#1d5fae,color:#1a1a1a",
    "static": "fill:#f1f3f5,stroke:#7b8794,color:#1a1a1a",
    "stale": "fill:#fdeceb,stroke:#b3261e,color:#1a1a1a",
}


def as_markdown(forest: Forest, title: str) -> str:
    """Return a Markdown page with the flowchart in a code block."""
    return f"```mermaid\n{as_mermaid(forest, title)}```\n"


def as_mermaid(forest: Forest, title: str) -> str:
    """Return the flowchart alone."""
    head = ["---", f"title: {json.dumps(f'{display_name(title)}: {summary(forest)}')}", "---", "flowchart LR"]
    return "\n".join([*head, *_trees(forest), *_arrows(forest), *_classes(), ""])


def _trees(forest: Forest) -> Iterator[str]:
    names = _ids(forest)
    for tree in forest.by_tree():
        yield f'  subgraph t{names[tree[0].name]}["tree of {_escape(display_name(tree[0].name))}"]'
        for frame in tree:
            label = "<br/>".join(map(_escape, [display_name(frame.name), *figures(frame), *position_problems(frame)]))
            yield f'    {names[frame.name]}["{label}"]:::{frame.kind}'
        yield "  end"


def _arrows(forest: Forest) -> Iterator[str]:
    """Yield the arrows. Those from other parents and those that close a loop are dashed."""
    names = _ids(forest)
    for frame in forest.frames.values():
        if frame.parent:
            yield f"  {names[frame.parent]} {'-.->' if frame.name in forest.loops else '-->'} {names[frame.name]}"
        for other in dict.fromkeys(edge.parent for edge in frame.other_edges):
            yield f"  {names[other]} -.-> {names[frame.name]}"


def _classes() -> Iterator[str]:
    for name, style in _STYLES.items():
        yield f"  classDef {name} {style}"


def _ids(forest: Forest) -> dict[str, str]:
    return {name: f"f{number}" for number, name in enumerate(forest.frames)}


def _escape(text: str) -> str:
    """Return text with special characters replaced by Mermaid's codes."""
    text = text.replace("\\", "\N{REVERSE SOLIDUS OPERATOR}")  # Mermaid breaks lines at \\n, even if it is escaped
    return "".join(c if c.isalnum() or c in " _/.,:" else f"#{ord(c)};" for c in text)
