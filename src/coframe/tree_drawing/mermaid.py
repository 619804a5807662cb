"""A forest as Mermaid's flow chart, which code hosts draw inside Markdown."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from coframe.tree_drawing.labels import alarms, figures, shown, summary

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.tree_drawing.forest import Forest

__all__ = ["MOST_LINKS", "as_markdown", "as_mermaid"]

MOST_LINKS = 500
"""Mermaid draws no more, unless the page that holds it says otherwise."""
_STYLES = {
    "root": "fill:#fff6da,stroke:#9a6b00,color:#1a1a1a",
    "moving": "fill:#e8f1fd,stroke:#1d5fae,color:#1a1a1a",
    "static": "fill:#f1f3f5,stroke:#7b8794,color:#1a1a1a",
    "stale": "fill:#fdeceb,stroke:#b3261e,color:#1a1a1a",
}


def as_markdown(forest: Forest, title: str) -> str:
    """A page with the chart in a block of code."""
    return f"```mermaid\n{as_mermaid(forest, title)}```\n"


def as_mermaid(forest: Forest, title: str) -> str:
    """The chart alone."""
    head = ["---", f"title: {json.dumps(f'{shown(title)}: {summary(forest)}')}", "---", "flowchart LR"]
    return "\n".join([*head, *_trees(forest), *_arrows(forest), *_classes(), ""])


def _trees(forest: Forest) -> Iterator[str]:
    names = _ids(forest)
    for tree in forest.by_tree():
        yield f'  subgraph t{names[tree[0].name]}["tree of {_escaped(shown(tree[0].name))}"]'
        for frame in tree:
            label = "<br/>".join(map(_escaped, [shown(frame.name), *figures(frame), *alarms(frame)]))
            yield f'    {names[frame.name]}["{label}"]:::{frame.kind}'
        yield "  end"


def _arrows(forest: Forest) -> Iterator[str]:
    """Broken ones from second parents, and to where a loop closes."""
    names = _ids(forest)
    for frame in forest.frames.values():
        if frame.parent:
            yield f"  {names[frame.parent]} {'-.->' if frame.name in forest.loops else '-->'} {names[frame.name]}"
        for other in dict.fromkeys(link.parent for link in frame.other_edges):
            yield f"  {names[other]} -.-> {names[frame.name]}"


def _classes() -> Iterator[str]:
    for name, style in _STYLES.items():
        yield f"  classDef {name} {style}"


def _ids(forest: Forest) -> dict[str, str]:
    return {name: f"f{number}" for number, name in enumerate(forest.frames)}


def _escaped(text: str) -> str:
    """What is neither letter, digit nor harmless as Mermaid's code for it."""
    text = text.replace("\\", "\N{REVERSE SOLIDUS OPERATOR}")  # Mermaid ends a line at \\n, however it is written
    return "".join(c if c.isalnum() or c in " _/.,:" else f"#{ord(c)};" for c in text)
