# SPDX-License-Identifier: Apache-2.0
"""The error of using a destroyed entity."""

from rclpy.exceptions import InvalidHandle, _with_hint


def destroyed(what: str) -> InvalidHandle:
    """Return the error of using a destroyed entity, which has upstream's text and names the entity in its hint.

    Args:
        what: Description of the entity, with which a sentence starts.
    """
    return _with_hint(
        InvalidHandle("cannot use Destroyable because destruction was requested"), f"{what} was destroyed before."
    )
