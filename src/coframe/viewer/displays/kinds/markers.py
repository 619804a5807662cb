# SPDX-License-Identifier: Apache-2.0
"""Markers: a set that messages add to and remove from, drawn in groups that share a frame and a stamp."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypedDict

import numpy as np

from coframe.time import SECOND, stamp_ns
from coframe.transform.transform import Transform
from coframe.viewer.displays._drawing import (
    CannotDrawError,
    Drawing,
    Options,
    PoseRow,
    far_offset,
    finite,
    pose_row,
    rgba_of,
)
from coframe.viewer.displays._renderers import UnfinishedError
from coframe.viewer.displays._row import DisplayRow
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations
from coframe.viewer.protocol.encoding import encode_shapes

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from coframe.viewer.displays.resources import MeshUrl, Resources
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["MARKER", "MARKER_ARRAY", "MarkerItem", "MarkerSet", "MarkersShape", "marker_item"]

_WITH_POINTS = {4, 5, 6, 7, 8}  # lines, cubes, spheres and points, whose positions have no scale
_ADD, _DELETE, _DELETE_ALL = 0, 2, 3
MAX_MARKERS = 20_000
MAX_NUMBERS = 10_000_000
MAX_STAMPS = 250
"""More different stamps of the markers of one frame are rounded, because each of them needs its own transform."""
_ROUNDING_STEPS = 40  # halvings of the time by which stamps are rounded
# After a jump in time, all earlier messages determine the markers. They are read in steps of this many seconds.
_STEP = 0.2
# The markers after every n-th message are remembered for jumps back.
_SNAPSHOT_EVERY, MAX_SNAPSHOTS = 200, 100
_MIN_LARGE_MARKER = MAX_NUMBERS // MAX_MARKERS  # Markers that are not larger cannot exceed the limit together.


class MarkerItem(TypedDict):
    """A marker; ``mesh`` is the URL of its mesh, ``mesh_problem`` the reason why there is none."""

    ns: str
    id: int
    type: int
    pose: list[float | None]
    scale: list[float | None]
    rgba: list[float | None]
    text: str
    use_materials: bool
    mesh: str | None
    mesh_problem: str | None
    points: PayloadRows | None
    colors: PayloadRows | None


class MarkersShape(TypedDict):
    """Markers that share a frame and a stamp."""

    kind: Literal["markers"]
    frame: str
    stamp: float
    items: list[MarkerItem]


class _Group(NamedTuple):
    """The frame and the stamp of markers that are drawn together."""

    frame: str
    stamp: int
    locked: bool


class _Shown(NamedTuple):
    marker: Any
    group: _Group
    ends: int | None  # Nanoseconds on the timeline.


class MarkerSet:
    """The markers that are visible after a sequence of messages.

    Args:
        mesh_url: Returns the URL of a marker's mesh, or the reason why there is none.
    """

    def __init__(self, mesh_url: MeshUrl) -> None:
        self._mesh_url = mesh_url
        self._shown_markers: dict[tuple[str, int], _Shown] = {}
        self._drawings: dict[_Group, tuple[tuple[int, ...], Drawing]] = {}

    def snapshot(self) -> dict[tuple[str, int], _Shown]:
        """Return the current markers."""
        return dict(self._shown_markers)

    def restore(self, snapshot: Mapping[tuple[str, int], _Shown]) -> None:
        """Replace all markers by those of a snapshot."""
        self._shown_markers = dict(snapshot)

    def apply(self, message: Any, time: int) -> None:
        """Execute the actions of a Marker or MarkerArray received at a time in nanoseconds."""
        for marker in getattr(message, "markers", None) or ([message] if hasattr(message, "action") else []):
            key = (marker.ns, marker.id)
            if marker.action == _DELETE_ALL:
                self._shown_markers.clear()
            elif marker.action == _DELETE:
                self._shown_markers.pop(key, None)
            elif marker.action == _ADD:
                if key not in self._shown_markers and len(self._shown_markers) >= MAX_MARKERS:
                    self.expire(time)
                if key not in self._shown_markers and len(self._shown_markers) >= MAX_MARKERS:
                    raise CannotDrawError(f"too many markers: the viewer draws at most {MAX_MARKERS}")
                size = (
                    sum(_size(each.marker) for each in self._shown_markers.values())
                    if _size(marker) > _MIN_LARGE_MARKER
                    else 0
                )
                if size + _size(marker) > MAX_NUMBERS:
                    raise CannotDrawError(
                        f"the markers have more than {MAX_NUMBERS} numbers and characters, which is the viewer's limit"
                    )
                self._shown_markers[key] = _describe_shown(marker, time)

    def has_expired(self, time: int) -> bool:
        """Return whether the lifetime of a marker has ended."""
        return any(shown.ends is not None and shown.ends < time for shown in list(self._shown_markers.values()))

    def expire(self, time: int) -> None:
        """Remove markers whose lifetime has ended."""
        over = [key for key, shown in self._shown_markers.items() if shown.ends is not None and shown.ends < time]
        for key in over:
            del self._shown_markers[key]

    def draw(self, options: Options) -> list[Drawing]:
        """Return one drawing per group; unchanged groups return the same drawing as before."""
        groups: dict[_Group, list[Any]] = {}
        rounded = _rounded_groups({shown.group for shown in list(self._shown_markers.values())})
        for shown in self._shown_markers.values():
            groups.setdefault(rounded.get(shown.group, shown.group), []).append(shown.marker)
        drawn = {}
        for group, markers in groups.items():
            members = tuple(id(marker) for marker in markers)
            known = self._drawings.get(group)
            if known is not None and known[0] == members:
                drawn[group] = known
            else:
                drawn[group] = (members, self._draw_group(group, markers, options))
        self._drawings = drawn
        return [drawing for _, drawing in drawn.values()]

    def _draw_group(self, group: _Group, markers: list[Any], options: Options) -> Drawing:
        numbers: list[Any] = []
        size = 0
        items = []
        for marker in markers:
            points, pose = _near(marker)
            colors = [(color.r, color.g, color.b, color.a) for color in marker.colors]
            item, size = _item(marker, pose, points, colors, size)
            if size > MAX_NUMBERS:
                raise CannotDrawError(
                    f"the points and colors of the markers have more than {MAX_NUMBERS} numbers, "
                    "which is the viewer's limit"
                )
            numbers += [points.reshape(-1), np.array(colors, np.float64).reshape(-1)]
            if marker.mesh_resource:
                item["mesh"], item["mesh_problem"] = self._mesh_url(marker.mesh_resource)
            items.append(item)
        with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
            payload = np.concatenate(numbers).astype(np.float32) if numbers else np.zeros(0, np.float32)
        offset = far_offset(np.array([item["pose"][:3] for item in items], np.float64).reshape(-1, 3))
        for item in items:
            item["pose"][:3] = [None if v is None else v - o for v, o in zip(item["pose"], offset, strict=False)]
        stamp = group.stamp - options.origin
        description = MarkersShape(kind="markers", frame=group.frame, stamp=stamp, items=items)
        return Drawing(group.frame, group.stamp, encode_shapes(description, payload), group.locked, offset=offset)


class MarkerRenderer:
    """Maintains the set of markers that the messages define."""

    def __init__(self, messages: TopicMessages, options: Options, resources: Resources) -> None:
        self._messages = messages
        self._options = options
        self._set = MarkerSet(resources.mesh_url)
        self._applied = 0  # The key of the last message in the set.
        self._snapshots: list[tuple[int, dict[tuple[str, int], _Shown]]] = [(0, {})]
        self._snapshot_period = _SNAPSHOT_EVERY

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return one drawing per group of visible markers."""
        del at
        if message.key < self._applied:
            self._go_back(message.key)
        self._apply_until(message)
        self._set.expire(time)
        return self._set.draw(self._options)

    def has_changed(self, time: int, at: int) -> bool:
        """Return whether the lifetime of a marker has expired."""
        del at
        return self._set.has_expired(time)

    def _go_back(self, key: int) -> None:
        self._applied, markers = next(one for one in reversed(self._snapshots) if one[0] <= key)
        self._set.restore(markers)

    def _apply_until(self, message: StampedMessage) -> None:
        new = self._messages.after(self._applied, message.key) or [message]
        deadline = monotonic() + _STEP
        for count, one in enumerate(new):
            if count and monotonic() > deadline:
                raise UnfinishedError(f"reading earlier markers: {len(new) - count} messages left")
            self._set.apply(one.read(), one.time)
            self._applied = one.key
            if one.key >= self._snapshots[-1][0] + self._snapshot_period:
                self._take_snapshot(one)

    def _take_snapshot(self, message: StampedMessage) -> None:
        self._set.expire(message.time)
        self._snapshots.append((message.key, self._set.snapshot()))
        if len(self._snapshots) > MAX_SNAPSHOTS:
            del self._snapshots[1::2]
            self._snapshot_period *= 2


