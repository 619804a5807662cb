# Written by scripts/generate_messages.py from interfaces/geometry_msgs/msg; do not edit.
"""geometry_msgs.msg"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

from coframe.messages.definition import Array, BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message
from coframe.messages.generated.std_msgs.msg import Header

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages.hints import NumberArray


class Vector3(Message):
    """A free vector: translating a frame does not move it."""

    ROS_TYPE = "geometry_msgs/msg/Vector3"
    __slots__ = ["_x", "_y", "_z"]
    SLOT_TYPES = (
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        x: float
        y: float
        z: float
        def __init__(self, *, x: float = ..., y: float = ..., z: float = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            if fields:
                self._assign(fields)


class Accel(Message):
    """Linear acceleration in m/s^2 and angular acceleration in rad/s^2."""

    ROS_TYPE = "geometry_msgs/msg/Accel"
    __slots__ = ["_linear", "_angular"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        linear: Vector3
        angular: Vector3
        def __init__(self, *, linear: Vector3 = ..., angular: Vector3 = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._linear = fields.get("linear") or Vector3()
            self._angular = fields.get("angular") or Vector3()
            if fields:
                self._assign(fields)


class AccelStamped(Message):
    """Message geometry_msgs/msg/AccelStamped."""

    ROS_TYPE = "geometry_msgs/msg/AccelStamped"
    __slots__ = ["_header", "_accel"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Accel'),
    )

    if TYPE_CHECKING:
        header: Header
        accel: Accel
        def __init__(self, *, header: Header = ..., accel: Accel = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._accel = fields.get("accel") or Accel()
            if fields:
                self._assign(fields)


class AccelWithCovariance(Message):
    """Message geometry_msgs/msg/AccelWithCovariance."""

    ROS_TYPE = "geometry_msgs/msg/AccelWithCovariance"
    __slots__ = ["_accel", "_covariance"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Accel'),
        Array(BasicType('double'), 36),
    )

    if TYPE_CHECKING:
        accel: Accel
        covariance = NumberArray[np.float64]()
        def __init__(self, *, accel: Accel = ..., covariance: Iterable[float] = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._accel = fields.get("accel") or Accel()
            self._covariance = np.zeros(36, np.float64)
            if fields:
                self._assign(fields)


class AccelWithCovarianceStamped(Message):
    """Message geometry_msgs/msg/AccelWithCovarianceStamped."""

    ROS_TYPE = "geometry_msgs/msg/AccelWithCovarianceStamped"
    __slots__ = ["_header", "_accel"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'AccelWithCovariance'),
    )

    if TYPE_CHECKING:
        header: Header
        accel: AccelWithCovariance
        def __init__(self, *, header: Header = ..., accel: AccelWithCovariance = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._accel = fields.get("accel") or AccelWithCovariance()
            if fields:
                self._assign(fields)


class Inertia(Message):
    """Mass in kg, centre of mass in m, inertia tensor in kg m^2."""

    ROS_TYPE = "geometry_msgs/msg/Inertia"
    __slots__ = ["_m", "_com", "_ixx", "_ixy", "_ixz", "_iyy", "_iyz", "_izz"]
    SLOT_TYPES = (
        BasicType('double'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        m: float
        com: Vector3
        ixx: float
        ixy: float
        ixz: float
        iyy: float
        iyz: float
        izz: float
        def __init__(self, *, m: float = ..., com: Vector3 = ..., ixx: float = ..., ixy: float = ..., ixz: float = ..., iyy: float = ..., iyz: float = ..., izz: float = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._m = 0.0
            self._com = fields.get("com") or Vector3()
            self._ixx = 0.0
            self._ixy = 0.0
            self._ixz = 0.0
            self._iyy = 0.0
            self._iyz = 0.0
            self._izz = 0.0
            if fields:
                self._assign(fields)


class InertiaStamped(Message):
    """Message geometry_msgs/msg/InertiaStamped."""

    ROS_TYPE = "geometry_msgs/msg/InertiaStamped"
    __slots__ = ["_header", "_inertia"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Inertia'),
    )

    if TYPE_CHECKING:
        header: Header
        inertia: Inertia
        def __init__(self, *, header: Header = ..., inertia: Inertia = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._inertia = fields.get("inertia") or Inertia()
            if fields:
                self._assign(fields)


class Point(Message):
    """A position in metres."""

    ROS_TYPE = "geometry_msgs/msg/Point"
    __slots__ = ["_x", "_y", "_z"]
    SLOT_TYPES = (
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        x: float
        y: float
        z: float
        def __init__(self, *, x: float = ..., y: float = ..., z: float = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            if fields:
                self._assign(fields)


class Point32(Message):
    """A position in metres, in single precision."""

    ROS_TYPE = "geometry_msgs/msg/Point32"
    __slots__ = ["_x", "_y", "_z"]
    SLOT_TYPES = (
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
    )

    if TYPE_CHECKING:
        x: float
        y: float
        z: float
        def __init__(self, *, x: float = ..., y: float = ..., z: float = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            if fields:
                self._assign(fields)


class PointStamped(Message):
    """Message geometry_msgs/msg/PointStamped."""

    ROS_TYPE = "geometry_msgs/msg/PointStamped"
    __slots__ = ["_header", "_point"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Point'),
    )

    if TYPE_CHECKING:
        header: Header
        point: Point
        def __init__(self, *, header: Header = ..., point: Point = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._point = fields.get("point") or Point()
            if fields:
                self._assign(fields)


class Polygon(Message):
    """Message geometry_msgs/msg/Polygon."""

    ROS_TYPE = "geometry_msgs/msg/Polygon"
    __slots__ = ["_points"]
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Point32')),
    )

    if TYPE_CHECKING:
        points: list[Point32]
        def __init__(self, *, points: list[Point32] = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._points = []
            if fields:
                self._assign(fields)


class PolygonStamped(Message):
    """Message geometry_msgs/msg/PolygonStamped."""

    ROS_TYPE = "geometry_msgs/msg/PolygonStamped"
    __slots__ = ["_header", "_polygon"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Polygon'),
    )

    if TYPE_CHECKING:
        header: Header
        polygon: Polygon
        def __init__(self, *, header: Header = ..., polygon: Polygon = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._polygon = fields.get("polygon") or Polygon()
            if fields:
                self._assign(fields)


class Quaternion(Message):
    """A rotation as a unit quaternion; the default is no rotation."""

    ROS_TYPE = "geometry_msgs/msg/Quaternion"
    __slots__ = ["_x", "_y", "_z", "_w"]
    SLOT_TYPES = (
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
    )
    X__DEFAULT: Final = 0.0
    Y__DEFAULT: Final = 0.0
    Z__DEFAULT: Final = 0.0
    W__DEFAULT: Final = 1.0

    if TYPE_CHECKING:
        x: float
        y: float
        z: float
        w: float
        def __init__(self, *, x: float = ..., y: float = ..., z: float = ..., w: float = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            self._w = 1.0
            if fields:
                self._assign(fields)


class Pose(Message):
    """A position and an orientation."""

    ROS_TYPE = "geometry_msgs/msg/Pose"
    __slots__ = ["_position", "_orientation"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Point'),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
    )

    if TYPE_CHECKING:
        position: Point
        orientation: Quaternion
        def __init__(self, *, position: Point = ..., orientation: Quaternion = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._position = fields.get("position") or Point()
            self._orientation = fields.get("orientation") or Quaternion()
            if fields:
                self._assign(fields)


class Pose2D(Message):
    """Message geometry_msgs/msg/Pose2D."""

    ROS_TYPE = "geometry_msgs/msg/Pose2D"
    __slots__ = ["_x", "_y", "_theta"]
    SLOT_TYPES = (
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        x: float
        y: float
        theta: float
        def __init__(self, *, x: float = ..., y: float = ..., theta: float = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._theta = 0.0
            if fields:
                self._assign(fields)


class PoseArray(Message):
    """Message geometry_msgs/msg/PoseArray."""

    ROS_TYPE = "geometry_msgs/msg/PoseArray"
    __slots__ = ["_header", "_poses"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Pose')),
    )

    if TYPE_CHECKING:
        header: Header
        poses: list[Pose]
        def __init__(self, *, header: Header = ..., poses: list[Pose] = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._poses = []
            if fields:
                self._assign(fields)


class PoseStamped(Message):
    """A pose in the frame and at the time of its header."""

    ROS_TYPE = "geometry_msgs/msg/PoseStamped"
    __slots__ = ["_header", "_pose"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
    )

    if TYPE_CHECKING:
        header: Header
        pose: Pose
        def __init__(self, *, header: Header = ..., pose: Pose = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._pose = fields.get("pose") or Pose()
            if fields:
                self._assign(fields)


class PoseWithCovariance(Message):
    """A pose and its 6x6 covariance, row by row: x, y, z and the rotations about X, Y, Z."""

    ROS_TYPE = "geometry_msgs/msg/PoseWithCovariance"
    __slots__ = ["_pose", "_covariance"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
        Array(BasicType('double'), 36),
    )

    if TYPE_CHECKING:
        pose: Pose
        covariance = NumberArray[np.float64]()
        def __init__(self, *, pose: Pose = ..., covariance: Iterable[float] = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._pose = fields.get("pose") or Pose()
            self._covariance = np.zeros(36, np.float64)
            if fields:
                self._assign(fields)


class PoseWithCovarianceStamped(Message):
    """Message geometry_msgs/msg/PoseWithCovarianceStamped."""

    ROS_TYPE = "geometry_msgs/msg/PoseWithCovarianceStamped"
    __slots__ = ["_header", "_pose"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'PoseWithCovariance'),
    )

    if TYPE_CHECKING:
        header: Header
        pose: PoseWithCovariance
        def __init__(self, *, header: Header = ..., pose: PoseWithCovariance = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._pose = fields.get("pose") or PoseWithCovariance()
            if fields:
                self._assign(fields)


class QuaternionStamped(Message):
    """Message geometry_msgs/msg/QuaternionStamped."""

    ROS_TYPE = "geometry_msgs/msg/QuaternionStamped"
    __slots__ = ["_header", "_quaternion"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
    )

    if TYPE_CHECKING:
        header: Header
        quaternion: Quaternion
        def __init__(self, *, header: Header = ..., quaternion: Quaternion = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._quaternion = fields.get("quaternion") or Quaternion()
            if fields:
                self._assign(fields)


class Transform(Message):
    """Rotation, then translation: takes points of a child frame to its parent."""

    ROS_TYPE = "geometry_msgs/msg/Transform"
    __slots__ = ["_translation", "_rotation"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
    )

    if TYPE_CHECKING:
        translation: Vector3
        rotation: Quaternion
        def __init__(self, *, translation: Vector3 = ..., rotation: Quaternion = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._translation = fields.get("translation") or Vector3()
            self._rotation = fields.get("rotation") or Quaternion()
            if fields:
                self._assign(fields)


class TransformStamped(Message):
    """The transform from child_frame_id to the frame of the header."""

    ROS_TYPE = "geometry_msgs/msg/TransformStamped"
    __slots__ = ["_header", "_child_frame_id", "_transform"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedString(),
        NamespacedType(('geometry_msgs', 'msg'), 'Transform'),
    )

    if TYPE_CHECKING:
        header: Header
        child_frame_id: str
        transform: Transform
        def __init__(self, *, header: Header = ..., child_frame_id: str = ..., transform: Transform = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._child_frame_id = ""
            self._transform = fields.get("transform") or Transform()
            if fields:
                self._assign(fields)


class Twist(Message):
    """Linear velocity in m/s and angular velocity in rad/s."""

    ROS_TYPE = "geometry_msgs/msg/Twist"
    __slots__ = ["_linear", "_angular"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        linear: Vector3
        angular: Vector3
        def __init__(self, *, linear: Vector3 = ..., angular: Vector3 = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._linear = fields.get("linear") or Vector3()
            self._angular = fields.get("angular") or Vector3()
            if fields:
                self._assign(fields)


class TwistStamped(Message):
    """Message geometry_msgs/msg/TwistStamped."""

    ROS_TYPE = "geometry_msgs/msg/TwistStamped"
    __slots__ = ["_header", "_twist"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Twist'),
    )

    if TYPE_CHECKING:
        header: Header
        twist: Twist
        def __init__(self, *, header: Header = ..., twist: Twist = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._twist = fields.get("twist") or Twist()
            if fields:
                self._assign(fields)


class TwistWithCovariance(Message):
    """A twist and its 6x6 covariance, row by row: linear x, y, z, angular x, y, z."""

    ROS_TYPE = "geometry_msgs/msg/TwistWithCovariance"
    __slots__ = ["_twist", "_covariance"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Twist'),
        Array(BasicType('double'), 36),
    )

    if TYPE_CHECKING:
        twist: Twist
        covariance = NumberArray[np.float64]()
        def __init__(self, *, twist: Twist = ..., covariance: Iterable[float] = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._twist = fields.get("twist") or Twist()
            self._covariance = np.zeros(36, np.float64)
            if fields:
                self._assign(fields)


class TwistWithCovarianceStamped(Message):
    """Message geometry_msgs/msg/TwistWithCovarianceStamped."""

    ROS_TYPE = "geometry_msgs/msg/TwistWithCovarianceStamped"
    __slots__ = ["_header", "_twist"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'TwistWithCovariance'),
    )

    if TYPE_CHECKING:
        header: Header
        twist: TwistWithCovariance
        def __init__(self, *, header: Header = ..., twist: TwistWithCovariance = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._twist = fields.get("twist") or TwistWithCovariance()
            if fields:
                self._assign(fields)


class Vector3Stamped(Message):
    """Message geometry_msgs/msg/Vector3Stamped."""

    ROS_TYPE = "geometry_msgs/msg/Vector3Stamped"
    __slots__ = ["_header", "_vector"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        header: Header
        vector: Vector3
        def __init__(self, *, header: Header = ..., vector: Vector3 = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._vector = fields.get("vector") or Vector3()
            if fields:
                self._assign(fields)


class Wrench(Message):
    """Force in N and torque in N m."""

    ROS_TYPE = "geometry_msgs/msg/Wrench"
    __slots__ = ["_force", "_torque"]
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        force: Vector3
        torque: Vector3
        def __init__(self, *, force: Vector3 = ..., torque: Vector3 = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._force = fields.get("force") or Vector3()
            self._torque = fields.get("torque") or Vector3()
            if fields:
                self._assign(fields)


class WrenchStamped(Message):
    """Message geometry_msgs/msg/WrenchStamped."""

    ROS_TYPE = "geometry_msgs/msg/WrenchStamped"
    __slots__ = ["_header", "_wrench"]
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Wrench'),
    )

    if TYPE_CHECKING:
        header: Header
        wrench: Wrench
        def __init__(self, *, header: Header = ..., wrench: Wrench = ...) -> None: ...
    else:
        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._wrench = fields.get("wrench") or Wrench()
            if fields:
                self._assign(fields)
