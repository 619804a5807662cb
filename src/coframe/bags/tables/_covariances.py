# SPDX-License-Identifier: Apache-2.0
"""Covariances of the edges of a recording's tree, from its Odometry messages."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from coframe.errors import CoframeError, RecordingError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.bags.recording import Recording
    from coframe.bags.tables.columns import PoseSource

__all__ = ["load_covariances"]

_ODOMETRY = "nav_msgs/msg/Odometry"


def load_covariances(recording: Recording, poses: Iterable[PoseSource]) -> None:
    """Store the covariances of Odometry messages on the edges between frames that have none yet.

    Args:
        recording: The recording; the covariances are stored in its buffer.
        poses: The poses whose edges need covariances.

    Raises:
        RecordingError: Several topics describe the same edge.
    """
    needed = _edges_between(recording, poses) - set(recording.buffer.frames_with_covariance())
    if not needed:
        return
    edges = {(edge.parent, edge.child) for edge in recording.buffer.edges()}
    topics: dict[tuple[str, str], str] = {}
    for name, topic in recording.topics.items():
        edge = _edge_of(recording, name) if topic.type == _ODOMETRY and topic.messages else None
        if edge is None or edge[1] not in needed or edge not in edges:
            continue
        if edge in topics:
            raise RecordingError(
                f"{topics[edge]} and {name} both have covariances of {edge[0]} -> {edge[1]}",
                hint="Store one of them first: bag.buffer.set_covariance(PARENT, CHILD, message) for each message.",
            )
        topics[edge] = name
    for (parent, child), name in topics.items():
        for message in recording.messages(name):
            with suppress(CoframeError):  # Damaged messages, and those without a covariance.
                recording.buffer.set_covariance(parent, child, message)


def _edges_between(recording: Recording, poses: Iterable[PoseSource]) -> set[str]:
    """Return the frames whose edges to their parents are on the way between the frames."""
    children: set[str] = set()
    for pose in poses:
        with suppress(CoframeError):  # Unknown frames have their own error.
            source = pose.source if pose.source in recording.buffer.frame_names() else pose.source.rpartition(".")[0]
            frames = recording.buffer.chain(pose.target, 0, source or pose.source, 0, pose.target)
            children.update(frames)
    return children


def _edge_of(recording: Recording, topic: str) -> tuple[str, str] | None:
    """Return the parent and the child of the first Odometry message, or None if it cannot be read."""
    for found in recording.messages(topic):
        try:
            message = found.message
            return recording.frame(message.header.frame_id), recording.frame(message.child_frame_id)
        except (CoframeError, AttributeError):
            return None
    return None
