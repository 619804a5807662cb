# SPDX-License-Identifier: Apache-2.0
"""The HTML file of a replay."""

from __future__ import annotations

import base64
import json
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from coframe._files.regular_files import read_regular
from coframe.errors import ViewerError
from coframe.time import SECOND
from coframe.viewer.protocol.encoding import relative_to
from coframe.viewer.protocol.replay_block import ReplayBlock
from coframe.viewer.protocol.server_messages import RobotModel, TreeFrame
from coframe.viewer.replay._nodes import record_nodes
from coframe.viewer.replay._template import replay_template
from coframe.viewer.replay.displays import ReplayTimes, no_progress, pack, record_displays
from coframe.viewer.robots.meshes import MESH_TYPES, MeshError
from coframe.viewer.scene.scene import LocalOrigin, Scene
from coframe.viewer.scene.statistics import frame_rows
from coframe.viewer.scene.timeline import edge_rows

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from coframe.buffer.buffer import Buffer
    from coframe.viewer.protocol.client_messages import ReplayRviz
    from coframe.viewer.protocol.common import Vector
    from coframe.viewer.replay.displays import Progress, ReplayDisplay
    from coframe.viewer.robots.descriptions import Description
    from coframe.viewer.robots.meshes import MeshTable
    from coframe.viewer.scripting.nodes import NodeRecord
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = [
    "DEFAULT_SETTINGS",
    "FRAME_TIMEOUT",
    "MAX_DISPLAYS",
    "MAX_POSES",
    "MAX_RATE",
    "ReplayContent",
    "ReplayRequest",
    "ReplaySettings",
    "replay_page",
]

FRAME_TIMEOUT = 15.0
"""How many seconds a frame stays visible after its last sample, as in RViz."""
MAX_RATE = 100.0
"""Frames per second."""
MAX_POSES = 3_000_000  # 84 MB; base64 adds a third.
MAX_DISPLAYS = 100
MAX_MESH_BYTES = 20 << 20
TIMELINE_BINS = 240


class ReplaySettings(NamedTuple):
    """The initial state of a replay.

    Attributes:
        displays: The displays to record.
        rviz: All displays with their options, and the view, or None for the defaults.
    """

    displays: tuple[ReplayDisplay, ...]
    rviz: ReplayRviz | None


DEFAULT_SETTINGS = ReplaySettings((), None)
"""Only frames and robots."""


class ReplayRequest(NamedTuple):
    """A request for a replay.

    Attributes:
        first: The first time, in nanoseconds.
        last: The last time, in nanoseconds.
        rate: Frames per second.
        fixed: The fixed frame.
        frame_timeout: The number of seconds for which a frame stays visible after its last sample.
        title: The title of the page.
        origin: The origin of the times in the replay, in nanoseconds.
        settings: The initial view of the replay.
    """

    first: int
    last: int
    rate: float
    fixed: str
    frame_timeout: float
    title: str
    origin: int
    settings: ReplaySettings = DEFAULT_SETTINGS


class ReplayContent(NamedTuple):
    """The data from which a replay is made.

    Attributes:
        buffer: The transforms.
        messages: The messages of the displays, by topic.
        robots: The descriptions of the robots to draw.
        meshes: The meshes of the robots; small ones are included.
        nodes: The scene nodes of a program.
    """

    buffer: Buffer
    messages: Mapping[str, TopicMessages]
    robots: Sequence[Description]
    meshes: MeshTable
    nodes: Sequence[NodeRecord] = ()


def replay_page(
    static: Path, content: ReplayContent, request: ReplayRequest, progress: Progress | None = None
) -> bytes:
    """Return the HTML of a replay.

    Args:
        static: The folder of the built page.
        content: The data.
        request: The part of the data.
        progress: Called with a task, the completed amount and the total.

    Raises:
        ViewerError: The span is empty or too large, or the built page does not exist.
    """
    before, after = replay_template(static)
    block = json.dumps(_block(content, request, progress or no_progress), separators=(",", ":"), allow_nan=False)
    # Inside a script element, only its end tag is special in HTML.
    safe = block.replace("<", "\\u003c")
    return f"{before}{safe}{after}".encode()


