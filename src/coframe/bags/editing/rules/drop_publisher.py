# SPDX-License-Identifier: Apache-2.0
"""The rule ``drop-publisher`` drops the messages of one of several publishers of a transform or topic."""

from __future__ import annotations

import re
import struct
from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import did_you_mean
from coframe.bags.editing._rule import Rule
from coframe.errors import EditError
from coframe.frame_names import absolute
from coframe.messages.encapsulation import BYTE_ORDERS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey
    from coframe.bags.editing._transform_bytes import RecordedTransform

__all__ = ["DropPublisher"]

_EDGE = re.compile(r"(?P<parent>.+?)\s*->\s*(?P<child>[^@#]+?)\s*(?:#(?P<track>[12])|@(?P<topic>\S+))?")
_SEED_COUNT = 400  # transforms from which the two tracks are found
_START_COUNT = 10  # of them, among which both publishers occur
_MIN_SEEDED = 4
_MIN_RATIO = 2.0  # distance of the two tracks to the usual step on one


class DropPublisher(Rule):
    """``drop-publisher``: recordings rarely name publishers, which are distinguished by what they sent.

    - ``odom->base_link``: all transforms with this parent and child, as when two publishers disagree on the parent;
    - ``odom->base_link@/tf``: only those on one topic, as when a transform is both static and dynamic;
    - ``odom->base_link#2``: if two publishers send different poses in turns, the second of the two; 1 is the one whose
      transform is recorded first;
    - ``/scan@laser_2``: the messages of a topic whose header names a frame;
    - ``/camera_driver``: all messages of a node, if the recording names the nodes, as bags of ROS 1 do.
    """

    name = "drop-publisher"
    form = "PARENT->CHILD[@TOPIC|#1|#2] | TOPIC@FRAME | NODE"
    verb = "removed"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._edge = _EDGE.fullmatch(text)
        self._topic, self._at, self._frame = (part.strip() for part in text.partition("@"))
        if not text.strip() or (not self._edge and self._at and not (self._topic and self._frame)):
            raise EditError(f"{text[:60]!r} does not have the form {self.form}")
        names = (self._edge["parent"], self._edge["child"]) if self._edge else ("", "")
        self._parent, self._child = (name.strip().removeprefix("/").encode() for name in names)
        self._track = int(self._edge["track"] or 0) if self._edge else 0
        self._ends: list[NDArray[np.float64]] = []  # the last pose on each of the two tracks

    def prepare(self, survey: Survey) -> None:
        """Find the two tracks of poses.

        Raises:
            EditError: The transforms follow one track.
        """
        if not self._track:
            return
        poses: list[NDArray[np.float64]] = []
        for topic, _, message in survey.messages(lambda one: one.has_transforms and not one.is_static):
            del topic
            poses += [_pose(transform, message) for transform in message.transforms() if self._is_wanted(transform)]
            if len(poses) >= _SEED_COUNT:
                break
        self._ends = _tracks(poses)
        if not self._ends:
            raise EditError(
                f"the poses of {self.text.partition('#')[0]} do not form two separate tracks",
                hint="`coframe doctor BAG` reports transforms with two publishers.",
            )

    def _is_wanted(self, transform: RecordedTransform) -> bool:
        names = (transform.parent.removeprefix(b"/"), transform.child.removeprefix(b"/"))
        return names == (self._parent, self._child)

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that drops messages or transforms of the publisher."""
        if self._edge:
            on = self._edge["topic"]
            is_meant = on is None or absolute(on) == absolute(topic.name)
            return self._drop_transforms if topic.has_transforms and is_meant else None
        if self._at:
            return self._drop_frame(topic) if absolute(self._topic) == absolute(topic.name) else None
        publisher = topic.channel.publisher
        return self._drop if publisher and absolute(publisher) == absolute(self.text) else None

    def _drop(self, _message: EditedMessage) -> bool:
        self.changes += 1
        return False

    def _drop_frame(self, topic: EditedTopic) -> Step | None:
        frames = topic.frames
        if frames is None:
            return None

        def step(message: EditedMessage) -> bool:
            if frames.of_header(message.data).removeprefix("/") != self._frame.removeprefix("/"):
                return True
            return self._drop(message)

        return step

    def _drop_transforms(self, message: EditedMessage) -> bool:
        if self._child not in message.data:
            return True
        transforms = message.transforms()
        kept_transforms = [
            transform
            for transform in transforms
            if not (self._is_wanted(transform) and self._is_of_publisher(transform, message))
        ]
        if len(kept_transforms) == len(transforms):
            return True
        self.changes += len(transforms) - len(kept_transforms)
        message.set_transforms(kept_transforms)
        return bool(kept_transforms)

    def _is_of_publisher(self, transform: RecordedTransform, message: EditedMessage) -> bool:
        if not self._track:
            return True
        pose = _pose(transform, message)
        nearest = _nearest_end(pose, self._ends)
        self._ends[nearest] = pose
        return nearest + 1 == self._track

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar names."""
        if self._edge:
            return did_you_mean(self._child.decode(), survey.frames)
        return did_you_mean(self._topic, [*survey.input_topics, *survey.publishers])


def _pose(transform: RecordedTransform, message: EditedMessage) -> NDArray[np.float64]:
    """Return x, y, z in meters and the quaternion with w >= 0, for distances that mix meters and radians."""
    values = np.array(struct.unpack(f"{BYTE_ORDERS[message.data[:2]]}7d", transform.pose))
    return np.asarray(np.concatenate([values[:3], 2.0 * values[3:] * (1.0 if values[6] >= 0.0 else -1.0)]))


def _distance(first: NDArray[np.float64], second: NDArray[np.float64]) -> float:
    angle = min(float(np.linalg.norm(first[3:] - second[3:])), float(np.linalg.norm(first[3:] + second[3:])))
    return float(np.linalg.norm(first[:3] - second[:3])) + angle


def _nearest_end(pose: NDArray[np.float64], ends: list[NDArray[np.float64]]) -> int:
    return int(_distance(pose, ends[1]) < _distance(pose, ends[0]))


def _tracks(poses: list[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
    """Return the first pose on each of two tracks, in the order in which they begin; [] if there is one track."""
    if len(poses) < _MIN_SEEDED:
        return []
    first = poses[0]
    farthest = max(range(len(poses[:_START_COUNT])), key=lambda number: _distance(poses[number], first))
    seeds = [first, poses[farthest]]
    ends, steps, apart = list(seeds), [], []
    for pose in poses:
        nearest = _nearest_end(pose, ends)
        steps.append(_distance(pose, ends[nearest]))
        apart.append(_distance(pose, ends[1 - nearest]))
        ends[nearest] = pose
    is_apart = float(np.median(apart)) > max(_MIN_RATIO * float(np.median(steps)), 1e-6)
    return seeds if is_apart else []
