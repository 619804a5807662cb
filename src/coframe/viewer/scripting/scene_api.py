# SPDX-License-Identifier: Apache-2.0
"""`Viewer.scene`: draws objects of a program in the scene, next to the frames and the topics."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from coframe._output.formatting import did_you_mean, join_quoted
from coframe.time import stamp_ns
from coframe.viewer.scripting import _arguments
from coframe.viewer.scripting._colors import parse_color
from coframe.viewer.scripting._geometry import (
    box_mesh,
    image_geometry,
    lines_geometry,
    mesh_geometry,
    points_geometry,
    sphere_mesh,
)
from coframe.viewer.scripting.errors import SceneError
from coframe.viewer.scripting.node_handles import (
    FrameHandle,
    ImageHandle,
    LinesHandle,
    MeshHandle,
    NodeHandle,
    PointsHandle,
    TextHandle,
)
from coframe.viewer.scripting.nodes import IDENTITY, NodeRecord

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike
    from typing_extensions import TypedDict, Unpack

    from coframe.buffer import Buffer
    from coframe.time import StampLike
    from coframe.transform.transform import Transform
    from coframe.viewer.protocol.common import NodeKind, Pose
    from coframe.viewer.scripting.nodes import NodeStore

    class Placement(TypedDict, total=False):
        """The place and time at which a node is drawn. See :class:`SceneApi`."""

        frame: str | None
        pose: Transform | None
        position: ArrayLike | None
        quaternion: ArrayLike | None
        visible: bool
        time: StampLike | None


__all__ = ["SceneApi"]

HandleT = TypeVar("HandleT", bound=NodeHandle)

_PLACEMENT = ("frame", "pose", "position", "quaternion", "visible", "time")
_POINT_SIZE, _LINE_WIDTH, _AXES_LENGTH, _TEXT_HEIGHT, _IMAGE_WIDTH = 0.02, 2.0, 0.5, 0.15, 1.0


class SceneApi:
    """Draws points, lines, meshes, text, images and axes in the scene. Any thread may use it.

    Names are paths: ``mount/cloud`` is below ``mount``, moves with it, and is hidden and removed with it. Adding a name
    again replaces the node. All pages show the same nodes, including those that are opened later.

    Every ``add_`` method also takes:

    - ``frame``: a frame of the tree, with which the node moves; "" is the fixed frame of each page. By default the node
      is in the node above it by its name, and in the fixed frame if there is none.
    - ``pose``: a :class:`coframe.Transform` from the node to the frame; a target frame in it is the ``frame``.
      Alternatively ``position``, (3,), in meters, and ``quaternion``, (4,), as **x, y, z, w**, the order of ROS.
    - ``visible``: False hides the node.
    - ``time``: a stamp from which the node is shown instead of earlier ones with its name; see
      :func:`coframe.time.stamp_ns`.

    Colors are integers from 0 to 255, floats from 0 to 1, or a string such as ``"#ff8000"``.

    All methods raise :class:`SceneError`, a ValueError, whose message begins with the name of the invalid argument. On
    a live graph, a node waits until its frame exists.

    Args:
        store: All nodes.
        complete_buffer: Return the buffer that contains all frames, or None if others may appear at any time.
    """

    def __init__(self, store: NodeStore, complete_buffer: Callable[[], Buffer | None]) -> None:
        self._store = store
        self._complete_buffer = complete_buffer

    @property
    def names(self) -> list[str]:
        """The names of all nodes, in alphabetical order."""
        return self._store.names()

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name.strip("/") in self.names

    def add_frame(self, name: str, *, axes_length: float = _AXES_LENGTH, **placement: Unpack[Placement]) -> FrameHandle:
        """Draw axes: x red, y green, z blue.

        Args:
            name: Unique name of the node, such as "camera/cloud".
            axes_length: The length of the axes in meters; 0 draws none, for a node that only carries others.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.
        """
        size = _arguments.number_of(axes_length, "axes_length", 0.0, _arguments.MAX_COORDINATE)
        return self._add(FrameHandle, "frame", name, placement, size=size)

    def add_points(
        self,
        name: str,
        points: ArrayLike,
        colors: ArrayLike | None = None,
        *,
        color: ArrayLike | str | None = None,
        point_size: float = _POINT_SIZE,
        opacity: float = 1.0,
        **placement: Unpack[Placement],
    ) -> PointsHandle:
        """Draw a point cloud.

        Args:
            name: Unique name of the node, such as "camera/cloud".
            points: Positions in meters, (N, 3).
            colors: A color for each point, (N, 3) or (N, 4).
            color: The color of all points, (3,), if ``colors`` is None.
            point_size: The diameter of the points in meters; a point is at least 1.5 pixels wide.
            opacity: From 0 to 1.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.

        Example:
            >>> import coframe
            >>> buffer = coframe.Buffer()
            >>> _ = buffer.set("map", "base_link", coframe.Transform([1.0, 0.0, 0.0]), static=True)
            >>> with coframe.show(buffer, port=0) as viewer:
            ...     cloud = viewer.scene.add_points("cloud", [[0, 0, 0], [1, 0, 0]], frame="base_link")
            ...     cloud.points = [[0, 0, 1], [1, 0, 1], [2, 0, 1]]
            ...     cloud.points.shape
            (3, 3)
        """
        return self._add(
            PointsHandle,
            "points",
            name,
            placement,
            geometry=points_geometry(points, colors),
            color=parse_color(color),
            size=_arguments.number_of(point_size, "point_size", 0.0, _arguments.MAX_COORDINATE),
            opacity=_arguments.number_of(opacity, "opacity", 0.0, 1.0),
        )

    def add_lines(
        self,
        name: str,
        points: ArrayLike,
        colors: ArrayLike | None = None,
        *,
        color: ArrayLike | str | None = None,
        line_width: float = _LINE_WIDTH,
        opacity: float = 1.0,
        **placement: Unpack[Placement],
    ) -> LinesHandle:
        """Draw lines.

        Args:
            name: Unique name of the node, such as "camera/cloud".
            points: Both ends of each line in meters, (N, 2, 3), or the points of one line, (N, 3).
            colors: A color for each point, of the same shape as ``points``.
            color: The color of all lines, (3,), if ``colors`` is None.
            line_width: The width in pixels.
            opacity: From 0 to 1.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.
        """
        return self._add(
            LinesHandle,
            "lines",
            name,
            placement,
            geometry=lines_geometry(points, colors),
            color=parse_color(color),
            size=_arguments.number_of(line_width, "line_width", 0.1, 100.0),
            opacity=_arguments.number_of(opacity, "opacity", 0.0, 1.0),
        )

    def add_mesh(
        self,
        name: str,
        vertices: Any,
        faces: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        *,
        color: ArrayLike | str | None = None,
        opacity: float = 1.0,
        wireframe: bool = False,
        **placement: Unpack[Placement],
    ) -> MeshHandle:
        """Draw a triangle mesh. Both sides of the triangles are drawn.

        Args:
            name: Unique name of the node, such as "camera/cloud".
            vertices: Positions in meters, (V, 3), or an object with the attributes ``vertices`` and ``faces``, such as
                a mesh of the package trimesh.
            faces: The indices of the vertices of each triangle, (F, 3).
            colors: A color for each vertex, (V, 3) or (V, 4).
            color: The color of the mesh, (3,), if ``colors`` is None.
            opacity: From 0 to 1.
            wireframe: Draw only the edges of the triangles.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.
        """
        if faces is None:
            if not (hasattr(vertices, "vertices") and hasattr(vertices, "faces")):
                raise SceneError("faces: a mesh needs the indices of the vertices of each triangle, (F, 3)")
            vertices, faces = vertices.vertices, vertices.faces
        return self._add(
            MeshHandle,
            "mesh",
            name,
            placement,
            geometry=mesh_geometry(vertices, faces, colors),
            color=parse_color(color),
            opacity=_arguments.number_of(opacity, "opacity", 0.0, 1.0),
            wireframe=_arguments.parse_flag(wireframe, "wireframe"),
        )

    def add_box(
        self,
        name: str,
        size: ArrayLike = (1.0, 1.0, 1.0),
        *,
        color: ArrayLike | str | None = None,
        opacity: float = 1.0,
        **placement: Unpack[Placement],
    ) -> MeshHandle:
        """Draw a box. Its center is at the pose.

        Args:
            name: Unique name of the node, such as "camera/cloud".
            size: The lengths along x, y and z in meters, (3,).
            color: The color, (3,).
            opacity: From 0 to 1.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.
        """
        vertices, faces = box_mesh(_arguments.parse_vector(size, "size"))
        return self.add_mesh(name, vertices, faces, color=color, opacity=opacity, **placement)

    def add_sphere(
        self,
        name: str,
        radius: float | ArrayLike = 0.1,
        *,
        color: ArrayLike | str | None = None,
        opacity: float = 1.0,
        **placement: Unpack[Placement],
    ) -> MeshHandle:
        """Draw a sphere or an ellipsoid. Its center is at the pose.

        Args:
            name: Unique name of the node, such as "camera/cloud".
            radius: The radius in meters; (3,) draws an ellipsoid with these radii along x, y and z, such as that of
                :meth:`coframe.Transform.ellipsoid`.
            color: The color, (3,).
            opacity: From 0 to 1.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.
        """
        vertices, faces = sphere_mesh(_arguments.parse_radii(radius))
        return self.add_mesh(name, vertices, faces, color=color, opacity=opacity, **placement)

    def add_text(
        self,
        name: str,
        text: str,
        *,
        color: ArrayLike | str | None = None,
        height: float = _TEXT_HEIGHT,
        opacity: float = 1.0,
        **placement: Unpack[Placement],
    ) -> TextHandle:
        """Draw text that faces the camera, on top of everything else. Its center is at the pose.

        Args:
            name: Unique name of the node, such as "camera/cloud".
            text: The text; it may have several lines.
            color: The color, (3,), or None for the color of the labels of frames.
            height: The height of a line in meters.
            opacity: From 0 to 1.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.
        """
        return self._add(
            TextHandle,
            "text",
            name,
            placement,
            text=_arguments.parse_text(text, "text"),
            color=parse_color(color),
            size=_arguments.number_of(height, "height", 0.0, _arguments.MAX_COORDINATE),
            opacity=_arguments.number_of(opacity, "opacity", 0.0, 1.0),
        )

    def add_image(
        self,
        name: str,
        image: ArrayLike,
        width: float = _IMAGE_WIDTH,
        *,
        opacity: float = 1.0,
        **placement: Unpack[Placement],
    ) -> ImageHandle:
        """Draw an image on a rectangle, whose center is at the pose.

        The axis x of the node points to the right of the image and y to its lower edge, as in the optical frame of a
        camera (REP 103).

        Args:
            name: Unique name of the node, such as "camera/cloud".
            image: Pixels, (height, width) or (height, width, 3 or 4).
            width: The width of the rectangle in meters; its height follows from the shape of the image.
            opacity: From 0 to 1.
            **placement: ``frame``, ``pose``, ``position``, ``quaternion``, ``visible``, ``time``; see the class.

        Raises:
            SceneError: An argument is invalid.
        """
        return self._add(
            ImageHandle,
            "image",
            name,
            placement,
            geometry=image_geometry(image),
            size=_arguments.number_of(width, "width", 0.0, _arguments.MAX_COORDINATE),
            opacity=_arguments.number_of(opacity, "opacity", 0.0, 1.0),
        )

    def remove(self, name: str) -> None:
        """Remove the nodes with a name and everything below them.

        Raises:
            SceneError: There is no such node.
        """
        self._store.remove_name(_arguments.parse_name(name))

    def reset(self) -> None:
        """Remove all nodes."""
        self._store.reset()

    def _add(
        self, make_handle: type[HandleT], kind: NodeKind, name: str, placement: Placement, **fields: Any
    ) -> HandleT:
        for key in placement:
            if key not in _PLACEMENT:
                raise TypeError(
                    f"add_{kind}() has no argument {key!r}. Arguments of all nodes: {', '.join(_PLACEMENT)}."
                )
        time = placement.get("time")
        record = NodeRecord(
            id=self._store.next_id(),
            version=0,
            name=_arguments.parse_name(name),
            kind=kind,
            frame=self._frame(placement),
            pose=_pose(placement),
            time=None if time is None else _stamp(time),
            visible=_arguments.parse_flag(placement.get("visible", True), "visible"),
            **fields,
        )
        return make_handle(self._store, self._store.add(record).id, self._check_frame)

    def _frame(self, placement: Placement) -> str | None:
        frame, pose = placement.get("frame"), placement.get("pose")
        target = None if pose is None else getattr(pose, "target", None)
        if frame is not None and target is not None and frame != target:
            raise SceneError(f"frame: {frame!r} differs from the target frame of the pose, {target!r}")
        chosen = frame if frame is not None else target
        return None if chosen is None else self._check_frame(chosen)

    def _check_frame(self, frame: Any) -> str:
        name = _arguments.parse_text(frame, "frame").removeprefix("/")
        buffer = self._complete_buffer()
        if name and buffer is not None and name not in buffer:
            known = sorted(buffer.frame_names())
            frames = f"Known frames: {join_quoted(known)}." if known else "There are no frames yet."
            raise SceneError(f"frame: no frame named {name!r}", hint=f"{did_you_mean(name, known)} {frames}".strip())
        return name


def _pose(placement: Placement) -> Pose:
    pose, position, quaternion = placement.get("pose"), placement.get("position"), placement.get("quaternion")
    if pose is None:
        x, y, z = IDENTITY[:3] if position is None else _arguments.parse_vector(position, "position")
        return x, y, z, *(IDENTITY[3:] if quaternion is None else _arguments.parse_quaternion(quaternion))
    if position is not None or quaternion is not None:
        raise SceneError("pose: pass either pose, or position and quaternion")
    return _arguments.pose_of(pose)


def _stamp(time: StampLike) -> int:
    try:
        return stamp_ns(time)
    except (TypeError, ValueError) as error:
        raise SceneError(f"time: {error}") from None
