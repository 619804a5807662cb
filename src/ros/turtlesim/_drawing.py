# SPDX-License-Identifier: Apache-2.0
"""The simulation as markers for the viewer and its top view; published only while there is a subscription."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import Point, TransformStamped
from std_msgs.msg import ColorRGBA
from tf2_ros import StaticTransformBroadcaster
from turtlesim._canvas import METER, SIZE_IN_METERS, Canvas
from visualization_msgs.msg import Marker, MarkerArray

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rclpy.node import Node
    from turtlesim._turtle import Turtle

__all__ = ["Drawing"]

# The tf2 tutorials publish the turtles' poses in this frame.
_WORLD = "world"
_PERIOD = 0.1  # seconds
_GREEN, _DARK = (0.3, 0.65, 0.25), (0.2, 0.45, 0.2)


class Drawing:
    """Markers of the background, the lines and the turtles, on the topic ``~/markers``."""

    def __init__(self, node: Node, canvas: Canvas, turtles: dict[str, Turtle]) -> None:
        self._node = node
        self._canvas = canvas
        self._turtles = turtles
        self._markers = node.create_publisher(MarkerArray, "~/markers", 1)
        self._broadcaster: StaticTransformBroadcaster | None = None
        node.create_timer(_PERIOD, self._publish)

    def _publish(self) -> None:
        if self._markers.get_subscription_count() == 0:
            return
        if self._broadcaster is None:
            # The frame of the markers must exist, even if the user's nodes do not publish transforms. Its child is in
            # the middle of the picture, which is where the viewer looks first.
            self._broadcaster = StaticTransformBroadcaster(self._node)
            transform = TransformStamped(child_frame_id=self._node.get_name())
            transform.header.frame_id = _WORLD
            transform.header.stamp = self._node.get_clock().now().to_msg()
            transform.transform.translation.x = transform.transform.translation.y = SIZE_IN_METERS / 2
            self._broadcaster.sendTransform(transform)
        markers = [_marker("", 0, action=Marker.DELETEALL), self._background(), *self._lines()]
        for turtle in self._turtles.values():
            markers += _body(turtle)
        self._markers.publish(MarkerArray(markers=markers))

    def _background(self) -> Marker:
        color = tuple(self._node.get_parameter(f"background_{name}").value / 255 for name in "rgb")
        marker = _marker("background", 0, type=Marker.CUBE, color=_color(color))
        marker.pose.position = Point(x=SIZE_IN_METERS / 2, y=SIZE_IN_METERS / 2, z=-0.02)
        marker.scale.x = marker.scale.y = SIZE_IN_METERS
        marker.scale.z = 0.01
        return marker

    def _lines(self) -> Iterable[Marker]:
        for index, stroke in enumerate(self._canvas.strokes):
            color = _color((stroke.pen.r / 255, stroke.pen.g / 255, stroke.pen.b / 255))
            marker = _marker("lines", index, type=Marker.LINE_STRIP, color=color)
            marker.scale.x = stroke.pen.width / METER
            marker.points = [Point(x=x, y=SIZE_IN_METERS - y, z=0.0) for x, y in stroke.points]
            yield marker


def _body(turtle: Turtle) -> list[Marker]:
    """Return the shell, the head and the legs of a turtle, which is one meter long."""
    parts = [
        _part(turtle, 0, (0.0, 0.0), (0.7, 0.6, 0.3), _GREEN),
        _part(turtle, 1, (0.42, 0.0), (0.25, 0.2, 0.2), _DARK),
    ]
    legs = [(x, y) for x in (-0.25, 0.25) for y in (-0.28, 0.28)]
    return parts + [_part(turtle, 2 + index, leg, (0.22, 0.14, 0.1), _DARK) for index, leg in enumerate(legs)]


def _part(turtle: Turtle, number: int, place: tuple[float, float], size: tuple[float, ...], color: Any) -> Marker:
    marker = _marker(turtle.name, number, type=Marker.SPHERE, color=_color(color))
    cos, sin = math.cos(turtle.theta), math.sin(turtle.theta)
    marker.pose.position.x = turtle.x + cos * place[0] - sin * place[1]
    marker.pose.position.y = SIZE_IN_METERS - turtle.y + sin * place[0] + cos * place[1]
    marker.pose.position.z = 0.1
    marker.pose.orientation.z, marker.pose.orientation.w = math.sin(turtle.theta / 2), math.cos(turtle.theta / 2)
    marker.scale.x, marker.scale.y, marker.scale.z = size
    return marker


def _marker(namespace: str, number: int, **fields: Any) -> Marker:
    marker = Marker(ns=namespace, id=number, **fields)
    marker.header.frame_id = _WORLD  # A stamp of zero: at the latest time.
    return marker


def _color(rgb: Any) -> ColorRGBA:
    r, g, b = rgb
    return ColorRGBA(r=r, g=g, b=b, a=1.0)
