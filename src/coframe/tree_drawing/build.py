"""From an observation to the forest of its frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor.figures import edge_figures
from coframe.tree_drawing.forest import Forest, Frame

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.doctor import Observation
    from coframe.doctor.edge import Edge
    from coframe.doctor.figures import EdgeFigures

__all__ = ["grow"]

_SILENT = 1_000_000_000
_UNUSUAL = 3.0  # times the usual time between two transforms of a link


def grow(observation: Observation) -> Forest:
    """The trees as a buffer would hold them at the end of the observation."""
    parents = {child: edge.parent for child, edge in observation.last.items()}
    children: dict[str, list[str]] = {}
    for child in sorted(parents, reverse=True):
        children.setdefault(parents[child], []).append(child)
    roots = [frame for frame in observation.frames if frame not in parents]
    trees = {root: _below(root, children) for root in roots}
    drawn = {frame for tree in trees.values() for frame in tree}
    loops = []
    for frame in sorted(parents):
        if frame not in drawn:
            root = _in_loop(frame, parents)
            loops.append(root)
            trees[root] = _below(root, children)
            drawn.update(trees[root])
    told: dict[str, list[EdgeFigures]] = {}
    for link in edge_figures(observation):
        told.setdefault(link.child, []).append(link)
    ordered = {root: trees[root] for root in sorted(trees, key=lambda root: (-len(trees[root]), root))}
    frames = {
        name: _frame(
            name, root, depth, parents.get(name, ""), children.get(name, ()), trees, told.get(name, []), observation
        )
        for root, tree in ordered.items()
        for name, depth in tree.items()
    }
    counts = {root: len(tree) for root, tree in ordered.items()}
    return Forest(observation.start, observation.end, observation.live, frames, counts, frozenset(loops))


def _below(root: str, children: dict[str, list[str]]) -> dict[str, int]:
    """A tree's frames in the order of drawing, and how deep each is; a loop is walked once."""
    depths: dict[str, int] = {}
    waiting = [(root, 0)]
    while waiting:
        frame, depth = waiting.pop()
        if frame not in depths:
            depths[frame] = depth
            waiting += [(child, depth + 1) for child in children.get(frame, ())]
    return depths


def _in_loop(frame: str, parents: dict[str, str]) -> str:
    """The first name of the loop above a frame that has no root."""
    above = set()
    while frame not in above:
        above.add(frame)
        frame = parents[frame]
    loop = [frame]
    while parents[loop[-1]] != frame:
        loop.append(parents[loop[-1]])
    return min(loop)


def _frame(
    name: str,
    root: str,
    depth: int,
    parent: str,
    children: Iterable[str],
    trees: dict[str, dict[str, int]],
    told: list[EdgeFigures],
    seen: Observation,
) -> Frame:
    edge = seen.last.get(name)
    return Frame(
        name=name,
        parent=parent,
        root=root,
        depth=depth,
        # In a loop the root is below itself.
        children=tuple(sorted(child for child in children if child not in trees)),
        links=tuple(link for link in told if link.parent == parent),
        others=tuple(link for link in told if link.parent != parent),
        silence=None if edge is None else _silence(edge, seen.end),
    )


def _silence(edge: Edge, end: int) -> int | None:
    """How long it was not heard of, where that is longer than usual."""
    silence = end - int(edge.arrived[-1])
    usual = int(edge.arrived[-1] - edge.arrived[0]) / max(edge.count - 1, 1)
    return silence if not edge.static and silence > max(_SILENT, _UNUSUAL * usual) else None
