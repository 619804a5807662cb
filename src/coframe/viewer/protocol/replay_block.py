# SPDX-License-Identifier: Apache-2.0
"""The JSON block inside a replay file."""

from __future__ import annotations

from typing import Literal, TypedDict

from coframe.viewer.protocol.client_messages import ReplayRviz
from coframe.viewer.protocol.common import ColorBy, DisplayState, Vector
from coframe.viewer.protocol.server_messages import FrameStats, RobotModel, SceneNode, TimelineEdge, TreeFrame


class ReplayDisplayBlock(TypedDict):
    """A recorded display. Arrays are base64 text of little-endian numbers.

    Attributes:
        every: Every n-th time was recorded.
        statuses: The index of the time from which a status applies, with the status.
        drawings: Binary messages by sequence number.
        changes: uint32: the indices of the times at which the listing changes.
        counts: uint32: the number of drawings of each listing.
        sequences: uint32: the drawings of all listings.
        poses: float32[7]: the poses of their frames.
        stamps: float64: the stamps of these poses, or NaN for the time of the listing.
    """

    topic: str
    type: str
    display: str
    color_by: ColorBy | None
    every: int
    statuses: list[tuple[int, DisplayState, str]]
    drawings: dict[str, str]
    changes: str
    counts: str
    sequences: str
    poses: str
    stamps: str


class ReplayNode(TypedDict):
    """A node that a program has added to the scene; ``geometry`` is its binary message as base64 text, or ""."""

    node: SceneNode
    geometry: str


ReplayBlock = TypedDict(
    "ReplayBlock",
    {
        "format": Literal["coframe-replay"],
        "version": int,
        "title": str,
        "origin": str,
        "origin_xyz": Vector,
        "from": float,
        "to": float,
        "rate": float,
        "fixed": str,
        "frames": list[TreeFrame],
        "times": str,
        "poses": str,
        "states": str,
        "robots": list[RobotModel],
        "rviz": ReplayRviz | None,
        "displays": list[ReplayDisplayBlock],
        "nodes": list[ReplayNode],
        "stats": list[FrameStats],
        "edges": list[TimelineEdge],
        "bins": int,
    },
)
"""The content of a replay. Arrays are base64 text: float64 times, float32[7] poses and uint8 states of all frames."""
