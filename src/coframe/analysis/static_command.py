# SPDX-License-Identifier: Apache-2.0
"""The shell command that publishes a static transform."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["static_command"]

_FLAGS = ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw")


def static_command(parent: str, child: str, pose: Iterable[float] | None = None) -> str:
    """Return the `coframe static` command that publishes a static transform, quoted for a POSIX shell.

    Args:
        parent: The parent frame.
        child: The child frame.
        pose: The pose of the child in the parent: x, y, z in meters and the quaternion qx, qy, qz, qw, or None if it is
            unknown; the command then contains placeholders.

    Example:
        >>> static_command("base_link", "lidar")
        'coframe static --frame-id base_link --child-frame-id lidar --x ... --yaw ...'
        >>> static_command("base link", "lidar", (0.5, 0, 0, 0, 0, 0, 1))
        "coframe static --frame-id 'base link' --child-frame-id lidar --x 0.5 --y 0 --z 0 --qx 0 --qy 0 --qz 0 --qw 1"
    """
    names = f"coframe static --frame-id {shlex.quote(parent)} --child-frame-id {shlex.quote(child)}"
    if pose is None:
        return f"{names} --x ... --yaw ..."
    # Adding 0.0 turns -0.0 into 0.0.
    return " ".join([names, *(f"{flag} {value + 0.0:.9g}" for flag, value in zip(_FLAGS, pose, strict=True))])
