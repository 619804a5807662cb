# SPDX-License-Identifier: Apache-2.0
"""Joint positions as users have them: a mapping, an array, or JointState messages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from coframe.time import stamp_ns

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import ArrayLike

    from coframe.quaternion import Array
    from coframe.robots.parts import Joint

__all__ = ["Positions", "by_joint", "group_messages"]

Positions: TypeAlias = "Mapping[str, ArrayLike] | ArrayLike | Any"


def by_joint(positions: Positions, joints: Mapping[str, Joint], free: Sequence[str]) -> dict[str, Any]:
    """Return positions by joint.

    Args:
        positions: A mapping; an array (n,) or (N, n) with a column for each of the free joints; a JointState message,
            of which joints that the robot does not have are ignored; or None for the defaults.
        joints: The joints of the robot by name.
        free: The free joints.

    Raises:
        ValueError: An array has another number of columns, or a message has no position of the robot.
    """
    if positions is None:
        return {}
    if isinstance(positions, Mapping):
        return dict(positions)
    if is_joint_state(positions):
        return _of_message(positions, joints)
    array = np.asarray(positions, dtype=np.float64)
    if array.ndim not in {1, 2} or array.shape[-1] != len(free):
        raise ValueError(
            f"positions must have shape ({len(free)},) or (N, {len(free)}), with a column for each of "
            f"{', '.join(free) or 'no joints'}, not {array.shape}"
        )
    return {name: array[..., i] for i, name in enumerate(free)}


def is_joint_state(value: Any) -> bool:
    """Return whether a value is a JointState message of any program."""
    return hasattr(value, "name") and hasattr(value, "position") and not isinstance(value, Mapping)


def group_messages(
    messages: Iterable[Any], joints: Mapping[str, Joint]
) -> list[tuple[np.ndarray[Any, np.dtype[np.int64]], dict[str, Array]]]:
    """Return the stamps (N,) and the positions (N,) by joint of JointState messages that name the same joints.

    Raises:
        ValueError: There is no message, or a message has no position of the robot.
    """
    stamps: dict[tuple[str, ...], list[int]] = {}
    rows: dict[tuple[str, ...], list[list[float]]] = {}
    for message in messages:
        found = _of_message(message, joints)
        names = tuple(found)
        stamps.setdefault(names, []).append(stamp_ns(message.header.stamp))
        rows.setdefault(names, []).append(list(found.values()))
    if not rows:
        raise ValueError("the list contains no JointState message")
    return [
        (np.array(stamps[names], dtype=np.int64), dict(zip(names, np.array(rows[names]).T, strict=True)))
        for names in rows
    ]


def _of_message(message: Any, joints: Mapping[str, Joint]) -> dict[str, float]:
    names, values = list(message.name), list(message.position)
    if len(names) != len(values):
        raise ValueError(
            f"the JointState has {len(names)} names and {len(values)} positions: both must have one entry per joint"
        )
    found = {
        name: float(value) for name, value in zip(names, values, strict=True) if _has_one_position(joints.get(name))
    }
    if not found:
        known = ", ".join(name for name, joint in joints.items() if _has_one_position(joint)) or "none"
        raise ValueError(
            f"the JointState has no position of the robot: it contains {', '.join(names) or 'nothing'}. Known joints: "
            f"{known}."
        )
    return found


def _has_one_position(joint: Joint | None) -> bool:
    return joint is not None and joint.size == 1
