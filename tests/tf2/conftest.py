# SPDX-License-Identifier: Apache-2.0
"""Transforms for the tests."""

from collections.abc import Callable

import pytest

from geometry_msgs.msg import TransformStamped

NANOSECONDS = 1_000_000_000


def _stamped(
    parent: str,
    child: str,
    time: float = 0.0,
    translation: tuple[float, float, float] = (0.0, 0.0, 0.0),
    rotation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0),
) -> TransformStamped:
    message = TransformStamped()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(round(time * NANOSECONDS), NANOSECONDS)
    message.header.frame_id, message.child_frame_id = parent, child
    vector, quaternion = message.transform.translation, message.transform.rotation
    vector.x, vector.y, vector.z = translation
    quaternion.x, quaternion.y, quaternion.z, quaternion.w = rotation
    return message


@pytest.fixture
def stamped() -> Callable[..., TransformStamped]:
    """Return a function stamped(parent, child, time in seconds, translation, rotation)."""
    return _stamped