def _block(content: ReplayContent, request: ReplayRequest, progress: Progress) -> ReplayBlock:
    scene = Scene(content.buffer.snapshot(), ages=False)
    scene.refresh()
    structure = scene.structure
    times = _times(request, len(structure.names))
    placed = []
    for number, time in enumerate(times, 1):
        placed.append(scene.place(request.fixed, int(time), request.frame_timeout))
        progress("frames", number, len(times))
    index = structure.names.index(request.fixed) if request.fixed in structure.names else None
    local = LocalOrigin()
    origin = local.follow(placed[len(placed) // 2], index)
    replay_times = ReplayTimes(scene.buffer, request.fixed, times, origin)
    frames = zip(structure.names, structure.parents, structure.static, structure.components, strict=True)
    first, last = int(times[0]), int(times[-1])
    return ReplayBlock(
        {
            "format": "coframe-replay",
            "version": 1,
            "title": request.title,
            "origin": str(request.origin),
            "origin_xyz": cast("Vector", tuple(origin.tolist())),
            "from": first - request.origin,
            "to": last - request.origin,
            "rate": request.rate,
            "fixed": request.fixed,
            "frames": [
                TreeFrame(name=name, parent=parent, static=static, component=component)
                for name, parent, static, component in frames
            ],
            "times": pack((times - request.origin).astype("<f8")),
            "poses": pack(np.stack([relative_to(origin, one.poses) for one in placed])),
            "states": pack(np.stack([one.states for one in placed])),
            "robots": _robots(content),
            "rviz": request.settings.rviz,
            "displays": record_displays(request.settings.displays, content.messages, replay_times, progress),
            "nodes": record_nodes(content.nodes, request.origin),
            "stats": frame_rows(scene, request.origin, request.frame_timeout),
            "edges": edge_rows(scene.buffer, scene.infos, first, last, TIMELINE_BINS, request.origin),
            "bins": TIMELINE_BINS,
        }
    )


def _times(request: ReplayRequest, frames: int) -> NDArray[np.int64]:
    if request.last < request.first:
        raise ViewerError("a replay must not end before it begins")
    if not 0.0 < request.rate <= MAX_RATE:
        raise ViewerError(f"a replay has more than 0 and at most {MAX_RATE:g} frames per second, not {request.rate:g}")
    seconds = (request.last - request.first) / SECOND
    count = int(seconds * request.rate) + 1
    if count * max(frames, 1) > MAX_POSES:
        raise ViewerError(
            f"{seconds:.0f} s with {frames} frames at {request.rate:g} Hz have {count * frames} poses; "
            f"a replay has at most {MAX_POSES}",
            hint="Choose a shorter span or a lower rate.",
        )
    step = SECOND / request.rate
    offsets: NDArray[np.int64] = np.rint(np.arange(count) * step).astype(np.int64)
    return request.first + offsets


def _robots(content: ReplayContent) -> list[RobotModel]:
    """Return the robots with their meshes, as long as the total size of the meshes is within the limit."""
    left = MAX_MESH_BYTES
    robots = []
    for description in content.robots:
        message = description.message
        files: dict[str, str] = {}
        missing = 0
        for reference, url in message["meshes"].items():
            try:
                file = content.meshes.file(url.removeprefix("/mesh/"))
                mesh = read_regular(file, left)
                kind = MESH_TYPES[file.suffix.lower()]
                files[reference] = f"data:{kind};base64,{base64.b64encode(mesh).decode()}"
                left -= len(mesh)
            except (MeshError, OSError):
                missing += 1
        problems = [f"{missing} meshes did not fit into this replay"] if missing else []
        robot = message.copy()
        robot["meshes"], robot["problems"] = files, [*problems, *message["problems"]]
        robots.append(robot)
    return robots
