# SPDX-License-Identifier: Apache-2.0
"""Publish velocities on ``cmd_vel`` for the keys that are pressed in a terminal."""

from __future__ import annotations

import sys
from typing import Any

import rclpy
from coframe._process.keys import keys
from coframe.nodes.program import initialize_rclpy, program
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

__all__ = ["TeleopTwistKeyboard", "main"]

_INSTRUCTIONS = """
This node takes keypresses from the keyboard and publishes them
as Twist/TwistStamped messages. It works best with a US keyboard layout.
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

For Holonomic mode (strafing), hold down the shift key:
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

anything else : stop

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%

CTRL-C to quit
"""
# Multiples of the speeds: x, y and z of the linear velocity, z of the angular velocity.
_MOVES = {
    "i": (1, 0, 0, 0),
    "o": (1, 0, 0, -1),
    "j": (0, 0, 0, 1),
    "l": (0, 0, 0, -1),
    "u": (1, 0, 0, 1),
    ",": (-1, 0, 0, 0),
    ".": (-1, 0, 0, 1),
    "m": (-1, 0, 0, -1),
    "O": (1, -1, 0, 0),
    "I": (1, 0, 0, 0),
    "J": (0, 1, 0, 0),
    "L": (0, -1, 0, 0),
    "U": (1, 1, 0, 0),
    "<": (-1, 0, 0, 0),
    ">": (-1, -1, 0, 0),
    "M": (-1, 1, 0, 0),
    "t": (0, 0, 1, 0),
    "b": (0, 0, -1, 0),
}
# Factors of the linear and of the angular speed.
_SPEEDS = {
    "q": (1.1, 1.1),
    "z": (0.9, 0.9),
    "w": (1.1, 1.0),
    "x": (0.9, 1.0),
    "e": (1.0, 1.1),
    "c": (1.0, 0.9),
}
_REMINDER = 15  # changes of the speed after which the instructions are printed again
_CTRL_C = "\x03"


class TeleopTwistKeyboard(Node):
    """Publishes a velocity for each key, with the parameters ``speed``, ``turn``, ``stamped`` and ``frame_id``."""

    def __init__(self) -> None:
        super().__init__("teleop_twist_keyboard")
        self.__speed: float = self.declare_parameter("speed", 0.5).value
        self.__turn: float = self.declare_parameter("turn", 1.0).value
        self.__is_stamped: bool = self.declare_parameter("stamped", False).value
        self.__frame_id: str = self.declare_parameter("frame_id", "").value
        kind: Any = TwistStamped if self.__is_stamped else Twist
        self.__publisher = self.create_publisher(kind, "cmd_vel", 10)
        self.__changes = 0

    @property
    def speeds(self) -> str:
        """The speeds as a line of text."""
        return f"currently:\tspeed {self.__speed}\tturn {self.__turn} "

    def press(self, key: str) -> str:
        """Publish the velocity of a key, and return what is to be printed."""
        factors = _SPEEDS.get(key)
        text = ""
        if factors is not None:
            self.__speed *= factors[0]
            self.__turn *= factors[1]
            self.__changes = (self.__changes + 1) % _REMINDER
            text = self.speeds if self.__changes else f"{self.speeds}\n{_INSTRUCTIONS}"
        self.publish(*(_MOVES.get(key, (0, 0, 0, 0)) if factors is None else (0, 0, 0, 0)))
        return text

    def publish(self, x: float, y: float, z: float, turn: float) -> None:
        """Publish a velocity in multiples of the speeds."""
        message: Any = TwistStamped() if self.__is_stamped else Twist()
        twist = message
        if self.__is_stamped:
            message.header.stamp = self.get_clock().now().to_msg()
            message.header.frame_id = self.__frame_id
            twist = message.twist
        twist.linear.x, twist.linear.y, twist.linear.z = x * self.__speed, y * self.__speed, z * self.__speed
        twist.angular.z = turn * self.__turn
        self.__publisher.publish(message)


def _run(words: list[str], _arguments: list[str]) -> None:
    if not sys.stdin.isatty():
        sys.exit("teleop_twist_keyboard: the keys are read from a terminal, but the standard input is not one")
    node = None
    with initialize_rclpy(words, None), keys() as pressed:
        try:
            node = TeleopTwistKeyboard()
            print(f"{_INSTRUCTIONS}\n{node.speeds}")  # noqa: T201 - the program's own output
            while rclpy.ok():
                rclpy.spin_once(node, timeout_sec=0)
                key = pressed.read(0.02)
                if key == _CTRL_C:
                    return
                if key is not None and (text := node.press(key)):
                    print(text)  # noqa: T201 - the program's own output
        except (KeyboardInterrupt, ExternalShutdownException):
            pass
        finally:
            if node is not None and rclpy.ok():
                node.publish(0, 0, 0, 0)


def main(args: list[str] | None = None) -> None:
    """Run the console script."""
    program("teleop_twist_keyboard", args, _run)


if __name__ == "__main__":
    main()
