# SPDX-License-Identifier: Apache-2.0
"""The turtle simulation of the ROS 2 tutorials: ``ros2 run turtlesim turtlesim_node``.

There is no window. The viewer (``coframe view``) shows the turtles and their lines.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._output.escaping import display_name, printable
from coframe.nodes.program import program, spin_until_shutdown
from rcl_interfaces.msg import IntegerRange, ParameterDescriptor
from rclpy.exceptions import NameValidationException
from rclpy.node import Node
from rclpy.validate_full_topic_name import validate_full_topic_name
from std_srvs.srv import Empty
from turtlesim._canvas import SIZE_IN_METERS, Canvas
from turtlesim._drawing import Drawing
from turtlesim._interfaces import Kill, Spawn
from turtlesim._turtle import MAX_VALUE, Turtle, is_in_range

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["TurtleSim", "main"]

MAX_TURTLES = 100
_MAX_NAME_LENGTH = 64  # with its namespace; the names of its services are longer
_STEP = 0.016  # seconds
_BACKGROUND = {"background_r": ("Red", 0x45), "background_g": ("Green", 0x56), "background_b": ("Blue", 0xFF)}


class TurtleSim(Node):
    """The node with all turtles."""

    def __init__(self, **options: Any) -> None:
        super().__init__("turtlesim", **options)
        for name, (color, value) in _BACKGROUND.items():
            self.declare_parameter(name, value, _color_descriptor(f"{color} channel of the background color"))
        self.declare_parameter(
            "holonomic", False, ParameterDescriptor(description="If true, then turtles will be holonomic")
        )
        self.__canvas = Canvas()
        self.__turtles: dict[str, Turtle] = {}
        self.__last_number = 0
        self.get_logger().info(f"Starting turtlesim with node name {self.get_fully_qualified_name()}")
        services: list[tuple[Any, str, Callable[..., Any]]] = [
            (Empty, "clear", self.__clear),
            (Empty, "reset", self.__reset),
            (Spawn, "spawn", self.__on_spawn),
            (Kill, "kill", self.__kill),
        ]
        for service, name, callback in services:
            self.create_service(service, name, callback)
        self.__spawn_in_the_middle()
        self.__drawing = Drawing(self, self.__canvas, self.__turtles)
        self.create_timer(_STEP, self.__update)

    def __update(self) -> None:
        for turtle in self.__turtles.values():
            turtle.update(_STEP, self.__canvas)

    def __spawn_in_the_middle(self) -> None:
        self.__spawn("", SIZE_IN_METERS / 2, SIZE_IN_METERS / 2, 0.0)

    def __spawn(self, name: str, x: float, y: float, theta: float) -> str:
        """Create a turtle, and return its name."""
        while not name or name in self.__turtles:
            self.__last_number += 1
            name = f"turtle{self.__last_number}"
        self.__turtles[name] = Turtle(self, name, x, SIZE_IN_METERS - y, theta)
        self.get_logger().info(f"Spawning turtle [{name}] at x=[{x:f}], y=[{y:f}], theta=[{theta:f}]")
        return name

    def __on_spawn(self, request: Spawn.Request, response: Spawn.Response) -> Spawn.Response:
        fault = self.__fault(request)
        if fault:
            self.get_logger().error(fault)
        else:
            response.name = self.__spawn(request.name, request.x, request.y, request.theta)
        return response

    def __fault(self, request: Spawn.Request) -> str:
        """Return why a turtle cannot be spawned, or "" if it can be."""
        if request.name in self.__turtles:
            return f"A turtle named [{display_name(request.name)}] already exists"
        if len(self.__turtles) >= MAX_TURTLES:
            return f"There are already {MAX_TURTLES} turtles, which is the maximum"
        if not is_in_range(request.x, request.y, request.theta):
            return f"The position and the angle of a turtle must be finite and at most {MAX_VALUE:g}"
        if len(request.name) > _MAX_NAME_LENGTH:
            return f"The name of a turtle has at most {_MAX_NAME_LENGTH} characters"
        try:
            if request.name:
                validate_full_topic_name(f"/{request.name}")
        except NameValidationException as error:
            return f"[{display_name(request.name)}] cannot be the name of a turtle: {printable(str(error))}"
        return ""

    def __kill(self, request: Kill.Request, response: Kill.Response) -> Kill.Response:
        turtle = self.__turtles.pop(request.name, None)
        if turtle is None:
            self.get_logger().error(f"Tried to kill turtle [{display_name(request.name)}], which does not exist")
        else:
            turtle.destroy()
        return response

    def __clear(self, _request: Empty.Request, response: Empty.Response) -> Empty.Response:
        self.get_logger().info("Clearing turtlesim.")
        self.__canvas.clear()
        return response

    def __reset(self, _request: Empty.Request, response: Empty.Response) -> Empty.Response:
        self.get_logger().info("Resetting turtlesim.")
        while self.__turtles:
            self.__turtles.popitem()[1].destroy()
        self.__last_number = 0
        self.__spawn_in_the_middle()
        self.__canvas.clear()
        return response


def _color_descriptor(description: str) -> ParameterDescriptor:
    channel = IntegerRange(from_value=0, to_value=255, step=1)
    return ParameterDescriptor(description=description, integer_range=[channel])


def main(args: list[str] | None = None) -> None:
    """Run the console script."""
    program("turtlesim_node", args, lambda words, _: spin_until_shutdown(TurtleSim, words, None))


if __name__ == "__main__":
    main()
