# SPDX-License-Identifier: Apache-2.0
"""Handles of nodes: assigning to a property updates all pages."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from coframe.transform.transform import Transform
from coframe.viewer.scripting import _arguments
from coframe.viewer.scripting._colors import parse_color, parse_vertex_colors
from coframe.viewer.scripting._geometry import (
    Geometry,
    image_geometry,
    lines_geometry,
    mesh_geometry,
    points_geometry,
)
from coframe.viewer.scripting.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

    from coframe.viewer.protocol.client_messages import ClickNode
    from coframe.viewer.scripting.nodes import NodeRecord, NodeStore

__all__ = [
    "ClickEvent",
    "FrameHandle",
    "ImageHandle",
    "LinesHandle",
    "MeshHandle",
    "NodeHandle",
    "PointsHandle",
    "TextHandle",
]

CallbackT = TypeVar("CallbackT", bound="Callable[[ClickEvent], object]")


@dataclass(frozen=True, eq=False)
class ClickEvent:
    """A click on a node, passed to the callbacks of :meth:`NodeHandle.on_click`.

    Attributes:
        target: The node.
        frame: The fixed frame of the page on which the user clicked.
        position: The point on the node's surface, expressed in ``frame``, in meters, (3,).
        local_position: The same point in the node's own coordinates, as in ``target.points``, (3,).
        index: The index of the point, the line or the triangle that was hit, or None for other kinds of nodes.
    """

    target: NodeHandle
    frame: str
    position: NDArray[np.float64]
    local_position: NDArray[np.float64]
    index: int | None


class NodeHandle:
    """A node of the scene; thread-safe.

    Args:
        store: All nodes.
        number: The id of the node.
        known_frame: Check the name of a frame.
    """

    def __init__(self, store: NodeStore, number: int, known_frame: Callable[[str], str]) -> None:
        self._store = store
        self._number = number
        self._known_frame = known_frame

    @property
    def name(self) -> str:
        """The name: a path without slashes at its ends."""
        return self._record.name

    @property
    def frame(self) -> str | None:
        """The frame in which the pose is expressed, or None for the node above this one, or else the fixed frame."""
        return self._record.frame

    @frame.setter
    def frame(self, value: str | None) -> None:
        self._update(frame=None if value is None else self._known_frame(value))

    @property
    def pose(self) -> Transform:
        """The pose. Assigning a transform whose target frame is set also changes :attr:`frame`."""
        record = self._record
        return Transform(record.pose[:3], record.pose[3:], target=record.frame or None)

    @pose.setter
    def pose(self, value: Transform) -> None:
        pose = _arguments.pose_of(value)
        frame = {} if value.target is None else {"frame": self._known_frame(value.target)}
        self._update(pose=pose, **frame)

    @property
    def position(self) -> NDArray[np.float64]:
        """The position in meters, (3,)."""
        return np.array(self._record.pose[:3])

    @position.setter
    def position(self, value: ArrayLike) -> None:
        position = _arguments.parse_vector(value, "position")
        with self._store.lock:
            self._update(pose=(*position, *self._record.pose[3:]))

    @property
    def quaternion(self) -> NDArray[np.float64]:
        """The rotation as x, y, z, w, (4,): the order of ROS, not the w, x, y, z of viser."""
        return np.array(self._record.pose[3:])

    @quaternion.setter
    def quaternion(self, value: ArrayLike) -> None:
        quaternion = _arguments.parse_quaternion(value)
        with self._store.lock:
            self._update(pose=(*self._record.pose[:3], *quaternion))

    @property
    def visible(self) -> bool:
        """Whether the node and everything below it is drawn."""
        return self._record.visible

    @visible.setter
    def visible(self, value: bool) -> None:
        self._update(visible=_arguments.parse_flag(value, "visible"))

    @property
    def is_removed(self) -> bool:
        """Whether the node was removed, or replaced by another one with its name."""
        return self._store.get(self._number) is None

    def on_click(self, callback: CallbackT) -> CallbackT:
        """Call a function with a :class:`ClickEvent` for each click on this node; usable as a decorator.

        Callbacks of one viewer run in a dedicated thread, one after another. Exceptions are logged.

        Raises:
            SceneError: The node was removed.
        """

        def report(click: ClickNode) -> None:
            position, local = np.array(click.position), np.array(click.local)
            callback(ClickEvent(self, click.frame, position, local, click.index))

        self._store.on_click(self._number, report)
        return callback

    def remove(self) -> None:
        """Remove the node with everything below it. Do nothing if it was removed before."""
        self._store.remove(self._number)

    def __repr__(self) -> str:
        record = self._store.get(self._number)
        kind = type(self).__name__
        return f"<{kind}, removed>" if record is None else f"<{kind} {record.name!r} in frame {record.frame!r}>"

    @property
    def _record(self) -> NodeRecord:
        record = self._store.get(self._number)
        if record is None:
            raise SceneError("this node was removed, or replaced by another one with its name")
        return record

    @property
    def _geometry(self) -> Geometry:
        geometry = self._record.geometry
        assert geometry is not None, "only axes and text have none"
        return geometry

    def _update(self, **fields: Any) -> None:
        self._store.update(self._number, **fields)


class FrameHandle(NodeHandle):
    """Axes. Other nodes can be placed below it."""

    @property
    def axes_length(self) -> float:
        """The length of the axes in meters; 0 draws none."""
        return self._record.size

    @axes_length.setter
    def axes_length(self, value: float) -> None:
        self._update(size=_arguments.number_of(value, "axes_length", 0.0, _arguments.MAX_COORDINATE))


class _ColoredHandle(NodeHandle):
    @property
    def color(self) -> NDArray[np.float64] | None:
        """Red, green and blue from 0 to 1, (3,); None for the default. Integers from 0 to 255 can also be assigned."""
        color = self._record.color
        return None if color is None else np.array(color)

    @color.setter
    def color(self, value: ArrayLike | str | None) -> None:
        self._update(color=parse_color(value))

    @property
    def opacity(self) -> float:
        """The opacity from 0 to 1."""
        return self._record.opacity

    @opacity.setter
    def opacity(self, value: float) -> None:
        self._update(opacity=_arguments.number_of(value, "opacity", 0.0, 1.0))


class _VertexColoredHandle(_ColoredHandle):
    @property
    def colors(self) -> NDArray[np.uint8] | None:
        """Red, green, blue and alpha from 0 to 255 of each point or vertex, (N, 4), or None if they have one color."""
        colors = self._geometry.colors
        return colors.copy() if len(colors) else None

    @colors.setter
    def colors(self, value: ArrayLike | None) -> None:
        with self._store.lock:
            geometry = self._geometry
            self._update(geometry=geometry._replace(colors=parse_vertex_colors(value, len(geometry.vertices))))

    def _keep_colors(self, geometry: Geometry) -> Geometry:
        """Return a geometry of new points with the colors of the present ones, whose number must be the same."""
        colors = self._geometry.colors
        if len(colors) and len(colors) != len(geometry.vertices):
            raise SceneError(
                f"points: {len(geometry.vertices)} points for {len(colors)} colors",
                hint="Use update(points, colors) to replace both.",
            )
        return geometry._replace(colors=colors)


class PointsHandle(_VertexColoredHandle):
    """A point cloud."""

    @property
    def points(self) -> NDArray[np.float64]:
        """The points in meters, (N, 3), with the precision of float32."""
        return self._geometry.positions

    @points.setter
    def points(self, value: ArrayLike) -> None:
        geometry = points_geometry(value, None)
        with self._store.lock:
            self._update(geometry=self._keep_colors(geometry))

    def update(self, points: ArrayLike, colors: ArrayLike | None = None) -> None:
        """Replace the points, (N, 3), and their colors, (N, 3); None draws them in one color.

        Raises:
            SceneError: An argument is invalid, or the node was removed.
        """
        self._update(geometry=points_geometry(points, colors))

    @property
    def point_size(self) -> float:
        """The diameter of the points in meters."""
        return self._record.size

    @point_size.setter
    def point_size(self, value: float) -> None:
        self._update(size=_arguments.number_of(value, "point_size", 0.0, _arguments.MAX_COORDINATE))


class LinesHandle(_VertexColoredHandle):
    """Lines."""

    @property
    def points(self) -> NDArray[np.float64]:
        """Both ends of each line in meters, (N, 2, 3), with the precision of float32."""
        return self._geometry.positions.reshape(-1, 2, 3)

    @points.setter
    def points(self, value: ArrayLike) -> None:
        geometry = lines_geometry(value, None)
        with self._store.lock:
            self._update(geometry=self._keep_colors(geometry))

    def update(self, points: ArrayLike, colors: ArrayLike | None = None) -> None:
        """Replace the points, (N, 2, 3) or (N, 3) for one line through all, and their colors, or None.

        Raises:
            SceneError: An argument is invalid, or the node was removed.
        """
        self._update(geometry=lines_geometry(points, colors))

    @property
    def line_width(self) -> float:
        """The width of the lines in pixels."""
        return self._record.size

    @line_width.setter
    def line_width(self, value: float) -> None:
        self._update(size=_arguments.number_of(value, "line_width", 0.1, 100.0))


class MeshHandle(_VertexColoredHandle):
    """A triangle mesh."""

    @property
    def vertices(self) -> NDArray[np.float64]:
        """The vertices in meters, (V, 3), with the precision of float32."""
        return self._geometry.positions

    @property
    def faces(self) -> NDArray[np.uint32]:
        """The indices of the vertices of each triangle, (F, 3)."""
        faces: NDArray[np.uint32] = self._geometry.indices.reshape(-1, 3).copy()
        return faces

    def update(self, vertices: ArrayLike, faces: ArrayLike, colors: ArrayLike | None = None) -> None:
        """Replace the triangles. See :meth:`SceneApi.add_mesh`.

        Raises:
            SceneError: An argument is invalid, or the node was removed.
        """
        self._update(geometry=mesh_geometry(vertices, faces, colors))

    @property
    def wireframe(self) -> bool:
        """Whether only the edges of the triangles are drawn."""
        return self._record.wireframe

    @wireframe.setter
    def wireframe(self, value: bool) -> None:
        self._update(wireframe=_arguments.parse_flag(value, "wireframe"))


class TextHandle(_ColoredHandle):
    """Text that faces the camera."""

    @property
    def text(self) -> str:
        """The text. It may have several lines."""
        return self._record.text

    @text.setter
    def text(self, value: str) -> None:
        self._update(text=_arguments.parse_text(value, "text"))

    @property
    def height(self) -> float:
        """The height of a line of text in meters."""
        return self._record.size

    @height.setter
    def height(self, value: float) -> None:
        self._update(size=_arguments.number_of(value, "height", 0.0, _arguments.MAX_COORDINATE))


class ImageHandle(NodeHandle):
    """An image on a rectangle."""

    @property
    def image(self) -> NDArray[np.uint8]:
        """The pixels, (height, width, 4): red, green, blue and alpha from 0 to 255."""
        geometry = self._geometry
        pixels: NDArray[np.uint8] = geometry.colors.reshape(-1, geometry.width, 4).copy()
        return pixels

    @image.setter
    def image(self, value: ArrayLike) -> None:
        self._update(geometry=image_geometry(value))

    @property
    def width(self) -> float:
        """The width of the rectangle in meters. Its height follows from the shape of the image."""
        return self._record.size

    @width.setter
    def width(self, value: float) -> None:
        self._update(size=_arguments.number_of(value, "width", 0.0, _arguments.MAX_COORDINATE))

    @property
    def opacity(self) -> float:
        """The opacity from 0 to 1."""
        return self._record.opacity

    @opacity.setter
    def opacity(self, value: float) -> None:
        self._update(opacity=_arguments.number_of(value, "opacity", 0.0, 1.0))
