# SPDX-License-Identifier: Apache-2.0
"""The rule ``strip-slashes``: frame names lose their leading slashes, which tf2 does not allow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags.editing._frame_renaming import rename_frames
from coframe.bags.editing._rule import Rule

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedTopic
    from coframe.bags.editing._rule import Step

__all__ = ["StripSlashes"]


class StripSlashes(Rule):
    """``strip-slashes``: ``/base_link`` becomes ``base_link``."""

    name = "strip-slashes"
    form = ""
    unit = "frame name"

    def frame(self, name: str) -> str:
        """Return the name without leading slashes."""
        return name.lstrip("/")

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that renames the frames in a message."""
        return rename_frames(topic, self, b"/")
