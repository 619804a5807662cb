"""What there is to draw of a buffer: its trees, how fresh each frame is, and where all frames are at a time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import _core

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe import Buffer, FrameInfo

__all__ = ["FRESH", "GONE", "OTHER_TREE", "STALE", "LocalOrigin", "Placed", "Scene", "Structure"]

FRESH, STALE, GONE, OTHER_TREE = 0, 1, 2, 3

# A frame is stale when it was not heard of for so long, and for so many of its periods.
STALE_AFTER, STALE_PERIODS = 1.0, 5.0
_NS = 1_000_000_000
_NEVER = -1


class Structure(NamedTuple):
    """How frames hang together.

    Attributes:
        names: N frames, in the order of all else.
        parents: The index of each one's parent; -1 for roots.
        static: Whether each is valid for all time; also True for roots.
        components: The index of each one's tree.
        roots: The frame at the top of each tree; where a tree is a loop, one of its frames.
        order: Indices such that parents come before their children.
        largest: The root of the tree with the most frames; "" where there is none.
    """

    names: list[str]
    parents: list[int]
    static: list[bool]
    components: list[int]
    roots: list[str]
    order: list[int]
    largest: str

    def component_of(self, frame: str) -> int | None:
        """Which tree a frame is in; None if nobody knows it."""
        return self.components[self.names.index(frame)] if frame in self.names else None


class Placed(NamedTuple):
    """All frames at one time: poses (N, 7) float64 in the fixed frame, and states (N,) uint8."""

    poses: NDArray[np.float64]
    states: NDArray[np.uint8]


class Scene:
    """A buffer as the tabs see it; used by one thread.

    Args:
        buffer: What is shown.
        ages: Whether frames that are not heard of any more become stale and go, as it is with a live buffer.
    """

    def __init__(self, buffer: Buffer, *, ages: bool) -> None:
        self.buffer = buffer
        self.ages = ages
        self.revision = 0
        self.structure = Structure([], [], [], [], [], [], "")
        self.span: tuple[int, int] | None = None
        self.infos: list[FrameInfo] = []
        self._changes: int | None = None
        self._links: list[tuple[str, str, bool]] = []
        self._newest: NDArray[np.int64] = np.zeros(0, np.int64)
        self._heard: NDArray[np.float64] = np.zeros(0)  # of the monotonic clock
        self._periods: NDArray[np.float64] = np.zeros(0)
        self._roots: dict[str, list[str | None]] = {}

    def refresh(self) -> None:
        """Takes in what has changed; costs a look at each frame."""
        changes = self.buffer.changes
        if changes == self._changes:
            return
        self._changes = changes
        self.infos = self.buffer.frames()
        self._note_structure()
        dynamic = [info for info in self.infos if info.samples and not info.static]
        self.span = (min(info.oldest for info in dynamic), max(info.newest for info in dynamic)) if dynamic else None
        newest = np.array([info.newest for info in self.infos], np.int64)
        periods = np.array([1.0 / info.rate if info.rate > 0.0 else 0.0 for info in self.infos])
        heard = np.full(len(newest), time.monotonic())
        known = min(len(newest), len(self._newest))
        unchanged = newest[:known] == self._newest[:known]
        heard[:known][unchanged] = self._heard[:known][unchanged]
        self._newest, self._periods, self._heard = newest, periods, heard

    def ages_now(self) -> NDArray[np.float64]:
        """For how many seconds each frame was not heard of, (N,); 0 for those that need not be."""
        ages = time.monotonic() - self._heard
        ages[np.array(self.structure.static, bool)] = 0.0
        return ages

    def states_now(self, timeout: float) -> NDArray[np.uint8]:
        """Whether each frame is fresh, stale or gone, (N,): as old as the oldest link up to its root."""
        states = np.zeros(len(self.structure.names), np.uint8)
        if not self.ages:
            return states
        ages = self.ages_now()
        states[ages > np.maximum(STALE_AFTER, STALE_PERIODS * self._periods)] = STALE
        states[ages > timeout] = GONE
        if states.any():
            self._pass_on(states)
        return states

    def place(self, fixed: str, stamp: int, timeout: float) -> Placed:
        """Where all frames are.

        Args:
            fixed: The frame that they are told in; where it is not known, each is told in the root of its tree.
            stamp: Nanoseconds; 0 is now: the latest of each.
            timeout: So many seconds a frame is shown where it was last, as a stale one.
        """
        names = self.structure.names
        poses = np.empty((len(names), 7))
        told = np.empty(len(names), np.uint8)
        _core.poses_into(self.buffer, fixed, names, self._roots_beside(fixed), stamp, round(timeout * _NS), poses, told)
        if stamp == 0:
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

    def _roots_beside(self, fixed: str) -> list[str | None]:
        """For each frame None, or the root that it is seen from as it is not connected with the fixed frame."""
        roots = self._roots.get(fixed)
        if roots is None:
            structure = self.structure
            own = structure.component_of(fixed)
            roots = [None if tree == own else structure.roots[tree] for tree in structure.components]
            if len(self._roots) > 16:
                self._roots.clear()
            self._roots[fixed] = roots
        return roots

    def _note_structure(self) -> None:
        links = [(info.name, info.parent, info.static) for info in self.infos]
        if links != self._links:
            self._links = links
            self.structure = _structure_of(self.infos)
            self.revision += 1
            self._roots.clear()


def _structure_of(infos: list[FrameInfo]) -> Structure:
    index = {info.name: i for i, info in enumerate(infos)}
    parents = [index.get(info.parent, _NEVER) if info.parent else _NEVER for info in infos]
    static = [info.static or not info.parent for info in infos]
    children: list[list[int]] = [[] for _ in infos]
    for frame, parent in enumerate(parents):
        if parent >= 0:
            children[parent].append(frame)
    components = [_NEVER] * len(infos)
    roots: list[str] = []
    order: list[int] = []
    # Roots first; what is left then are loops, which begin anywhere.
    for start in (*(frame for frame, parent in enumerate(parents) if parent < 0), *range(len(infos))):
        if components[start] >= 0:
            continue
        components[start] = len(roots)
        waiting = [start]
        while waiting:
            frame = waiting.pop()
            order.append(frame)
            for child in children[frame]:
                if components[child] < 0:
                    components[child] = len(roots)
                    waiting.append(child)
        roots.append(infos[start].name)
    largest = roots[int(np.bincount(components).argmax())] if roots else ""
    return Structure([info.name for info in infos], parents, static, components, roots, order, largest)


class LocalOrigin:
    """What is subtracted from positions before they become float32, where metres far away would lose millimetres."""

    # Multiples of it are exact in float32 as far as any map reaches: what lies at zero stays exact, too.
    STEP = 64.0
    NEAR = 96.0

    def __init__(self) -> None:
        self.xyz: NDArray[np.float64] = np.zeros(3)

    def follow(self, placed: Placed, fixed: int | None) -> NDArray[np.float64]:
        """The origin for these poses: the same as before while most of them are near it."""
        shown = placed.states <= STALE
        if fixed is not None:
            shown[fixed] = False  # it lies at zero, wherever the others are
        positions = placed.poses[shown, :3]
        if len(positions) and not (np.abs(positions - self.xyz) <= self.NEAR).all():
            self._move_to(positions[np.isfinite(positions).all(axis=1)])
        return self.xyz

    def _move_to(self, positions: NDArray[np.float64]) -> None:
        """Stays, or goes to the fixed frame or to the middle: where it is near to the most."""
        if not len(positions):
            return
        middle = np.partition(positions, len(positions) // 2, axis=0)[len(positions) // 2]
        places = (self.xyz, np.zeros(3), np.round(middle / self.STEP) * self.STEP)
        self.xyz = max(places, key=lambda place: int((np.abs(positions - place) <= self.NEAR).all(axis=1).sum()))