def _rounded_groups(groups: Iterable[_Group]) -> dict[_Group, _Group]:
    """Return the groups whose stamps are rounded up to a later one, because there are too many stamps in a frame.

    The stamps of a frame are divided into at most `MAX_STAMPS` intervals; the longest one is as short as possible.
    """
    frames: dict[tuple[str, bool], list[int]] = {}
    for group in groups:
        frames.setdefault((group.frame, group.locked), []).append(group.stamp)
    rounded = {}
    for (frame, locked), stamps in frames.items():
        if len(stamps) > MAX_STAMPS:
            ordered = np.sort(np.array(stamps, np.int64))
            ends = _interval_ends(ordered)
            chosen = ends[np.searchsorted(ends, ordered)]
            for own, stamp in zip(ordered.tolist(), chosen.tolist(), strict=True):
                rounded[_Group(frame, own, locked)] = _Group(frame, stamp, locked)
    return rounded


def _interval_ends(stamps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the last stamps of at most `MAX_STAMPS` intervals that contain all stamps, (N,) in order."""
    low, high = 0, int(stamps[-1] - stamps[0])
    ends = stamps[-1:]
    for _ in range(_ROUNDING_STEPS):
        if low >= high:
            break
        length = (low + high) // 2
        found: list[int] = []
        at = 0
        while at < len(stamps) and len(found) <= MAX_STAMPS:
            at = int(np.searchsorted(stamps, stamps[at] + length, side="right"))
            found.append(int(stamps[at - 1]))
        if len(found) <= MAX_STAMPS:
            high, ends = length, np.array(found, np.int64)
        else:
            low = length + 1
    return ends


def _describe_shown(marker: Any, time: int) -> _Shown:
    lifetime = marker.lifetime.sec * SECOND + marker.lifetime.nanosec
    locked = bool(marker.frame_locked)
    # A locked marker moves with its frame, so its stamp does not matter and must not split groups.
    group = _Group(marker.header.frame_id, 0 if locked else stamp_ns(marker.header.stamp), locked)
    return _Shown(marker, group, time + lifetime if lifetime > 0 else None)


def _near(marker: Any) -> tuple[NDArray[np.float64], PoseRow]:
    """Return a marker's points near its pose, (N, 3), and the pose: points far from it move it to their center."""
    points = np.array([(point.x, point.y, point.z) for point in marker.points], np.float64).reshape(-1, 3)
    pose = pose_row(marker.pose)
    offset = far_offset(points) if marker.type in _WITH_POINTS else (0.0, 0.0, 0.0)
    if not any(offset) or not np.isfinite(pose).all():
        return points, pose
    moved = Transform(pose[:3], pose[3:]).transform_point(offset)
    return points - offset, (*moved.tolist(), *pose[3:])


def _item(
    marker: Any, pose: PoseRow, points: Sequence[Any] | NDArray[np.float64], colors: Sequence[Any], offset: int
) -> tuple[MarkerItem, int]:
    """Return the description of a marker whose numbers begin at `offset`, and the end of its numbers."""
    colors_offset = offset + 3 * len(points)
    scale = marker.scale
    item = MarkerItem(
        ns=marker.ns,
        id=marker.id,
        type=marker.type,
        pose=[finite(value) for value in pose],
        scale=[finite(value) for value in (scale.x, scale.y, scale.z)],
        rgba=rgba_of(marker.color),
        text=marker.text,
        use_materials=bool(marker.mesh_use_embedded_materials),
        mesh=None,
        mesh_problem=None,
        points=(offset, len(points)) if len(points) else None,
        colors=(colors_offset, len(colors)) if colors else None,
    )
    return item, colors_offset + 4 * len(colors)


def marker_item(marker: Any, numbers: list[Any], mesh_url: MeshUrl) -> MarkerItem:
    """Return the description of a marker, and add its points and colors to the numbers of a drawing."""
    points, pose = _near(marker)
    colors = [(color.r, color.g, color.b, color.a) for color in marker.colors]
    item, _ = _item(marker, pose, points, colors, sum(len(part) for part in numbers))
    numbers += [points.reshape(-1), np.array(colors, np.float64).reshape(-1)]
    if marker.mesh_resource:
        item["mesh"], item["mesh_problem"] = mesh_url(marker.mesh_resource)
    return item


def _size(marker: Any) -> int:
    """Return the stored size of a marker in numbers and characters."""
    return 3 * len(marker.points) + 4 * len(marker.colors) + len(marker.text) + len(marker.ns)


MARKER = DisplayRow(
    name="Marker",
    messages={"visualization_msgs/msg/Marker": MarkerRenderer},
    shapes=(MarkersShape,),
    projected=True,
    guide="Marker with all types from ARROW to ARROW_STRIP; each namespace has a checkbox",
)
MARKER_ARRAY = DisplayRow(
    name="MarkerArray",
    messages={"visualization_msgs/msg/MarkerArray": MarkerRenderer},
    shapes=(MarkersShape,),
    projected=True,
    guide="MarkerArray, as Marker",
)
