# SPDX-License-Identifier: Apache-2.0
"""Build the forest of frames from an observation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.analysis.tree import FrameTrees
from coframe.doctor.statistics import edge_statistics
from coframe.doctor.wrong_stamps import wrong_offset
from coframe.tree_drawing._forest import Forest, Frame

if TYPE_CHECKING:
    from coframe.doctor import Observation
    from coframe.doctor.statistics import EdgeStatistics

__all__ = ["build_forest"]


def build_forest(observation: Observation) -> Forest:
    """Return the trees in a buffer at the end of the observation."""
    parents = {child: edge.parent for child, edge in observation.last.items()}
    # Children are drawn in alphabetical order.
    trees = FrameTrees.from_parents(parents, sorted(observation.frames))
    figures: dict[str, list[EdgeStatistics]] = {}
    for edge in edge_statistics(observation):
        figures.setdefault(edge.child, []).append(edge)
    by_tree: list[list[int]] = [[] for _ in trees.roots]
    for number in trees.order:
        by_tree[trees.components[number]].append(number)
    by_tree.sort(key=lambda tree: (-len(tree), trees.names[tree[0]]))
    frames = {
        trees.names[number]: _frame(number, trees, figures.get(trees.names[number], []), observation)
        for tree in by_tree
        for number in tree
    }
    counts = {trees.names[tree[0]]: len(tree) for tree in by_tree}
    loops = frozenset(trees.names[trees.roots[tree]] for tree in trees.loops)
    return Forest(observation.start, observation.end, observation.live, frames, counts, loops)


def _frame(number: int, trees: FrameTrees, figures: list[EdgeStatistics], observation: Observation) -> Frame:
    name, root = trees.names[number], trees.roots[trees.components[number]]
    edge = observation.last.get(name)
    parent = "" if edge is None else edge.parent
    return Frame(
        name=name,
        parent=parent,
        root=trees.names[root],
        depth=trees.depths[number],
        # In a loop, the root is also the child of another frame.
        children=tuple(trees.names[child] for child in trees.children[number] if child != root),
        edges=tuple(figure for figure in figures if figure.parent == parent),
        other_edges=tuple(figure for figure in figures if figure.parent != parent),
        silence=observation.silence(edge) if edge is not None and observation.is_stale(edge) else None,
        offset=None if edge is None else wrong_offset(observation, edge),
    )
