"""Markers: a set that messages add to and take from, drawn in groups of one frame and one time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays.drawing import CannotDrawError, Drawing, Options, finite, pose_row, rgba_of
from coframe.viewer.protocol import binary

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["MarkerSet"]

_ADD, _DELETE, _DELETE_ALL = 0, 2, 3
MOST_MARKERS = 20_000
MOST_NUMBERS = 10_000_000


class _Group(NamedTuple):
    """Where markers are told, and when."""

    frame: str
    stamp: int
    locked: bool


class _Shown(NamedTuple):
    marker: Any
    group: _Group
    ends: int | None  # nanoseconds of the timeline


class MarkerSet:
    """The markers that are to be seen after some messages.

    Args:
        mesh_url: The address of a mesh that a marker names, or why there is none.
    """

    def __init__(self, mesh_url: Callable[[str], tuple[str | None, str | None]]) -> None:
        self._mesh_url = mesh_url
        self._shown: dict[tuple[str, int], _Shown] = {}
        self._drawn: dict[_Group, tuple[tuple[int, ...], Drawing]] = {}

    def clear(self) -> None:
        """Forgets all of them."""
        self._shown.clear()

    def take(self, message: Any, time: int) -> None:
        """Does what a Marker or MarkerArray says that came at a time."""
        for marker in getattr(message, "markers", None) or ([message] if hasattr(message, "action") else []):
            key = (marker.ns, marker.id)
            if marker.action == _DELETE_ALL:
                self._shown.clear()
            elif marker.action == _DELETE:
                self._shown.pop(key, None)
            elif marker.action == _ADD:
                if key not in self._shown and len(self._shown) >= MOST_MARKERS:
                    raise CannotDrawError(f"more than {MOST_MARKERS} markers: the viewer draws no more")
                self._shown[key] = _shown(marker, time)

    def expires(self, time: int) -> bool:
        """Whether a lifetime is over."""
        return any(shown.ends is not None and shown.ends < time for shown in list(self._shown.values()))

    def expire(self, time: int) -> None:
        """Forgets those whose lifetime is over."""
        over = [key for key, shown in self._shown.items() if shown.ends is not None and shown.ends < time]
        for key in over:
            del self._shown[key]

    def draw(self, options: Options) -> list[Drawing]:
        """A drawing a group; groups that have not changed keep theirs."""
        groups: dict[_Group, list[Any]] = {}
        for shown in self._shown.values():
            groups.setdefault(shown.group, []).append(shown.marker)
        drawn = {}
        for group, markers in groups.items():
            members = tuple(id(marker) for marker in markers)
            known = self._drawn.get(group)
            if known is not None and known[0] == members:
                drawn[group] = known
            else:
                drawn[group] = (members, self._draw_group(group, markers, options))
        self._drawn = drawn
        return [drawing for _, drawing in drawn.values()]

    def _draw_group(self, group: _Group, markers: list[Any], options: Options) -> Drawing:
        numbers: list[Any] = []
        size = 0
        items = []
        for marker in markers:
            points = [(point.x, point.y, point.z) for point in marker.points]
            colours = [(colour.r, colour.g, colour.b, colour.a) for colour in marker.colors]
            item, size = _item(marker, points, colours, size)
            if size > MOST_NUMBERS:
                raise CannotDrawError(f"markers with more than {MOST_NUMBERS} numbers: the viewer draws no more")
            numbers += [np.array(points, np.float64).reshape(-1), np.array(colours, np.float64).reshape(-1)]
            if marker.mesh_resource:
                item["mesh"], item["mesh_problem"] = self._mesh_url(marker.mesh_resource)
            items.append(item)
        with np.errstate(over="ignore"):
            payload = np.concatenate(numbers).astype(np.float32) if numbers else np.zeros(0, np.float32)
        stamp = group.stamp - options.origin
        description = {"kind": "markers", "frame": group.frame, "stamp": stamp, "items": items}
        return Drawing(group.frame, group.stamp, binary.shapes(description, payload), group.locked)


def _shown(marker: Any, time: int) -> _Shown:
    lifetime = marker.lifetime.sec * 1_000_000_000 + marker.lifetime.nanosec
    locked = bool(marker.frame_locked)
    # A locked one goes where its frame goes: when it was told matters no more.
    group = _Group(marker.header.frame_id, 0 if locked else stamp_ns(marker.header.stamp), locked)
    return _Shown(marker, group, time + lifetime if lifetime > 0 else None)


def _item(marker: Any, points: Sequence[Any], colours: Sequence[Any], offset: int) -> tuple[dict[str, Any], int]:
    """What is told of a marker whose numbers begin at `offset`, and where they end."""
    colours_at = offset + 3 * len(points)
    scale = marker.scale
    item = {
        "ns": marker.ns,
        "id": marker.id,
        "type": marker.type,
        "action": _ADD,
        "frame": marker.header.frame_id,
        "frame_locked": bool(marker.frame_locked),
        "pose": [finite(value) for value in pose_row(marker.pose)],
        "scale": [finite(value) for value in (scale.x, scale.y, scale.z)],
        "rgba": rgba_of(marker.color),
        "text": marker.text,
        "use_materials": bool(marker.mesh_use_embedded_materials),
        "mesh": None,
        "mesh_problem": None,
        "points": [offset, len(points)] if points else None,
        "colors": [colours_at, len(colours)] if colours else None,
    }
    return item, colours_at + 4 * len(colours)
