# SPDX-License-Identifier: Apache-2.0
"""Sliders for joints in the terminal, controlled by the arrow keys."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

from rich.table import Table
from rich.text import Text

from coframe._output.escaping import display_name

if TYPE_CHECKING:
    from coframe.robots.joint_states import FreeJoint, JointStates

__all__ = ["HELP", "Sliders"]

HELP = "arrows: select, move; page up/down: big steps; 0: reset; a: reset all; r: random; q: quit"
_WIDTH = 31
_STEPS = {"left": -0.01, "right": 0.01, "page down": -0.1, "page up": 0.1}  # fractions of the joint's range


class Sliders:
    """The free joints of a robot; one of them is selected."""

    def __init__(self) -> None:
        self.selected = 0

    def press(self, key: str, states: JointStates) -> bool:
        """Handle a key.

        Returns:
            False if the key ends the program.
        """
        joints = list(states.free.values())
        if key == "q":
            return False
        if not joints:
            return True
        self.selected = min(self.selected, len(joints) - 1)
        joint = joints[self.selected]
        if key in {"up", "down"}:
            self.selected = (self.selected + (1 if key == "down" else -1)) % len(joints)
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
                each.position = random.uniform(each.lower, each.upper)  # noqa: S311 - not a secret
        return True

    def table(self, states: JointStates, height: int) -> Table:
        """Return a table of at most ``height`` joints around the selected one."""
        names = list(states.free)
        self.selected = min(self.selected, max(len(names) - 1, 0))
        first = max(0, min(self.selected - height // 2, len(names) - height))
        table = Table(box=None, padding=(0, 1, 0, 0), pad_edge=False, show_header=False)
        for name in names[first : first + height]:
            joint = states.free[name]
            is_selected = name == names[self.selected]
            table.add_row(
                Text(">" if is_selected else " "),
                Text(display_name(name), style="bold" if is_selected else "", no_wrap=True),
                Text(f"{joint.lower:8.3f}", style="dim"),
                Text(_bar(joint), style="cyan" if is_selected else ""),
                Text(f"{joint.upper:.3f}", style="dim"),
                Text(f"{_position(joint):8.3f}"),
            )
        return table


def _position(joint: FreeJoint) -> float:
    return joint.zero if joint.position is None else joint.position


def _bar(joint: FreeJoint) -> str:
    extent = joint.upper - joint.lower
    fraction = (_position(joint) - joint.lower) / extent if extent > 0.0 else 0.0
    column = round(min(max(fraction, 0.0), 1.0) * (_WIDTH - 1))
    return "─" * column + "●" + "─" * (_WIDTH - 1 - column)
