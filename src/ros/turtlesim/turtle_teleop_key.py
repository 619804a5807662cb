# SPDX-License-Identifier: Apache-2.0
"""A node that drives turtle1 with the keys of a terminal."""

from __future__ import annotations

import sys
from typing import Any

import rclpy
from coframe._process.keys import keys
from coframe.nodes.program import initialize_rclpy, program
from geometry_msgs.msg import Twist
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from turtlesim._interfaces import RotateAbsolute

__all__ = ["TeleopTurtle", "main"]

_INSTRUCTIONS = """Reading from keyboard
---------------------------
Use arrow keys to move the turtle.
Use G|B|V|C|D|E|R|T keys to rotate to absolute orientations. 'F' to cancel a rotation.
'Q' to quit."""
# Linear and angular velocity, in multiples of the parameters scale_linear and scale_angular.
_ARROWS = {"left": (0.0, 1.0), "right": (0.0, -1.0), "up": (1.0, 0.0), "down": (-1.0, 0.0)}
# Headings in radians: around the key F on the keyboard.
_HEADINGS = {
    "g": 0.0,
    "t": 0.7854,
    "r": 1.5708,
    "e": 2.3562,
    "d": 3.1416,
    "c": -2.3562,
    "v": -1.5708,
    "b": -0.7854,
}


class TeleopTurtle(Node):
    """Publishes velocities for arrow keys, and sends goals to the action rotate_absolute for letters."""

    def __init__(self) -> None:
        super().__init__("teleop_turtle")
        self.declare_parameter("scale_angular", 2.0)
        self.declare_parameter("scale_linear", 2.0)
        self.__commands = self.create_publisher(Twist, "turtle1/cmd_vel", 1)
        self.__rotate = ActionClient(self, RotateAbsolute, "turtle1/rotate_absolute")
        self.__goal: Any = None

    def press(self, key: str) -> bool:
        """Act on a key, and return False for the key that quits."""
        key = key.lower()
        if key in _ARROWS:
            linear, angular = _ARROWS[key]
            command = Twist()
            command.linear.x = self.get_parameter("scale_linear").value * linear
            command.angular.z = self.get_parameter("scale_angular").value * angular
            self.__commands.publish(command)
        elif key in _HEADINGS:
            sent = self.__rotate.send_goal_async(RotateAbsolute.Goal(theta=_HEADINGS[key]))
            sent.add_done_callback(self.__on_answer)
        elif key == "f" and self.__goal is not None:
            self.__goal.cancel_goal_async()
            self.__goal = None
        return key != "q"

    def __on_answer(self, sent: Any) -> None:
        self.__goal = sent.result() if sent.result().accepted else None


def _run(words: list[str], _arguments: list[str]) -> None:
    if not sys.stdin.isatty():
        sys.exit("turtle_teleop_key: the keys are read from a terminal, but the standard input is not one")
    try:
        with initialize_rclpy(words, None), keys() as pressed:
            node = TeleopTurtle()
            print(_INSTRUCTIONS)  # noqa: T201 - the program's own output
            while rclpy.ok():
                rclpy.spin_once(node, timeout_sec=0)
                key = pressed.read(0.02)
                if key is not None and not node.press(key):
                    return
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


def main(args: list[str] | None = None) -> None:
    """Run the console script."""
    program("turtle_teleop_key", args, _run)


if __name__ == "__main__":
    main()
