# SPDX-License-Identifier: Apache-2.0
"""The scene of a buffer: its trees, the liveness of each frame, and the poses of all frames at a time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import _core
from coframe.analysis.liveness import LivenessTracker
from coframe.analysis.tree import FrameTrees
from coframe.time import SECOND
from coframe.viewer.protocol.binary_messages import FrameState

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe.buffer.buffer import Buffer
    from coframe.buffer.edge_info import FrameInfo

__all__ = ["LocalOrigin", "PlacedFrames", "Scene", "SceneStructure"]


class SceneStructure(NamedTuple):
    """The trees of the frames.

    Attributes:
        names: The N frames, in the order of the other attributes.
        indices: The index of each frame by its name.
        parents: The index of each frame's parent, or -1 for roots.
        static: Whether each frame is static; also True for roots.
        components: The index of each frame's tree.
        roots: The root of each tree; if the tree is a loop, one of its frames.
        order: Indices such that parents precede their children.
        largest: The root of the tree with the most frames, or "" if there are no frames.
    """

    names: list[str]
    indices: dict[str, int]
    parents: list[int]
    static: list[bool]
    components: list[int]
    roots: list[str]
    order: list[int]
    largest: str

    def component_of(self, frame: str) -> int | None:
        """Return the index of a frame's tree, or None if the frame does not exist."""
        return self.components[self.indices[frame]] if frame in self.indices else None


class PlacedFrames(NamedTuple):
    """All frames at one time: poses, (N, 7) float64, in the fixed frame, and `FrameState` values, (N,) uint8."""

    poses: NDArray[np.float64]
    states: NDArray[np.uint8]


class Scene:
    """The frames of a buffer; used by one thread.

    Args:
        buffer: The buffer whose frames are shown.
        ages: Whether frames become stale when their publisher stops, as in a live buffer.
        clock: Return the time in nanoseconds by which frames become stale, for example the monotonic time.
    """

    def __init__(self, buffer: Buffer, *, ages: bool, clock: Callable[[], int] = time.monotonic_ns) -> None:
        self.buffer = buffer
        self.ages = ages
        self.revision = 0
        self.structure = SceneStructure([], {}, [], [], [], [], [], "")
        self.span: tuple[int, int] | None = None
        self.infos: list[FrameInfo] = []
        self._changes: int | None = None
        self._edges: list[tuple[str, str, bool]] = []
        self._clock = clock
        self._liveness = LivenessTracker(buffer, clock)
        self._tables: dict[str, _core.PoseTable] = {}

    def refresh(self) -> None:
        """Update from the buffer. The cost is proportional to the number of frames."""
        changes = self.buffer._changes
        if changes == self._changes:
            return
        self._changes = changes
        self.infos = _connected_infos(self.buffer.frames())
        self._update_structure()
        dynamic = [info for info in self.infos if info.samples and not info.static]
        self.span = (min(info.oldest for info in dynamic), max(info.newest for info in dynamic)) if dynamic else None
        self._liveness.update(self.infos)

    def restart(self) -> None:
        """Forget what was known about the frames, after the buffer was cleared."""
        self._changes = None
        self._liveness = LivenessTracker(self.buffer, self._clock)
        self.refresh()

    def newest(self, frame: str) -> int:
        """Return the newest stamp of a frame in nanoseconds, or 0 if it is static or has no samples."""
        index = self.structure.indices.get(frame)
        info = None if index is None else self.infos[index]
        return info.newest if info is not None and info.samples and not info.static else 0

    def silence(self) -> float | None:
        """Return how many seconds ago the last sample of any frame arrived; None if all frames are static."""
        if self.span is None:
            return None
        moves = np.array([bool(info.parent) and not info.static for info in self.infos], bool)
        return float(self._liveness.silences()[moves].min()) / SECOND if moves.any() else None

    def ages_now(self) -> NDArray[np.float64]:
        """Return how many seconds ago each frame's last sample arrived, (N,), or 0 for static frames."""
        return self._liveness.silences() / SECOND

    def states_now(self, timeout: float) -> NDArray[np.uint8]:
        """Return the `FrameState` of each frame now, (N,): the worst state of all edges up to its root."""
        states = np.zeros(len(self.structure.names), np.uint8)
        # Most of the time no frame is stale, which costs one comparison.
        if self.ages and self._liveness.any_stale():
            stale = self._liveness.stale()
            states[stale] = FrameState.STALE
            states[stale & (self.ages_now() > timeout)] = FrameState.GONE
            self._inherit(states)
        return states

    def place(self, fixed: str, stamp: int, timeout: float) -> PlacedFrames:
        """Return the poses and states of all frames.

        Args:
            fixed: The frame in which the poses are expressed; frames that are not connected with it are expressed in
                the root of their own tree.
            stamp: The time in nanoseconds; 0 selects the latest pose of each frame.
            timeout: The number of seconds after its last sample for which a frame is shown at its last pose, as a stale
            frame.
        """
        count = len(self.structure.names)
        poses = np.empty((count, 7))
        states = np.empty(count, np.uint8)
        self._table_of(fixed).look_up(stamp, round(timeout * SECOND), poses, states)
        if stamp == 0 and self.ages and self._liveness.any_stale():
            connected = states == FrameState.OK
            states[connected] = self.states_now(timeout)[connected]
        return PlacedFrames(poses, states)

    def _inherit(self, states: NDArray[np.uint8]) -> None:
        """Set each state to the worst one up to the frame's root."""
        parents = self.structure.parents
        worst = states.tolist()
        for frame in self.structure.order:
            parent = parents[frame]
            if parent >= 0 and worst[parent] > worst[frame]:
                worst[frame] = worst[parent]
        states[:] = worst

    def _table_of(self, fixed: str) -> _core.PoseTable:
        """Return a table that looks up all frames relative to the fixed frame or the root of their own tree."""
        table = self._tables.get(fixed)
        if table is None:
            structure = self.structure
            own = structure.component_of(fixed)
            roots = [None if tree == own else structure.roots[tree] for tree in structure.components]
            if len(self._tables) > 16:
                self._tables.clear()
            table = self._tables[fixed] = _core.PoseTable(self.buffer, fixed, structure.names, roots)
        return table

    def _update_structure(self) -> None:
        edges = [(info.name, info.parent, info.static) for info in self.infos]
        if edges != self._edges:
            self._edges = edges
            self.structure = _structure_of(self.infos)
            self.revision += 1
            self._tables.clear()


