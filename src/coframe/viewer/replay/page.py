"""A span of time as one HTML file that plays by itself: no server, no network."""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.errors import ViewerError
from coframe.viewer.protocol.binary import near
from coframe.viewer.replay.displays import Pictures, display_blocks, packed
from coframe.viewer.robots.meshes import MESH_TYPES, MeshError
from coframe.viewer.scene.scene import LocalOrigin, Scene
from coframe.viewer.scene.statistics import frame_rows
from coframe.viewer.scene.timeline import edge_rows

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from coframe import Buffer
    from coframe.viewer.replay.displays import ReplayDisplay
    from coframe.viewer.robots.descriptions import Description
    from coframe.viewer.robots.meshes import MeshTable
    from coframe.viewer.sources.messages import Messages

__all__ = ["FASTEST", "MOST_DISPLAYS", "NO_LOOKS", "ReplayLooks", "ReplayRequest", "Sights", "replay_page"]

FASTEST = 100.0  # pictures a second
MOST_POSES = 3_000_000  # 84 MB, a third more as text
MOST_DISPLAYS = 100
LARGEST_MESHES = 20 << 20
TIMELINE_BINS = 240
_OPENING, _EMPTY = '<script type="application/json" id="replay">', "null"
_NS = 1_000_000_000


class ReplayLooks(NamedTuple):
    """How a replay is to look.

    Attributes:
        displays: What is shown of topics.
        rviz: All displays with their options, and the view, as in a message ``save_rviz``.
    """

    displays: tuple[ReplayDisplay, ...]
    rviz: Mapping[str, Any]


NO_LOOKS = ReplayLooks((), {})
"""Frames and robots alone."""


class ReplayRequest(NamedTuple):
    """What is to be replayed: times in nanoseconds, pictures a second, the fixed frame, and how long frames stay."""

    first: int
    last: int
    rate: float
    fixed: str
    frame_timeout: float
    title: str
    origin: int
    looks: ReplayLooks = NO_LOOKS


class Sights(NamedTuple):
    """What there is to be replayed.

    Attributes:
        buffer: Transforms.
        messages: By topic, of the displays.
        robots: They go with it, with their meshes as far as these are small.
        meshes: Where these are.
    """

    buffer: Buffer
    messages: Mapping[str, Messages]
    robots: Sequence[Description]
    meshes: MeshTable


def replay_page(template: Path, sights: Sights, wanted: ReplayRequest) -> bytes:
    """The HTML of a replay.

    Args:
        template: The page that plays it, with a place for it.
        sights: What there is.
        wanted: Which part of it.

    Raises:
        ViewerError: The span is empty or too large, or there is no page.
    """
    try:
        page = template.read_text(encoding="utf-8")
    except OSError:
        raise ViewerError("this coframe has no page for replays: build it in viewer/") from None
    before, place, after = page.partition(_OPENING + _EMPTY)
    if not place:
        raise ViewerError("the page for replays has no place for one: build it in viewer/ again")
    block = json.dumps(_block(sights, wanted), separators=(",", ":"), allow_nan=False)
    # In a script element nothing but its end has a meaning to HTML.
    safe = block.replace("<", "\\u003c")
    return f"{before}{_OPENING}{safe}{after}".encode()


def _block(sights: Sights, wanted: ReplayRequest) -> dict[str, Any]:
    scene = Scene(sights.buffer.snapshot(), ages=False)
    scene.refresh()
    structure = scene.structure
    times = _times(wanted, len(structure.names))
    placed = [scene.place(wanted.fixed, int(time), wanted.frame_timeout) for time in times]
    index = structure.names.index(wanted.fixed) if wanted.fixed in structure.names else None
    local = LocalOrigin()
    origin = local.follow(placed[len(placed) // 2], index)
    pictures = Pictures(scene.buffer, wanted.fixed, times, origin)
    frames = zip(structure.names, structure.parents, structure.static, structure.components, strict=True)
    return {
        "format": "coframe-replay",
        "version": 1,
        "title": wanted.title,
        "origin": str(wanted.origin),
        "origin_xyz": origin.tolist(),
        "from": int(times[0]) - wanted.origin,
        "to": int(times[-1]) - wanted.origin,
        "rate": wanted.rate,
        "fixed": wanted.fixed,
        "frames": [
            {"name": name, "parent": parent, "static": static, "component": component}
            for name, parent, static, component in frames
        ],
        "times": packed((times - wanted.origin).astype("<f8")),
        "poses": packed(np.stack([near(one.poses, origin) for one in placed])),
        "states": packed(np.stack([one.states for one in placed])),
        "robots": _robots(sights),
        "rviz": dict(wanted.looks.rviz) or None,
        "displays": display_blocks(wanted.looks.displays, sights.messages, pictures),
        "stats": frame_rows(scene, wanted.origin, wanted.frame_timeout),
        "edges": edge_rows(scene.buffer, scene.infos, int(times[0]), int(times[-1]), TIMELINE_BINS, wanted.origin),
        "bins": TIMELINE_BINS,
    }


def _times(wanted: ReplayRequest, frames: int) -> NDArray[np.int64]:
    if wanted.last <= wanted.first:
        raise ViewerError("a replay must end after it begins")
    if not 0.0 < wanted.rate <= FASTEST:
        raise ViewerError(f"a replay has up to {FASTEST:g} pictures a second, not {wanted.rate:g}")
    seconds = (wanted.last - wanted.first) / _NS
    count = int(seconds * wanted.rate) + 1
    if count * max(frames, 1) > MOST_POSES:
        raise ViewerError(
            f"{seconds:.0f} s of {frames} frames {wanted.rate:g} times a second are more than one file can hold",
            hint="Choose a shorter span or a lower rate.",
        )
    step = _NS / wanted.rate
    offsets: NDArray[np.int64] = np.rint(np.arange(count) * step).astype(np.int64)
    return wanted.first + offsets


def _robots(sights: Sights) -> list[dict[str, Any]]:
    """Those whose meshes are small enough, all together; others come without."""
    left = LARGEST_MESHES
    told = []
    for robot in sights.robots:
        files: dict[str, str] = {}
        missing = 0
        for reference, url in robot.told["meshes"].items():
            try:
                file = sights.meshes.file(url.removeprefix("/mesh/"))
                size = file.stat().st_size
                if size <= left:
                    kind = MESH_TYPES[file.suffix.lower()]
                    files[reference] = f"data:{kind};base64,{base64.b64encode(file.read_bytes()).decode()}"
                    left -= size
                else:
                    missing += 1
            except (MeshError, OSError):
                missing += 1
        problems = [f"{missing} of its meshes did not fit into this replay"] if missing else []
        told.append({**robot.told, "meshes": files, "problems": [*problems, *robot.told["problems"]]})
    return told
