"""A slider in the terminal for each joint: arrows choose and move."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from coframe.robots.joint_states import FreeJoint, JointStates

__all__ = ["HELP", "Sliders"]

HELP = "arrows choose and move, page up/down far; 0 rest, a all rest, r random, q end"
_WIDTH = 31
_STEPS = {"left": -0.01, "right": 0.01, "page down": -0.1, "page up": 0.1}  # shares of the way


class Sliders:
    """The free joints of a robot, one of which is chosen."""

    def __init__(self) -> None:
        self.chosen = 0

    def press(self, key: str, states: JointStates) -> bool:
        """Does what a key is for.

        Returns:
            Whether to go on.
        """
        joints = list(states.free.values())
        if key == "q":
            return False
        if not joints:
            return True
        self.chosen = min(self.chosen, len(joints) - 1)
        joint = joints[self.chosen]
        if key in {"up", "down"}:
            self.chosen = (self.chosen + (1 if key == "down" else -1)) % len(joints)
        elif key in _STEPS:
            position = _position(joint) + _STEPS[key] * (joint.upper - joint.lower)
            joint.position = min(max(position, joint.lower), joint.upper)
        elif key == "0":
            joint.position = joint.zero
        elif key == "a":
            for each in joints:
                each.position = each.zero
        elif key == "r":
            for each in joints:
                each.position = random.uniform(each.lower, each.upper)  # noqa: S311 - a pose, no secret
        return True

    def table(self, states: JointStates, height: int) -> Table:
        """The joints around the chosen one, as many as there is room for."""
        names = list(states.free)
        self.chosen = min(self.chosen, max(len(names) - 1, 0))
        first = max(0, min(self.chosen - height // 2, len(names) - height))
        table = Table(box=None, padding=(0, 1, 0, 0), pad_edge=False, show_header=False)
        for name in names[first : first + height]:
            joint = states.free[name]
            is_chosen = name == names[self.chosen]
            table.add_row(
                Text(">" if is_chosen else " "),
                Text(name, style="bold" if is_chosen else "", no_wrap=True),
                Text(f"{joint.lower:8.3f}", style="dim"),
                Text(_bar(joint), style="cyan" if is_chosen else ""),
                Text(f"{joint.upper:.3f}", style="dim"),
                Text(f"{_position(joint):8.3f}"),
            )
        return table


def _position(joint: FreeJoint) -> float:
    return joint.zero if joint.position is None else joint.position


def _bar(joint: FreeJoint) -> str:
    way = joint.upper - joint.lower
    share = (_position(joint) - joint.lower) / way if way > 0.0 else 0.0
    place = round(min(max(share, 0.0), 1.0) * (_WIDTH - 1))
    return "─" * place + "●" + "─" * (_WIDTH - 1 - place)