def _connected_infos(infos: list[FrameInfo]) -> list[FrameInfo]:
    """Return the frames that have samples or are the parent of one that has."""
    if all(info.samples or info.static for info in infos):
        return infos
    parents = {info.parent for info in infos if info.samples or info.static}
    return [info for info in infos if info.samples or info.static or info.name in parents]


def _structure_of(infos: list[FrameInfo]) -> SceneStructure:
    trees = FrameTrees.from_parents({info.name: info.parent for info in infos})
    static = [info.static or not info.parent for info in infos]
    roots = [trees.names[root] for root in trees.roots]
    largest = roots[int(np.bincount(trees.components).argmax())] if roots else ""
    return SceneStructure(
        list(trees.names), trees.index, trees.parents, static, trees.components, roots, trees.order, largest
    )


class LocalOrigin:
    """The point relative to which positions are sent as float32, which would lose millimeters far from the origin."""

    # Multiples of this step are exact in float32 within any map, so that positions of zero also stay exact.
    STEP = 64.0
    # Positions within this distance, in meters, are near.
    NEAR = 96.0
    # Seconds between searches for a better origin while some frames are far from all candidates.
    PERIOD = 1.0

    def __init__(self) -> None:
        self.xyz: NDArray[np.float64] = np.zeros(3)
        self._far_count = 0
        self._due = 0.0

    def localize(self, placed: PlacedFrames, fixed: int | None) -> NDArray[np.float32]:
        """Return the poses relative to the origin, (N, 7), and move the origin if too many frames are far from it.

        Args:
            placed: All frames.
            fixed: The index of the fixed frame, or None if it does not exist.
        """
        local = np.empty((len(placed.states), 7), np.float32)
        far_count = self._localize_into(placed, fixed, local)
        if far_count > self._far_count or (far_count and time.monotonic() >= self._due):
            self._due = time.monotonic() + self.PERIOD
            self.follow(placed, fixed)
            far_count = self._localize_into(placed, fixed, local)
        self._far_count = far_count
        return local

    def follow(self, placed: PlacedFrames, fixed: int | None) -> NDArray[np.float64]:
        """Return an origin for these poses. It is unchanged while most of them are near it."""
        shown = placed.states <= FrameState.STALE
        if fixed is not None:
            shown[fixed] = False  # The fixed frame is always at zero.
        positions = placed.poses[shown, :3]
        if len(positions) and not (np.abs(positions - self.xyz) <= self.NEAR).all():
            self._move_to(positions[np.isfinite(positions).all(axis=1)])
        return self.xyz

    def _localize_into(self, placed: PlacedFrames, fixed: int | None, local: NDArray[np.float32]) -> int:
        """Write the local poses and return how many are far from the origin."""
        index = -1 if fixed is None else fixed
        return _core.poses_near(placed.poses, placed.states, self.xyz, index, self.NEAR, local)

    def _move_to(self, positions: NDArray[np.float64]) -> None:
        """Keep the origin, or move it to the fixed frame or the median position: whichever has most frames near it."""
        if not len(positions):
            return
        median = np.partition(positions, len(positions) // 2, axis=0)[len(positions) // 2]
        candidates = (self.xyz, np.zeros(3), np.round(median / self.STEP) * self.STEP)

        def near_count(xyz: NDArray[np.float64]) -> int:
            return int((np.abs(positions - xyz) <= self.NEAR).all(axis=1).sum())

        self.xyz = max(candidates, key=near_count)
