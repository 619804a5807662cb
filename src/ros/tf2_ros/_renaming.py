# SPDX-License-Identifier: Apache-2.0
"""Renaming of the frames of messages, for example with the prefix of a robot."""

from collections.abc import Iterable
from copy import copy

from coframe._core import Renaming
from geometry_msgs.msg import TransformStamped


def rename_transforms(transforms: Iterable[TransformStamped], renaming: Renaming | None) -> list[TransformStamped]:
    """Return the transforms with renamed frames. The given transforms are not modified."""
    return list(transforms) if renaming is None else [_rename(transform, renaming) for transform in transforms]


def _rename(transform: TransformStamped, renaming: Renaming) -> TransformStamped:
    result = copy(transform)
    result.header = copy(transform.header)
    result.header.frame_id = renaming(transform.header.frame_id)
    result.child_frame_id = renaming(transform.child_frame_id)
    return result
