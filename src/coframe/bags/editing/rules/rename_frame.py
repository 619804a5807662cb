# SPDX-License-Identifier: Apache-2.0
"""The rule ``rename-frame`` renames a frame in all messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from coframe.bags.editing._frame_renaming import rename_frames
from coframe.bags.editing._rule import Rule, split_pair
from coframe.errors import EditError

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["RenameFrame"]


class RenameFrame(Rule):
    """``rename-frame OLD=NEW``: in headers, transforms, markers and all other messages, and in robot descriptions.

    A leading slash of the old name in a message is removed as well, as tf2 does.
    """

    name = "rename-frame"
    form = "OLD=NEW"
    unit = "frame name"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.old, self.new = (name.removeprefix("/") for name in split_pair(text, self.form))
        if not self.old or not self.new or self.old == self.new:
            raise EditError(f"{text[:60]!r} does not have two different names in the form {self.form}")

    def frame(self, name: str) -> str:
        """Return the new name of a frame."""
        return self.new if name.removeprefix("/") == self.old else name

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that renames the frame in a message."""
        return rename_frames(topic, self, self.old.encode())

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar frames."""
        return did_you_mean(self.old, survey.frames) or f"Frames: {', '.join(sorted(survey.frames)[:20]) or 'none'}."
