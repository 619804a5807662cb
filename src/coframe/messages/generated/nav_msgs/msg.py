# Written by scripts/generate_messages.py from interfaces/nav_msgs/msg; do not edit.
"""Messages of nav_msgs."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any, Final

from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.builtin_interfaces.msg import Time
from coframe.messages.generated.geometry_msgs.msg import Accel, Point, Pose, PoseStamped, PoseWithCovariance, Twist, TwistWithCovariance, Wrench
from coframe.messages.generated.std_msgs.msg import Header

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberSequence


class Goals(Message):
    """Goal poses of a robot or of several robots."""

    ROS_TYPE = "nav_msgs/msg/Goals"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'PoseStamped')),
    )

    if TYPE_CHECKING:
        header: Header
        goals: list[PoseStamped]
        def __init__(self, *, header: Header = ..., goals: list[PoseStamped] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_goals"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._goals = []
            if fields:
                set_fields(self, fields)


class GridCells(Message):
    """Message nav_msgs/msg/GridCells."""

    ROS_TYPE = "nav_msgs/msg/GridCells"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('float'),
        BasicType('float'),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Point')),
    )

    if TYPE_CHECKING:
        header: Header
        cell_width: float
        cell_height: float
        cells: list[Point]
        def __init__(self, *, header: Header = ..., cell_width: float = ..., cell_height: float = ..., cells: list[Point] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_cell_width", "_cell_height", "_cells"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._cell_width = 0.0
            self._cell_height = 0.0
            self._cells = []
            if fields:
                set_fields(self, fields)


class MapMetaData(Message):
    """Message nav_msgs/msg/MapMetaData."""

    ROS_TYPE = "nav_msgs/msg/MapMetaData"
    SLOT_TYPES = (
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
        BasicType('float'),
        BasicType('uint32'),
        BasicType('uint32'),
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
    )

    if TYPE_CHECKING:
        map_load_time: Time
        resolution: float
        width: int
        height: int
        origin: Pose
        def __init__(self, *, map_load_time: Time = ..., resolution: float = ..., width: int = ..., height: int = ..., origin: Pose = ...) -> None: ...
    else:
        __slots__ = ["_map_load_time", "_resolution", "_width", "_height", "_origin"]

        def __init__(self, **fields: Any) -> None:
            self._map_load_time = fields.get("map_load_time") or Time()
            self._resolution = 0.0
            self._width = 0
            self._height = 0
            self._origin = fields.get("origin") or Pose()
            if fields:
                set_fields(self, fields)


class OccupancyGrid(Message):
    """Occupancy row by row from (0, 0): 0 free to 100 occupied, -1 unknown."""

    ROS_TYPE = "nav_msgs/msg/OccupancyGrid"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('nav_msgs', 'msg'), 'MapMetaData'),
        UnboundedSequence(BasicType('int8')),
    )

    if TYPE_CHECKING:
        header: Header
        info: MapMetaData
        data = NumberSequence[int]()
        def __init__(self, *, header: Header = ..., info: MapMetaData = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_info", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._info = fields.get("info") or MapMetaData()
            self._data = array("b")
            if fields:
                set_fields(self, fields)


class Odometry(Message):
    """Pose in the frame of the header, twist in child_frame_id."""

    ROS_TYPE = "nav_msgs/msg/Odometry"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedString(),
        NamespacedType(('geometry_msgs', 'msg'), 'PoseWithCovariance'),
        NamespacedType(('geometry_msgs', 'msg'), 'TwistWithCovariance'),
    )

    if TYPE_CHECKING:
        header: Header
        child_frame_id: str
        pose: PoseWithCovariance
        twist: TwistWithCovariance
        def __init__(self, *, header: Header = ..., child_frame_id: str = ..., pose: PoseWithCovariance = ..., twist: TwistWithCovariance = ...) -> None: ...
    else:
        __slots__ = ["_header", "_child_frame_id", "_pose", "_twist"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._child_frame_id = ""
            self._pose = fields.get("pose") or PoseWithCovariance()
            self._twist = fields.get("twist") or TwistWithCovariance()
            if fields:
                set_fields(self, fields)


class Path(Message):
    """Poses for a robot to follow."""

    ROS_TYPE = "nav_msgs/msg/Path"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'PoseStamped')),
    )

    if TYPE_CHECKING:
        header: Header
        poses: list[PoseStamped]
        def __init__(self, *, header: Header = ..., poses: list[PoseStamped] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_poses"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._poses = []
            if fields:
                set_fields(self, fields)


class TrajectoryPoint(Message):
    """The state of a robot at one time of a trajectory."""

    ROS_TYPE = "nav_msgs/msg/TrajectoryPoint"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
        NamespacedType(('geometry_msgs', 'msg'), 'Twist'),
        NamespacedType(('geometry_msgs', 'msg'), 'Accel'),
        NamespacedType(('geometry_msgs', 'msg'), 'Wrench'),
    )

    if TYPE_CHECKING:
        header: Header
        pose: Pose
        velocity: Twist
        acceleration: Accel
        effort: Wrench
        def __init__(self, *, header: Header = ..., pose: Pose = ..., velocity: Twist = ..., acceleration: Accel = ..., effort: Wrench = ...) -> None: ...
    else:
        __slots__ = ["_header", "_pose", "_velocity", "_acceleration", "_effort"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._pose = fields.get("pose") or Pose()
            self._velocity = fields.get("velocity") or Twist()
            self._acceleration = fields.get("acceleration") or Accel()
            self._effort = fields.get("effort") or Wrench()
            if fields:
                set_fields(self, fields)


class Trajectory(Message):
    """Poses, velocities and accelerations over time."""

    ROS_TYPE = "nav_msgs/msg/Trajectory"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(NamespacedType(('nav_msgs', 'msg'), 'TrajectoryPoint')),
    )

    if TYPE_CHECKING:
        header: Header
        points: list[TrajectoryPoint]
        def __init__(self, *, header: Header = ..., points: list[TrajectoryPoint] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_points"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._points = []
            if fields:
                set_fields(self, fields)
