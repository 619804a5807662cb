# SPDX-License-Identifier: Apache-2.0
"""The rule ``replace-mount``: the pose of a frame that does not move is corrected."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from coframe.bags.editing._rule import Rule
from coframe.bags.editing._static_sources import parse_pose, split_words
from coframe.errors import EditError

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["ReplaceMount"]


class ReplaceMount(Rule):
    """``replace-mount CHILD X Y Z ROLL PITCH YAW``: a new pose for each transform of the frame, static or not.

    Unlike ``set-static``, the parent, the topic and the stamps stay, and nothing is added.
    """

    name = "replace-mount"
    form = "CHILD X Y Z ROLL PITCH YAW"
    unit = "transform"
    verb = "replaced"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        words = split_words(text)
        if len(words) not in {7, 8}:
            raise EditError(f"{text[:60]!r} does not have the form {self.form}")
        self._child = words[0].removeprefix("/").encode()
        self._pose = parse_pose(words[1:])

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that replaces the pose in a message."""
        return self._replace if topic.has_transforms else None

    def _replace(self, message: EditedMessage) -> bool:
        if self._child not in message.data:
            return True
        transforms, change_count = message.transforms(), 0
        pose = message.pack_pose(self._pose)
        for transform in transforms:
            if transform.child.removeprefix(b"/") == self._child:
                transform.pose = pose
                change_count += 1
        if change_count:
            message.set_transforms(transforms)
            self.changes += change_count
        return True

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar frames."""
        return did_you_mean(self._child.decode(), survey.frames)
