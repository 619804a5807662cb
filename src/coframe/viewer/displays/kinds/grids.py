# SPDX-License-Identifier: Apache-2.0
"""Occupancy grids, with the updates of parts of them."""

from __future__ import annotations

from collections import deque
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.time import SECOND, stamp_ns
from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options, far_offset, pose_row
from coframe.viewer.displays._renderers import UnfinishedError
from coframe.viewer.displays._row import ChoiceOption, DisplayRow, FlagOption, NumberOption, TextOption
from coframe.viewer.protocol.encoding import encode_grid, encode_grid_part

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.protocol.client_messages import DisplayOptions
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["MAP", "MapRenderer", "draw_grid"]

_MAX_FLOAT = float(np.finfo(np.float32).max)
# Earlier states of a grid are remembered for jumps back, at most one per second.
MAX_EARLIER_BYTES = 64 << 20
# Updates are applied in steps of this many seconds.
_STEP = 0.2


def draw_grid(grid: Any, options: Options) -> Drawing:
    """Draw an OccupancyGrid: -1 is unknown, 0 free, 100 occupied."""
    return _draw_cells(grid, _cells_of(grid), options)


def _cells_of(grid: Any) -> NDArray[np.int8]:
    """Return the cells of a grid, (height, width)."""
    info = grid.info
    cells = np.asarray(grid.data, dtype=np.int8)
    if cells.size != info.width * info.height:
        raise CannotDrawError(f"a grid of {info.width} x {info.height} cells has data for {cells.size} cells")
    return cells.reshape(info.height, info.width)


def _draw_cells(grid: Any, cells: NDArray[np.int8], options: Options) -> Drawing:
    info = grid.info
    corner = pose_row(info.origin)
    if not all(abs(number) <= _MAX_FLOAT for number in (info.resolution, *corner)):
        raise CannotDrawError("the resolution or the origin of the grid is not a finite 32-bit number")
    offset = far_offset(np.array([corner[:3]]))
    near = (*np.subtract(corner[:3], offset).tolist(), *corner[3:])
    data = encode_grid(float(info.resolution), near, cells)
    locked = not options.use_stamp
    return Drawing(grid.header.frame_id, stamp_ns(grid.header.stamp), data, locked, offset=offset)


class _State(NamedTuple):
    """The cells after an update."""

    key: int  # of the update
    time: int
    cells: NDArray[np.int8]


class MapRenderer:
    """Draws the newest grid with all updates since then. The page receives only the changed parts."""

    def __init__(self, _messages: TopicMessages, options: Options, resources: Resources) -> None:
        self._options = options
        self._other_topics = resources.others
        self._grid: Any = None
        self._grid_key: int | None = None
        self._grid_time = 0
        self._cells = np.zeros((0, 0), np.int8)
        self._applied = 0  # The key of the last update in the cells.
        self._drawing: Drawing | None = None
        self._earlier_states: deque[_State] = deque()

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the drawing of the grid."""
        del time
        if message.key != self._grid_key:
            self._start(message)
        newest = self._newest(at)
        if newest is not None and newest.key < self._applied:
            self._go_back(newest)
        elif newest is None and self._applied:
            self._start(message)
        if newest is not None:
            self._apply_until(newest)
        if self._drawing is None:
            self._drawing = _draw_cells(self._grid, self._cells, self._options)
        return [self._drawing]

    def has_changed(self, time: int, at: int) -> bool:
        """Return whether there are other updates."""
        del time
        newest = self._newest(at)
        return (0 if newest is None else newest.key) != self._applied

    @property
    def _updates(self) -> TopicMessages | None:
        return next(iter(self._other_topics.values()), None)

    def _newest(self, at: int) -> StampedMessage | None:
        """Return the last update of the current grid up to a time; 0 selects the newest one."""
        updates = self._updates
        found = None if updates is None else updates.at(at)
        return None if found is None or found.time < self._grid_time else found

    def _start(self, message: StampedMessage) -> None:
        """Show another grid without updates."""
        grid = message.read()
        self._cells = _cells_of(grid).copy()
        self._grid, self._grid_key, self._grid_time = grid, message.key, message.time
        self._applied, self._drawing = 0, None
        self._earlier_states.clear()

    def _go_back(self, newest: StampedMessage) -> None:
        """Restore the last known state that is not later than an update."""
        while self._earlier_states and self._earlier_states[-1].key > newest.key:
            self._earlier_states.pop()
        self._drawing = None
        if self._earlier_states:
            self._applied, self._cells = self._earlier_states[-1].key, self._earlier_states[-1].cells.copy()
        else:
            self._applied, self._cells = 0, _cells_of(self._grid).copy()

    def _apply_until(self, newest: StampedMessage) -> None:
        updates = self._updates
        if updates is None or newest.key == self._applied:
            return
        deadline = monotonic() + _STEP
        for update in updates.after(self._applied, newest.key):
            if update.time < self._grid_time:
                continue
            if monotonic() > deadline:
                raise UnfinishedError("reading earlier updates of the map")
            self._applied = update.key
            self._apply(update.read())
            self._remember(update)
        self._applied = newest.key

    def _apply(self, update: Any) -> None:
        x, y, width, height = update.x, update.y, update.width, update.height
        rows, columns = self._cells.shape
        data = np.asarray(update.data, np.int8)
        if x < 0 or y < 0 or x + width > columns or y + height > rows or data.size != width * height:
            raise CannotDrawError(
                f"an update of {width} x {height} cells at ({x}, {y}) with data for {data.size} cells does not fit "
                f"into the map of {columns} x {rows} cells"
            )
        part = data.reshape(height, width)
        self._cells[y : y + height, x : x + width] = part
        drawing = self._drawing
        if drawing is None or self._options.is_replay or not part.size:
            self._drawing = None if self._options.is_replay else drawing
        elif not drawing.data:  # The page has the grid, so that a part of it is enough.
            drawing.changes.append(encode_grid_part(x, y, part))
        else:
            self._drawing = None

    def _remember(self, update: StampedMessage) -> None:
        if self._earlier_states and update.time < self._earlier_states[-1].time + SECOND:
            return
        self._earlier_states.append(_State(update.key, update.time, self._cells.copy()))
        while len(self._earlier_states) * max(self._cells.size, 1) > MAX_EARLIER_BYTES:
            del self._earlier_states[len(self._earlier_states) // 2]


def _update_topic(topic: str, options: DisplayOptions) -> tuple[str, ...]:
    """Return the topic of a map's updates, whose name is that of the map with "_updates"."""
    return (options.second_topic or f"{topic}_updates",)


MAP = DisplayRow(
    name="Map",
    rank=2,
    max_automatic=3,
    messages={"nav_msgs/msg/OccupancyGrid": MapRenderer},
    options=(
        NumberOption("Alpha", 0.7, 0.0, 1.0, 0.05),
        ChoiceOption("Color Scheme", "map", ("map", "costmap", "raw")),
        FlagOption("Draw Behind", False),
        FlagOption("Use Timestamp", False, sets="use_stamp"),
        TextOption("Update Topic/Value", "", label="Update Topic", sets="second_topic"),
        FlagOption("Binary representation", False),
        NumberOption("Binary threshold", 100.0, -128.0, 127.0, 1.0, needs="Binary representation"),
    ),
    other_topics=_update_topic,
    guide="OccupancyGrid with the updates of parts of it (OccupancyGridUpdate), in RViz's three color schemes",
)
