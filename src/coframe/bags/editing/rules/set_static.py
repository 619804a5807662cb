# SPDX-License-Identifier: Apache-2.0
"""The rule ``set-static`` adds a static transform, or replaces the one of its child frame."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import TYPE_CHECKING

from coframe.bags.editing._rule import Insertion, Rule
from coframe.bags.editing._static_sources import StaticTransform, parse_pose, read_static_transforms, split_words
from coframe.bags.editing._transform_bytes import RecordedTransform, join_transforms
from coframe.errors import EditError
from coframe.frame_names import TF_STATIC_TOPIC
from coframe.messages.encapsulation import LITTLE_ENDIAN_HEADER

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["SetStatic"]

_WORD_COUNTS = (8, 9)  # words: parent, child, x, y, z and three angles or a quaternion


class SetStatic(Rule):
    """``set-static PARENT CHILD X Y Z ROLL PITCH YAW``, or the static transforms of a file.

    Where the recording has a static transform of the child frame, it is replaced. Otherwise, a message at the beginning
    of the recording adds it. Dynamic transforms of the child frame are removed. Files are robot descriptions (their
    fixed joints), calibrations (Kalibr, Autoware, camera_info of a right camera) and recordings; ``NAME=FRAME`` after
    the file gives the frames that a calibration does not name.
    """

    name = "set-static"
    form = "PARENT CHILD X Y Z ROLL PITCH YAW | FILE [NAME=FRAME]..."
    unit = "transform"
    verb = "set"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        words = split_words(text)
        self._set: dict[bytes, StaticTransform] = {}
        self._missing_transforms: list[StaticTransform] = []
        self._topic = TF_STATIC_TOPIC
        self._file: Path | None = None
        self._names: dict[str, str] = {}
        if len(words) in _WORD_COUNTS and not all("=" in word for word in words[1:]):
            parent, child = (word.removeprefix("/") for word in words[:2])
            if not parent or not child or parent == child:
                raise EditError(f"{text[:60]!r}: the parent and the child must be two frames")
            self._add(StaticTransform(parent, child, parse_pose(words[2:])))
        elif words and all("=" in word for word in words[1:]):
            self._file = Path(words[0])
            self._names = dict(word.split("=", 1) for word in words[1:])
        else:
            raise EditError(f"{text[:60]!r} does not have the form {self.form}")

    def _add(self, transform: StaticTransform) -> None:
        self._set[transform.child.encode()] = transform

    def prepare(self, survey: Survey) -> None:
        """Read the file, and find out which transforms are missing.

        Raises:
            EditError: The file cannot be read.
        """
        if self._file is not None:
            for transform in read_static_transforms(self._file, self._names, survey):
                self._add(transform)
        known = survey.static_transforms()
        there = {transform.child for transform in known}
        self._missing_transforms = [transform for name, transform in self._set.items() if name.decode() not in there]
        topics = [name for name in survey.topics if name.rpartition("/")[2] == "tf_static"]
        of_parent = [
            transform.topic
            for transform in known
            if {transform.child, transform.parent} & {new.parent for new in self._missing_transforms}
        ]
        default = TF_STATIC_TOPIC if TF_STATIC_TOPIC in topics or len(topics) != 1 else topics[0]
        self._topic = of_parent[0] if of_parent else default

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that replaces or removes the transforms of the child frames."""
        if not topic.has_transforms:
            return None
        return self._replace if topic.is_static else self._remove

    def _replace(self, message: EditedMessage) -> bool:
        transforms, change_count = message.transforms(), 0
        for transform in transforms:
            new = self._set.get(transform.child.removeprefix(b"/"))
            if new is not None:
                transform.parent, transform.pose = new.parent.encode(), message.pack_pose(new.pose)
                change_count += 1
        if change_count:
            message.set_transforms(transforms)
            self.changes += change_count
        return True

    def _remove(self, message: EditedMessage) -> bool:
        transforms = message.transforms()
        kept_transforms = [transform for transform in transforms if transform.child.removeprefix(b"/") not in self._set]
        if len(kept_transforms) == len(transforms):
            return True
        self.changes += len(transforms) - len(kept_transforms)
        message.set_transforms(kept_transforms)
        return bool(kept_transforms)

    def insertions(self) -> Iterator[Insertion]:
        """Yield the message with the transforms that the recording does not have."""
        if self._missing_transforms:
            self.changes += len(self._missing_transforms)
            added = [
                RecordedTransform(
                    0, transform.parent.encode(), transform.child.encode(), struct.pack("<7d", *transform.pose)
                )
                for transform in self._missing_transforms
            ]
            yield Insertion(self._topic, join_transforms(added, LITTLE_ENDIAN_HEADER))
