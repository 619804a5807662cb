# SPDX-License-Identifier: Apache-2.0
"""Find the edge that is most likely missing between two trees by their frame names."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from coframe.analysis.similar_frames import MAX_COMPARED_FRAMES, similar_frames
from coframe.analysis.static_command import static_command

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "BASE_FRAMES",
    "MissingEdge",
    "estimator_advice",
    "is_base_frame",
    "is_sensor_frame",
    "missing_edge",
    "unknown_mount",
]

# Usual pairs of parent and child, from REP-105 and common robots.
_USUAL_EDGES = (
    ("base_footprint", "base_link"),
    ("odom", "base_footprint"),
    ("odom", "base_link"),
    ("map", "odom"),
    ("map", "base_link"),
    ("earth", "map"),
    ("world", "map"),
    ("world", "odom"),
    ("world", "base_link"),
)

BASE_FRAMES = ("base_footprint", "base_link")
"""The names of a robot's base frames, the upper one first."""
_ESTIMATED_FRAMES = {"odom", "map", *BASE_FRAMES}
_SENSOR = re.compile(
    "camera|cam(?![a-z])|optical|depth|rgb|stereo|infra|imager|laser|lidar|scan|velodyne|ouster|livox|hokuyo|rplidar|ldlidar"
    "|imu|gyro|gps|gnss|navsat|radar|sonar|ultraso|range|tof|realsense|zed|kinect|sensor|magnet|baro|microphone"
)


class MissingEdge(NamedTuple):
    """An edge that would connect two trees.

    Attributes:
        parent: A frame of one tree.
        child: The root of the other tree.
        misspelled: Whether one of the two names is probably a misspelling of the other.
    """

    parent: str
    child: str
    misspelled: bool

    @property
    def text(self) -> str:
        """The probable cause, as a clause."""
        if self.misspelled:
            return f"{self.child!r} looks like a misspelling of {self.parent!r}"
        return f"the transform {self.parent} -> {self.child} is probably missing"

    @property
    def fix(self) -> str:
        """What to do, for findings: the line of code to change, or the command to run."""
        if self.misspelled or estimator_advice(self.parent, self.child):
            return self.hint
        edge, command = f"{self.parent} -> {self.child}", static_command(self.parent, self.child)
        return f"If {edge} never moves, run `{command}`; otherwise start the node that publishes it."

    @property
    def hint(self) -> str:
        """What to do, for exceptions: in terms of the Python API."""
        if self.misspelled:
            return (
                f"In the node that publishes {self.child!r}, change the line to t.header.frame_id = {self.parent!r} "
                f"(or t.child_frame_id); the two names must be the same."
            )
        if advice := estimator_advice(self.parent, self.child):
            return advice
        return (
            f"If {self.parent} -> {self.child} never moves, publish it with a StaticTransformBroadcaster or insert it "
            f"with buffer.set({self.parent!r}, {self.child!r}, ..., static=True); otherwise start the node that "
            "publishes it."
        )


def estimator_advice(parent: str, child: str, node: str = "") -> str:
    """Return what to do if an edge that is estimated by odometry or localization is missing, or "" for all other edges.

    Such an edge must not be published as a static transform: the robot would not move.

    Args:
        parent: The parent frame.
        child: The child frame.
        node: The node that probably estimates the edge, such as the publisher of the odometry, or "" if unknown.

    Example:
        >>> estimator_advice("odom", "base_link")[:61]
        'Your odometry publisher does not broadcast odom -> base_link '
        >>> estimator_advice("base_link", "lidar")
        ''
    """
    upper, lower = _without_prefix(parent), _without_prefix(child)
    label = f" ({node})" if node else ""
    if upper == "odom" and lower in BASE_FRAMES:
        return (
            f"Your odometry publisher{label} does not broadcast {parent} -> {child} (often an option such as "
            "publish_tf): enable it, or broadcast the pose of each odometry message."
        )
    if upper == "map" and lower in {"odom", *BASE_FRAMES}:
        return (
            f"Your localization or SLAM node{label} does not broadcast {parent} -> {child} (often an option such as "
            "publish_tf or tf_broadcast): start it, or enable the option; localization also needs an initial pose."
        )
    return ""


def is_base_frame(frame: str) -> bool:
    """Return whether a frame is the base of a robot by its name without a prefix."""
    return _without_prefix(frame) in BASE_FRAMES


def is_sensor_frame(frame: str) -> bool:
    """Return whether a frame name looks like the name of a sensor, which is usually mounted at a constant pose.

    Example:
        >>> is_sensor_frame("front_laser"), is_sensor_frame("imu_link"), is_sensor_frame("odom")
        (True, True, False)
    """
    return _SENSOR.search(_without_prefix(frame).lower()) is not None


def unknown_mount(root: str) -> str:
    """Return advice about a tree with this root if no missing edge is more likely than others."""
    if _without_prefix(root) in _ESTIMATED_FRAMES:
        return (
            f"Start the node that publishes a transform with child_frame_id = {root!r}: odometry, localization or SLAM."
        )
    return (
        f"Publish a transform with child_frame_id = {root!r}; if it never moves, run "
        f"`{static_command('PARENT', root)}`."
    )


def missing_edge(first: Sequence[str], second: Sequence[str]) -> MissingEdge | None:
    """Return the edge that is most likely missing between two trees, or None if none is likely.

    Misspelled names are tried first, then the usual pairs of frames.

    Args:
        first: The frames of the larger tree, its root first.
        second: The frames of the smaller tree, its root first.

    Example:
        >>> missing_edge(["odom", "base_link"], ["base_lnk", "lidar"])
        MissingEdge(parent='base_link', child='base_lnk', misspelled=True)
        >>> missing_edge(["odom", "base_footprint"], ["base_link", "wheel"])
        MissingEdge(parent='base_footprint', child='base_link', misspelled=False)
    """
    sides = ((second[0], first), (first[0], second))
    for root, frames in sides:
        if similar := similar_frames(root, frames[:MAX_COMPARED_FRAMES]):
            return MissingEdge(similar[0], root, misspelled=True)
    for parent, child in _USUAL_EDGES:
        for root, frames in sides:
            if _without_prefix(root) != child:
                continue
            above = [frame for frame in frames if _without_prefix(frame) == parent and _prefix(frame) == _prefix(root)]
            if above:
                return MissingEdge(above[0], root, misspelled=False)
    return None


def _without_prefix(frame: str) -> str:
    return frame.rpartition("/")[2]


def _prefix(frame: str) -> str:
    return frame.rpartition("/")[0]
