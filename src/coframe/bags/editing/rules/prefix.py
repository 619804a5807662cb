# SPDX-License-Identifier: Apache-2.0
"""The rule ``prefix`` adds a prefix to the frames of a robot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags.editing._frame_renaming import rename_frames
from coframe.bags.editing._rule import Rule
from coframe.errors import EditError
from coframe.frame_names import renaming

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedTopic
    from coframe.bags.editing._rule import Step

__all__ = ["Prefix"]


class Prefix(Rule):
    """``prefix robot1/ keep map,world``: prefix all frames except the shared ones, including in robot descriptions."""

    name = "prefix"
    form = "PREFIX [keep FRAME,FRAME]"
    unit = "frame name"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        prefix, _, keep = text.strip().partition(" ")
        word, _, names = keep.strip().partition(" ")
        if word not in {"", "keep"} or (word and not names.strip()):
            raise EditError(f"{text[:60]!r} does not have the form {self.form}")
        try:
            renamed = renaming(prefix, names)
        except ValueError as error:
            raise EditError(str(error)) from None
        if renamed is None:
            raise EditError("the prefix is empty")
        self._rename = renamed

    def frame(self, name: str) -> str:
        """Return the name with the prefix."""
        return self._rename(name) if name.lstrip("/") else name

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that renames the frames in a message."""
        return rename_frames(topic, self)
