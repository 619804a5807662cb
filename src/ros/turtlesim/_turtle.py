# SPDX-License-Identifier: Apache-2.0
"""One turtle: its topics, services and action, and its motion."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from geometry_msgs.msg import Twist
from rclpy.action import ActionServer, CancelResponse
from rclpy.duration import Duration
from rclpy.task import Future
from turtlesim._canvas import SIZE_IN_METERS, Canvas, Pen
from turtlesim._interfaces import Color, Pose, RotateAbsolute, SetPen, TeleportAbsolute, TeleportRelative

if TYPE_CHECKING:
    from rclpy.action.server import ServerGoalHandle
    from rclpy.node import Node

__all__ = ["MAX_VALUE", "Turtle", "is_in_range"]

_QUEUE = 7
_TOLERANCE = 0.02  # radians, at which a rotation is complete
_COMMAND_LIFETIME = Duration(seconds=1.0)
MAX_VALUE = 1e6  # meters or radians, and per second


class _Rotation(NamedTuple):
    """A goal of the action rotate_absolute, and the future that its result is set on."""

    handle: ServerGoalHandle
    done: Future[Any]
    start: float
    result: RotateAbsolute.Result

    def finish(self) -> None:
        """Send the result, after the state of the goal was set."""
        self.done.set_result(None)


class Turtle:
    """A turtle of the simulation.

    Attributes:
        x: Position to the right in meters.
        y: Position downwards in meters, from the upper edge, as the picture is stored.
        theta: Heading in radians, counterclockwise from the right.
    """

    def __init__(self, node: Node, name: str, x: float, y: float, theta: float) -> None:
        self.name = name
        self.x, self.y, self.theta = x, y, theta
        self._node = node
        self._pen: Pen | None = Pen()
        self._linear_x = self._linear_y = self._angular = 0.0
        self._teleports: list[TeleportAbsolute.Request | TeleportRelative.Request] = []
        self._rotation: _Rotation | None = None
        self._last_command = node.get_clock().now()
        self._poses = node.create_publisher(Pose, f"{name}/pose", _QUEUE)
        self._colors = node.create_publisher(Color, f"{name}/color_sensor", _QUEUE)
        self._commands = node.create_subscription(Twist, f"{name}/cmd_vel", self._on_command, _QUEUE)
        self._services = [
            node.create_service(SetPen, f"{name}/set_pen", self._set_pen),
            node.create_service(TeleportRelative, f"{name}/teleport_relative", self._teleport),
            node.create_service(TeleportAbsolute, f"{name}/teleport_absolute", self._teleport),
        ]
        self._action = ActionServer(
            node,
            RotateAbsolute,
            f"{name}/rotate_absolute",
            self._rotate,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    def destroy(self) -> None:
        """Remove the topics, services and the action."""
        if self._rotation is not None:
            self._rotation.handle.abort()
            self._rotation.finish()
            self._rotation = None
        self._action.destroy()
        for service in self._services:
            self._node.destroy_service(service)
        self._node.destroy_subscription(self._commands)
        self._node.destroy_publisher(self._poses)
        self._node.destroy_publisher(self._colors)

    def update(self, dt: float, canvas: Canvas) -> None:
        """Move by one step of time in seconds, draw, and publish pose and color."""
        for request in self._teleports:
            self._jump(request, canvas)
        self._teleports.clear()
        if self._rotation is not None:
            self._turn(self._rotation)
        if self._node.get_clock().now() - self._last_command > _COMMAND_LIFETIME:
            self._stop()
        before = (self.x, self.y)
        self._move(dt)
        self._publish(canvas)
        if (self.x, self.y) != before:
            self._draw(before, canvas)

    def _on_command(self, message: Twist) -> None:
        if not self._accepts("command", message.linear.x, message.linear.y, message.angular.z):
            return
        self._last_command = self._node.get_clock().now()
        self._linear_x, self._angular = message.linear.x, message.angular.z
        if self._node.get_parameter("holonomic").value:
            self._linear_y = message.linear.y

    def _set_pen(self, request: SetPen.Request, response: SetPen.Response) -> SetPen.Response:
        if request.off:
            self._pen = None
            return response
        self._pen = Pen(request.r, request.g, request.b, request.width or 1)  # Upstream's new pens are 1 pixel wide.
        return response

    def _teleport(self, request: Any, response: Any) -> Any:
        if self._accepts("teleport", *(getattr(request, name) for name in request.get_fields_and_field_types())):
            self._teleports.append(request)
        return response

    def _accepts(self, what: str, *values: float) -> bool:
        """Return whether all values are in range; log it if they are not."""
        accepted = is_in_range(*values)
        if not accepted:
            self._node.get_logger().error(
                f"Ignoring a {what} of [{self.name}]: the values {values} must be finite and at most {MAX_VALUE:g}"
            )
        return accepted

    def _jump(self, request: TeleportAbsolute.Request | TeleportRelative.Request, canvas: Canvas) -> None:
        before = (self.x, self.y)
        if isinstance(request, TeleportRelative.Request):
            self.theta += request.angular
            self.x += math.cos(self.theta) * request.linear
            self.y -= math.sin(self.theta) * request.linear
        else:
            self.x = request.x
            self.y = max(0.0, SIZE_IN_METERS - request.y)
            self.theta = request.theta
        self._draw(before, canvas)

    async def _rotate(self, handle: ServerGoalHandle) -> RotateAbsolute.Result:
        """Wait until `update` has completed the goal."""
        if not self._accepts("rotation", handle.request.theta):
            handle.abort()
            return RotateAbsolute.Result()
        if self._rotation is not None:
            self._node.get_logger().warning(
                "Rotation goal received before a previous goal finished. Aborting previous goal"
            )
            self._rotation.handle.abort()
            self._rotation.finish()
        rotation = _Rotation(handle, Future(), self.theta, RotateAbsolute.Result())
        self._rotation = rotation
        await rotation.done
        return rotation.result

    def _turn(self, rotation: _Rotation) -> None:
        if rotation.handle.is_cancel_requested:
            self._node.get_logger().info("Rotation goal canceled")
            rotation.handle.canceled()
            self._end_rotation(rotation)
            return
        remaining = _normalize_angle(_normalize_angle(rotation.handle.request.theta) - self.theta)
        rotation.result.delta = _normalize_angle(rotation.start - self.theta)
        rotation.handle.publish_feedback(RotateAbsolute.Feedback(remaining=remaining))
        if abs(remaining) < _TOLERANCE:
            self._node.get_logger().info("Rotation goal completed successfully")
            rotation.handle.succeed()
            self._end_rotation(rotation)
            return
        self._linear_x = self._linear_y = 0.0
        self._angular = -1.0 if remaining < 0 else 1.0
        self._last_command = self._node.get_clock().now()

    def _end_rotation(self, rotation: _Rotation) -> None:
        rotation.finish()
        self._rotation = None
        self._stop()

    def _stop(self) -> None:
        self._linear_x = self._linear_y = self._angular = 0.0

    def _move(self, dt: float) -> None:
        self.theta = _normalize_angle(self.theta + self._angular * dt)
        cos, sin = math.cos(self.theta), math.sin(self.theta)
        self.x += (cos * self._linear_x - sin * self._linear_y) * dt
        self.y -= (cos * self._linear_y + sin * self._linear_x) * dt
        if not (0 <= self.x <= SIZE_IN_METERS and 0 <= self.y <= SIZE_IN_METERS):
            self._node.get_logger().warning(f"Oh no! I hit the wall! (Clamping from [x={self.x:f}, y={self.y:f}])")
        self.x = min(max(self.x, 0.0), SIZE_IN_METERS)
        self.y = min(max(self.y, 0.0), SIZE_IN_METERS)

    def _draw(self, before: tuple[float, float], canvas: Canvas) -> None:
        if self._pen is not None:
            canvas.draw(self.name, self._pen, before, (self.x, self.y))

    def _publish(self, canvas: Canvas) -> None:
        self._poses.publish(
            Pose(
                x=self.x,
                y=SIZE_IN_METERS - self.y,
                theta=self.theta,
                linear_velocity=math.hypot(self._linear_x, self._linear_y),
                angular_velocity=self._angular,
            )
        )
        r, g, b = canvas.color(self.x, self.y)
        self._colors.publish(Color(r=r, g=g, b=b))


def is_in_range(*values: float) -> bool:
    """Return whether all values are finite and at most `MAX_VALUE`."""
    return all(abs(value) <= MAX_VALUE for value in values)  # False for NaN


def _normalize_angle(angle: float) -> float:
    return angle - math.tau * math.floor((angle + math.pi) / math.tau)
