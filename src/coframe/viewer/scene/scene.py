"""What there is to draw of a buffer: its trees, how fresh each frame is, and where all frames are at a time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import _core
from coframe.analysis.liveness import LivenessTracker
from coframe.analysis.tree import FrameTrees

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe import Buffer, FrameInfo

__all__ = ["FRESH", "GONE", "OTHER_TREE", "STALE", "LocalOrigin", "Placed", "Scene", "Structure"]

FRESH, STALE, GONE, OTHER_TREE = 0, 1, 2, 3

_NS = 1_000_000_000


class Structure(NamedTuple):
    """How frames hang together.

    Attributes:
        names: N frames, in the order of all else.
        places: Where each one is in it.
        parents: The index of each one's parent; -1 for roots.
        static: Whether each is valid for all time; also True for roots.
        components: The index of each one's tree.
        roots: The frame at the top of each tree; where a tree is a loop, one of its frames.
        order: Indices such that parents come before their children.
        largest: The root of the tree with the most frames; "" where there is none.
    """

    names: list[str]
    places: dict[str, int]
    parents: list[int]
    static: list[bool]
    components: list[int]
    roots: list[str]
    order: list[int]
    largest: str

    def component_of(self, frame: str) -> int | None:
        """Which tree a frame is in; None if nobody knows it."""
        return self.components[self.places[frame]] if frame in self.places else None


class Placed(NamedTuple):
    """All frames at one time: poses (N, 7) float64 in the fixed frame, and states (N,) uint8."""

    poses: NDArray[np.float64]
    states: NDArray[np.uint8]


class Scene:
    """A buffer as the tabs see it; used by one thread.

    Args:
        buffer: What is shown.
        ages: Whether frames that are not heard of any more become stale and go, as it is with a live buffer.
        clock: Returns the monotonic time in nanoseconds.
    """

    def __init__(self, buffer: Buffer, *, ages: bool, clock: Callable[[], int] = time.monotonic_ns) -> None:
        self.buffer = buffer
        self.ages = ages
        self.revision = 0
        self.structure = Structure([], {}, [], [], [], [], [], "")
        self.span: tuple[int, int] | None = None
        self.infos: list[FrameInfo] = []
        self._changes: int | None = None
        self._links: list[tuple[str, str, bool]] = []
        self._liveness = LivenessTracker(buffer, clock)
        self._tables: dict[str, _core.PoseTable] = {}

    def refresh(self) -> None:
        """Takes in what has changed; costs a look at each frame."""
        changes = self.buffer._changes
        if changes == self._changes:
            return
        self._changes = changes
        self.infos = self.buffer.frames()
        self._note_structure()
        dynamic = [info for info in self.infos if info.samples and not info.static]
        self.span = (min(info.oldest for info in dynamic), max(info.newest for info in dynamic)) if dynamic else None
        self._liveness.update(self.infos)

    def ages_now(self) -> NDArray[np.float64]:
        """For how many seconds each frame was not heard of, (N,); 0 for those that need not be."""
        return self._liveness.silences() / _NS

    def states_now(self, timeout: float) -> NDArray[np.uint8]:
        """Whether each frame is fresh, stale or gone, (N,): as old as the oldest link up to its root."""
        states = np.zeros(len(self.structure.names), np.uint8)
        # Most of the time no frame is stale, which costs one comparison.
        if self.ages and self._liveness.any_stale():
            stale = self._liveness.stale()
            states[stale] = STALE
            states[stale & (self.ages_now() > timeout)] = GONE
            self._pass_on(states)
        return states

    def place(self, fixed: str, stamp: int, timeout: float) -> Placed:
        """Where all frames are.

        Args:
            fixed: The frame that they are told in; where it is not known, each is told in the root of its tree.
            stamp: Nanoseconds; 0 is now: the latest of each.
            timeout: So many seconds a frame is shown where it was last, as a stale one.
        """
        count = len(self.structure.names)
        poses = np.empty((count, 7))
        told = np.empty(count, np.uint8)
        self._table_of(fixed).look_up(stamp, round(timeout * _NS), poses, told)
        if stamp == 0 and self.ages and self._liveness.any_stale():
            connected = told == FRESH
            told[connected] = self.states_now(timeout)[connected]
        return Placed(poses, told)

    def _pass_on(self, states: NDArray[np.uint8]) -> None:
        parents = self.structure.parents
        worst = states.tolist()
        for frame in self.structure.order:
            parent = parents[frame]
            if parent >= 0 and worst[parent] > worst[frame]:
                worst[frame] = worst[parent]
        states[:] = worst

    def _table_of(self, fixed: str) -> _core.PoseTable:
        """All frames, seen from the fixed one; from the root of their tree where that is not connected with it."""
        table = self._tables.get(fixed)
        if table is None:
            structure = self.structure
            own = structure.component_of(fixed)
            roots = [None if tree == own else structure.roots[tree] for tree in structure.components]
            if len(self._tables) > 16:
                self._tables.clear()
            table = self._tables[fixed] = _core.PoseTable(self.buffer, fixed, structure.names, roots)
        return table

    def _note_structure(self) -> None:
        links = [(info.name, info.parent, info.static) for info in self.infos]
        if links != self._links:
            self._links = links
            self.structure = _structure_of(self.infos)
            self.revision += 1
            self._tables.clear()


def _structure_of(infos: list[FrameInfo]) -> Structure:
    trees = FrameTrees.from_parents({info.name: info.parent for info in infos})
    static = [info.static or not info.parent for info in infos]
    roots = [trees.names[root] for root in trees.roots]
    largest = roots[int(np.bincount(trees.components).argmax())] if roots else ""
    return Structure(
        list(trees.names), trees.index, trees.parents, static, trees.components, roots, trees.order, largest
    )


class LocalOrigin:
    """What is subtracted from positions before they become float32, where metres far away would lose millimetres."""

    # Multiples of it are exact in float32 as far as any map reaches: what lies at zero stays exact, too.
    STEP = 64.0
    NEAR = 96.0
    # How often, in seconds, a better one is looked for where some frames are far from each that there may be.
    PERIOD = 1.0

    def __init__(self) -> None:
        self.xyz: NDArray[np.float64] = np.zeros(3)
        self._far = 0
        self._due = 0.0

    def bring_near(self, placed: Placed, fixed: int | None) -> NDArray[np.float32]:
        """The poses as float32, (N, 7), relative to the origin: the same as before while most of them are near it."""
        near = np.empty((len(placed.states), 7), np.float32)
        far = self._near_into(placed, fixed, near)
        if far > self._far or (far and time.monotonic() >= self._due):
            self._due = time.monotonic() + self.PERIOD
            self.follow(placed, fixed)
            far = self._near_into(placed, fixed, near)
        self._far = far
        return near

    def follow(self, placed: Placed, fixed: int | None) -> NDArray[np.float64]:
        """The origin for these poses: the same as before while most of them are near it."""
        shown = placed.states <= STALE
        if fixed is not None:
            shown[fixed] = False  # it lies at zero, wherever the others are
        positions = placed.poses[shown, :3]
        if len(positions) and not (np.abs(positions - self.xyz) <= self.NEAR).all():
            self._move_to(positions[np.isfinite(positions).all(axis=1)])
        return self.xyz

    def _near_into(self, placed: Placed, fixed: int | None, near: NDArray[np.float32]) -> int:
        """How many are far from the origin."""
        index = -1 if fixed is None else fixed
        return _core.poses_near(placed.poses, placed.states, self.xyz, index, self.NEAR, near)

    def _move_to(self, positions: NDArray[np.float64]) -> None:
        """Stays, or goes to the fixed frame or to the middle: where it is near to the most."""
        if not len(positions):
            return
        middle = np.partition(positions, len(positions) // 2, axis=0)[len(positions) // 2]
        places = (self.xyz, np.zeros(3), np.round(middle / self.STEP) * self.STEP)
        self.xyz = max(places, key=lambda place: int((np.abs(positions - place) <= self.NEAR).all(axis=1).sum()))
