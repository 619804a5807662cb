# SPDX-License-Identifier: Apache-2.0
"""A node that lets turtle1 draw a square again and again."""

from __future__ import annotations

import math
from enum import Enum, auto
from typing import NamedTuple

from coframe.nodes.program import program, spin_until_shutdown
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_srvs.srv import Empty
from turtlesim._interfaces import Pose

__all__ = ["DrawSquare", "main"]

_SIDE = 2.0  # meters
_STOPPED = 0.0001  # m/s and rad/s


class _State(Enum):
    FORWARD = auto()
    STOP_FORWARD = auto()
    TURN = auto()
    STOP_TURN = auto()


class _Goal(NamedTuple):
    x: float
    y: float
    theta: float

    def has_reached(self, pose: Pose) -> bool:
        return abs(pose.x - self.x) < 0.1 and abs(pose.y - self.y) < 0.1 and abs(pose.theta - self.theta) < 0.01


class DrawSquare(Node):
    """Drives forward, turns by a quarter, and so on; stops before each change."""

    def __init__(self) -> None:
        super().__init__("draw_square")
        self.__pose: Pose | None = None
        self.__goal: _Goal | None = None
        self.__state = _State.FORWARD
        self.__commands = self.create_publisher(Twist, "turtle1/cmd_vel", 1)
        self.create_subscription(Pose, "turtle1/pose", self.__on_pose, 1)
        self.__reset = self.create_client(Empty, "reset")
        self.__reset.call_async(Empty.Request())
        self.create_timer(0.016, self.__step)

    def __on_pose(self, pose: Pose) -> None:
        self.__pose = pose

    def __step(self) -> None:
        pose = self.__pose
        if pose is None:
            return
        if self.__goal is None:
            self.__set_goal(_target_ahead(pose), _State.FORWARD)
        elif self.__state in {_State.FORWARD, _State.TURN}:
            self.__approach(self.__goal, pose)
        elif pose.linear_velocity >= _STOPPED or pose.angular_velocity >= _STOPPED:
            self.__command(0.0, 0.0)
        else:
            self.get_logger().info("Reached goal")
            if self.__state is _State.STOP_FORWARD:
                self.__set_goal(_target_turned(pose), _State.TURN)
            else:
                self.__set_goal(_target_ahead(pose), _State.FORWARD)

    def __approach(self, goal: _Goal, pose: Pose) -> None:
        forward = self.__state is _State.FORWARD
        if goal.has_reached(pose):
            self.__state = _State.STOP_FORWARD if forward else _State.STOP_TURN
            self.__command(0.0, 0.0)
        else:
            self.__command(*((1.0, 0.0) if forward else (0.0, 0.4)))

    def __set_goal(self, goal: _Goal, state: _State) -> None:
        self.__goal, self.__state = goal, state
        self.get_logger().info(f"New goal [{goal.x:f} {goal.y:f}, {goal.theta:f}]")

    def __command(self, linear: float, angular: float) -> None:
        command = Twist()
        command.linear.x, command.angular.z = linear, angular
        self.__commands.publish(command)


def _target_ahead(pose: Pose) -> _Goal:
    return _Goal(math.cos(pose.theta) * _SIDE + pose.x, math.sin(pose.theta) * _SIDE + pose.y, pose.theta)


def _target_turned(pose: Pose) -> _Goal:
    theta = math.fmod(pose.theta + math.pi / 2, math.tau)
    return _Goal(pose.x, pose.y, theta - math.tau if theta >= math.pi else theta)


def main(args: list[str] | None = None) -> None:
    """Run the console script."""
    program("draw_square", args, lambda words, _: spin_until_shutdown(DrawSquare, words, None))


if __name__ == "__main__":
    main()
