# SPDX-License-Identifier: Apache-2.0
"""The rule ``drop-invalid``: transforms that tf2 rejects are left out."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

from coframe.bags.editing._rule import Rule
from coframe.buffer import Buffer
from coframe.messages.encapsulation import BYTE_ORDERS

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._transform_bytes import RecordedTransform

__all__ = ["DropInvalid"]


class DropInvalid(Rule):
    """``drop-invalid``: transforms with NaN, an invalid rotation, an empty name, or equal frame names."""

    name = "drop-invalid"
    form = ""
    unit = "transform"
    verb = "removed"

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that removes invalid transforms from a message."""
        return self._drop if topic.has_transforms else None

    def _drop(self, message: EditedMessage) -> bool:
        transforms = message.transforms()
        order = BYTE_ORDERS[message.data[:2]] if transforms else "<"
        kept_transforms = [transform for transform in transforms if _is_accepted(transform, order)]
        if len(kept_transforms) == len(transforms):
            return True
        self.changes += len(transforms) - len(kept_transforms)
        message.set_transforms(kept_transforms)
        return bool(kept_transforms)


def _is_accepted(transform: RecordedTransform, order: str) -> bool:
    parent, child = (str(name, "utf-8", "replace") for name in (transform.parent, transform.child))
    x, y, z, qx, qy, qz, qw = struct.unpack(f"{order}7d", transform.pose)
    return Buffer(None)._set_values(parent, child, 0, x, y, z, qx, qy, qz, qw, True, "") == 0
