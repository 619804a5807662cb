"""A span of time as one HTML file that plays by itself: no server, no network."""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.errors import ViewerError
from coframe.viewer.meshes import MESH_TYPES, MeshError
from coframe.viewer.protocol import near
from coframe.viewer.scene import LocalOrigin, Scene

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from numpy.typing import NDArray

    from coframe import Buffer
    from coframe.viewer.descriptions import Description
    from coframe.viewer.meshes import MeshTable

__all__ = ["FASTEST", "ReplayRequest", "replay_page"]

FASTEST = 100.0  # pictures a second
MOST_POSES = 3_000_000  # 84 MB, a third more as text
LARGEST_MESHES = 20 << 20
_OPENING, _EMPTY = '<script type="application/json" id="replay">', "null"
_NS = 1_000_000_000


class ReplayRequest(NamedTuple):
    """What is to be replayed: times in nanoseconds, pictures a second, the fixed frame, and how long frames stay."""

    first: int
    last: int
    rate: float
    fixed: str
    frame_timeout: float
    title: str
    origin: int


def replay_page(
    template: Path, buffer: Buffer, wanted: ReplayRequest, robots: Iterable[Description], meshes: MeshTable
) -> bytes:
    """The HTML of a replay.

    Args:
        template: The page that plays it, with a place for it.
        buffer: What is shown.
        wanted: Which part of it.
        robots: Robots to go with it, with their meshes as far as these are small.
        meshes: Where these are.

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
    scene = Scene(buffer.snapshot(), ages=False)
    scene.refresh()
    block = json.dumps(_block(scene, wanted, robots, meshes), separators=(",", ":"), allow_nan=False)
    # In a script element nothing but its end has a meaning to HTML.
    safe = block.replace("<", "\\u003c")
    return f"{before}{_OPENING}{safe}{after}".encode()


def _block(scene: Scene, wanted: ReplayRequest, robots: Iterable[Description], meshes: MeshTable) -> dict[str, Any]:
    structure = scene.structure
    times = _times(wanted, len(structure.names))
    placed = [scene.place(wanted.fixed, int(time), wanted.frame_timeout) for time in times]
    index = structure.names.index(wanted.fixed) if wanted.fixed in structure.names else None
    local = LocalOrigin()
    origin = local.follow(placed[len(placed) // 2], index)
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
        "times": _packed((times - wanted.origin).astype("<f8")),
        "poses": _packed(np.stack([near(one.poses, origin) for one in placed])),
        "states": _packed(np.stack([one.states for one in placed])),
        "robots": _robots(robots, meshes),
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


def _robots(robots: Iterable[Description], meshes: MeshTable) -> list[dict[str, Any]]:
    """Those whose meshes are small enough, all together; others come without."""
    left = LARGEST_MESHES
    told = []
    for robot in robots:
        files: dict[str, str] = {}
        for reference, url in robot.told["meshes"].items():
            try:
                file = meshes.file(url.removeprefix("/mesh/"))
                size = file.stat().st_size
                if size <= left:
                    kind = MESH_TYPES[file.suffix.lower()]
                    files[reference] = f"data:{kind};base64,{base64.b64encode(file.read_bytes()).decode()}"
                    left -= size
            except (MeshError, OSError):
                continue
        told.append({**robot.told, "meshes": files})
    return told


def _packed(array: NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()
