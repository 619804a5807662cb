# SPDX-License-Identifier: Apache-2.0
"""The structure of frame trees: roots, children, order, depths, loops, paths and chains."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

__all__ = ["FrameTrees"]

_NO_PARENT = -1


@dataclass(frozen=True, eq=False)
class FrameTrees:
    """The trees that frames form by their parents.

    Frames are numbered from 0 to N - 1. Where frames form a loop, the loop and the frames below it count as one tree,
    whose root is the frame of the loop with the alphabetically first name.

    Attributes:
        names: The N frames, in the order in which they were given.
        index: The number of each frame, by name.
        parents: The number of the parent of each frame, or -1 for a frame without one.
        children: The numbers of the children of each frame, in ascending order.
        order: The numbers of all frames, tree after tree and depth first: parents come before their children.
        depths: The number of edges from each frame up to the root of its tree.
        components: The number of the tree of each frame.
        roots: The number of the root of each tree. Trees with a root that has no parent come first.
        loops: The numbers of the trees that have a loop.
    """

    names: tuple[str, ...]
    index: dict[str, int]
    parents: list[int]
    children: list[list[int]]
    order: list[int]
    depths: list[int]
    components: list[int]
    roots: list[int]
    loops: frozenset[int]

    @classmethod
    def from_parents(cls, parents: Mapping[str, str], frames: Iterable[str] = ()) -> FrameTrees:
        """Return the trees of the given frames; takes linear time.

        Args:
            parents: The parent of each frame, or "" for a frame without one.
            frames: The names of frames in the order of their numbers; frames that only `parents` contains follow
                them.

        Example:
            >>> trees = FrameTrees.from_parents({"base": "odom", "lidar": "base", "camera": "base"})
            >>> trees.path("lidar"), trees.chain("camera", "lidar")
            (['lidar', 'base', 'odom'], ['camera', 'base', 'lidar'])
        """
        names = tuple(dict.fromkeys([*frames, *parents, *(parent for parent in parents.values() if parent)]))
        index = {name: number for number, name in enumerate(names)}
        above = [index[parent] if (parent := parents.get(name, "")) else _NO_PARENT for name in names]
        children: list[list[int]] = [[] for _ in names]
        for number, parent_number in enumerate(above):
            if parent_number != _NO_PARENT:
                children[parent_number].append(number)
        components = [_NO_PARENT] * len(names)
        depths = [0] * len(names)
        order: list[int] = []
        roots: list[int] = []
        for number, parent_number in enumerate(above):
            if parent_number == _NO_PARENT:
                _add_tree(number, len(roots), children, components, depths, order)
                roots.append(number)
        proper = len(roots)
        for number in range(len(names)):
            if components[number] == _NO_PARENT:
                root = _first_of_loop(number, above, names)
                _add_tree(root, len(roots), children, components, depths, order)
                roots.append(root)
        return cls(
            names, index, above, children, order, depths, components, roots, frozenset(range(proper, len(roots)))
        )

    @cached_property
    def members(self) -> tuple[tuple[str, ...], ...]:
        """The names of the frames of each tree, in the order of :attr:`names`."""
        found: list[list[str]] = [[] for _ in self.roots]
        for name, component in zip(self.names, self.components, strict=True):
            found[component].append(name)
        return tuple(map(tuple, found))

    def component(self, frame: str) -> int | None:
        """Return the number of the tree of a frame, or None if the frame does not exist."""
        number = self.index.get(frame)
        return None if number is None else self.components[number]

    def root(self, frame: str) -> str:
        """Return the root of the tree of a frame, or the frame itself if it is unknown."""
        number = self.index.get(frame)
        return frame if number is None else self.names[self.roots[self.components[number]]]

    def tree(self, frame: str) -> list[str]:
        """Return the frames in the tree of a frame: the root, then the others by name.

        Example:
            >>> FrameTrees.from_parents({"lidar": "base", "base": "odom", "odom": "", "map": ""}).tree("base")
            ['odom', 'base', 'lidar']
        """
        component = self.component(frame)
        if component is None:
            return [frame]
        root = self.root(frame)
        return [root, *sorted(name for name in self.members[component] if name != root)]

    def path(self, frame: str) -> list[str]:
        """Return the frames from a frame up to its root, both included; every frame of a loop once."""
        if frame not in self.index:
            return [frame]
        return [self.names[number] for number in self._path(self.index[frame])]

    def chain(self, target: str, source: str) -> list[str] | None:
        """Return the frames from target up to the common ancestor and down to source, or None if there is no path."""
        if self.component(target) is None or self.component(target) != self.component(source):
            return [target] if target == source else None
        up, down = self._path(self.index[target]), self._path(self.index[source])
        below = {frame: place for place, frame in enumerate(down)}
        top = next((place for place, frame in enumerate(up) if frame in below), None)
        if top is None:  # frames below the same loop always have a common ancestor
            return None
        return [self.names[number] for number in (*up[: top + 1], *reversed(down[: below[up[top]]]))]

    def _path(self, frame: int) -> list[int]:
        visited: dict[int, None] = {}
        while frame != _NO_PARENT and frame not in visited:
            visited[frame] = None
            frame = self.parents[frame]
        return list(visited)


def _add_tree(
    root: int, number: int, children: list[list[int]], components: list[int], depths: list[int], order: list[int]
) -> None:
    """Store the number, depths and order of the frames of one tree, depth first."""
    components[root] = number
    pending = [root]
    while pending:
        frame = pending.pop()
        order.append(frame)
        below = depths[frame] + 1
        for child in reversed(children[frame]):
            if child != root:  # the children lead back to the root in a loop
                components[child] = number
                depths[child] = below
                pending.append(child)


def _first_of_loop(frame: int, parents: list[int], names: tuple[str, ...]) -> int:
    """Return the alphabetically first frame of the loop above a frame."""
    visited: dict[int, None] = {}
    while frame not in visited:
        visited[frame] = None
        frame = parents[frame]
    above = list(visited)
    return min(above[above.index(frame) :], key=lambda number: names[number])
