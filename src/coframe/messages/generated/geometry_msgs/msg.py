# Written by scripts/generate_messages.py from interfaces/geometry_msgs/msg; do not edit.
"""Messages of geometry_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import coframe.lazy_numpy as np
from coframe.messages.definition import Array, BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.std_msgs.msg import Header

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberArray


class Vector3(Message):
    """A free vector: translating a frame does not move it."""

    ROS_TYPE = "geometry_msgs/msg/Vector3"
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
        __slots__ = ["_x", "_y", "_z"]

        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            if fields:
                set_fields(self, fields)


class Accel(Message):
    """Linear acceleration in m/s^2 and angular acceleration in rad/s^2."""

    ROS_TYPE = "geometry_msgs/msg/Accel"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        linear: Vector3
        angular: Vector3
        def __init__(self, *, linear: Vector3 = ..., angular: Vector3 = ...) -> None: ...
    else:
        __slots__ = ["_linear", "_angular"]

        def __init__(self, **fields: Any) -> None:
            self._linear = fields.get("linear") or Vector3()
            self._angular = fields.get("angular") or Vector3()
            if fields:
                set_fields(self, fields)


class AccelStamped(Message):
    """Message geometry_msgs/msg/AccelStamped."""

    ROS_TYPE = "geometry_msgs/msg/AccelStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Accel'),
    )

    if TYPE_CHECKING:
        header: Header
        accel: Accel
        def __init__(self, *, header: Header = ..., accel: Accel = ...) -> None: ...
    else:
        __slots__ = ["_header", "_accel"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._accel = fields.get("accel") or Accel()
            if fields:
                set_fields(self, fields)


class AccelWithCovariance(Message):
    """Message geometry_msgs/msg/AccelWithCovariance."""

    ROS_TYPE = "geometry_msgs/msg/AccelWithCovariance"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Accel'),
        Array(BasicType('double'), 36),
    )

    if TYPE_CHECKING:
        accel: Accel
        covariance = NumberArray[np.float64]()
        def __init__(self, *, accel: Accel = ..., covariance: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_accel", "_covariance"]

        def __init__(self, **fields: Any) -> None:
            self._accel = fields.get("accel") or Accel()
            self._covariance = np.zeros(36, np.float64)
            if fields:
                set_fields(self, fields)


class AccelWithCovarianceStamped(Message):
    """Message geometry_msgs/msg/AccelWithCovarianceStamped."""

    ROS_TYPE = "geometry_msgs/msg/AccelWithCovarianceStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'AccelWithCovariance'),
    )

    if TYPE_CHECKING:
        header: Header
        accel: AccelWithCovariance
        def __init__(self, *, header: Header = ..., accel: AccelWithCovariance = ...) -> None: ...
    else:
        __slots__ = ["_header", "_accel"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._accel = fields.get("accel") or AccelWithCovariance()
            if fields:
                set_fields(self, fields)


class Inertia(Message):
    """Mass in kg, centre of mass in m, inertia tensor in kg m^2."""

    ROS_TYPE = "geometry_msgs/msg/Inertia"
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
        __slots__ = ["_m", "_com", "_ixx", "_ixy", "_ixz", "_iyy", "_iyz", "_izz"]

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
                set_fields(self, fields)


class InertiaStamped(Message):
    """Message geometry_msgs/msg/InertiaStamped."""

    ROS_TYPE = "geometry_msgs/msg/InertiaStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Inertia'),
    )

    if TYPE_CHECKING:
        header: Header
        inertia: Inertia
        def __init__(self, *, header: Header = ..., inertia: Inertia = ...) -> None: ...
    else:
        __slots__ = ["_header", "_inertia"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._inertia = fields.get("inertia") or Inertia()
            if fields:
                set_fields(self, fields)


class Point(Message):
    """A position in metres."""

    ROS_TYPE = "geometry_msgs/msg/Point"
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
        __slots__ = ["_x", "_y", "_z"]

        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            if fields:
                set_fields(self, fields)


class Point32(Message):
    """A position in metres, in single precision."""

    ROS_TYPE = "geometry_msgs/msg/Point32"
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
        __slots__ = ["_x", "_y", "_z"]

        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            if fields:
                set_fields(self, fields)


class PointStamped(Message):
    """Message geometry_msgs/msg/PointStamped."""

    ROS_TYPE = "geometry_msgs/msg/PointStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Point'),
    )

    if TYPE_CHECKING:
        header: Header
        point: Point
        def __init__(self, *, header: Header = ..., point: Point = ...) -> None: ...
    else:
        __slots__ = ["_header", "_point"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._point = fields.get("point") or Point()
            if fields:
                set_fields(self, fields)


class Polygon(Message):
    """Message geometry_msgs/msg/Polygon."""

    ROS_TYPE = "geometry_msgs/msg/Polygon"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Point32')),
    )

    if TYPE_CHECKING:
        points: list[Point32]
        def __init__(self, *, points: list[Point32] = ...) -> None: ...
    else:
        __slots__ = ["_points"]

        def __init__(self, **fields: Any) -> None:
            self._points = []
            if fields:
                set_fields(self, fields)


class PolygonInstance(Message):
    """Message geometry_msgs/msg/PolygonInstance."""

    ROS_TYPE = "geometry_msgs/msg/PolygonInstance"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Polygon'),
        BasicType('int64'),
    )

    if TYPE_CHECKING:
        polygon: Polygon
        id: int
        def __init__(self, *, polygon: Polygon = ..., id: int = ...) -> None: ...
    else:
        __slots__ = ["_polygon", "_id"]

        def __init__(self, **fields: Any) -> None:
            self._polygon = fields.get("polygon") or Polygon()
            self._id = 0
            if fields:
                set_fields(self, fields)


class PolygonInstanceStamped(Message):
    """Message geometry_msgs/msg/PolygonInstanceStamped."""

    ROS_TYPE = "geometry_msgs/msg/PolygonInstanceStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'PolygonInstance'),
    )

    if TYPE_CHECKING:
        header: Header
        polygon: PolygonInstance
        def __init__(self, *, header: Header = ..., polygon: PolygonInstance = ...) -> None: ...
    else:
        __slots__ = ["_header", "_polygon"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._polygon = fields.get("polygon") or PolygonInstance()
            if fields:
                set_fields(self, fields)


class PolygonStamped(Message):
    """Message geometry_msgs/msg/PolygonStamped."""

    ROS_TYPE = "geometry_msgs/msg/PolygonStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Polygon'),
    )

    if TYPE_CHECKING:
        header: Header
        polygon: Polygon
        def __init__(self, *, header: Header = ..., polygon: Polygon = ...) -> None: ...
    else:
        __slots__ = ["_header", "_polygon"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._polygon = fields.get("polygon") or Polygon()
            if fields:
                set_fields(self, fields)


class Quaternion(Message):
    """A rotation as a unit quaternion; the default is no rotation."""

    ROS_TYPE = "geometry_msgs/msg/Quaternion"
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
        __slots__ = ["_x", "_y", "_z", "_w"]

        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._z = 0.0
            self._w = 1.0
            if fields:
                set_fields(self, fields)


class Pose(Message):
    """A position and an orientation."""

    ROS_TYPE = "geometry_msgs/msg/Pose"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Point'),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
    )

    if TYPE_CHECKING:
        position: Point
        orientation: Quaternion
        def __init__(self, *, position: Point = ..., orientation: Quaternion = ...) -> None: ...
    else:
        __slots__ = ["_position", "_orientation"]

        def __init__(self, **fields: Any) -> None:
            self._position = fields.get("position") or Point()
            self._orientation = fields.get("orientation") or Quaternion()
            if fields:
                set_fields(self, fields)


class Pose2D(Message):
    """Message geometry_msgs/msg/Pose2D."""

    ROS_TYPE = "geometry_msgs/msg/Pose2D"
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
        __slots__ = ["_x", "_y", "_theta"]

        def __init__(self, **fields: Any) -> None:
            self._x = 0.0
            self._y = 0.0
            self._theta = 0.0
            if fields:
                set_fields(self, fields)


class PoseArray(Message):
    """Message geometry_msgs/msg/PoseArray."""

    ROS_TYPE = "geometry_msgs/msg/PoseArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Pose')),
    )

    if TYPE_CHECKING:
        header: Header
        poses: list[Pose]
        def __init__(self, *, header: Header = ..., poses: list[Pose] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_poses"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._poses = []
            if fields:
                set_fields(self, fields)


class PoseStamped(Message):
    """A pose in the frame and at the time of its header."""

    ROS_TYPE = "geometry_msgs/msg/PoseStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
    )

    if TYPE_CHECKING:
        header: Header
        pose: Pose
        def __init__(self, *, header: Header = ..., pose: Pose = ...) -> None: ...
    else:
        __slots__ = ["_header", "_pose"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._pose = fields.get("pose") or Pose()
            if fields:
                set_fields(self, fields)


class PoseWithCovariance(Message):
    """A pose and its 6x6 covariance, row by row: x, y, z and the rotations about X, Y, Z."""

    ROS_TYPE = "geometry_msgs/msg/PoseWithCovariance"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Pose'),
        Array(BasicType('double'), 36),
    )

    if TYPE_CHECKING:
        pose: Pose
        covariance = NumberArray[np.float64]()
        def __init__(self, *, pose: Pose = ..., covariance: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_pose", "_covariance"]

        def __init__(self, **fields: Any) -> None:
            self._pose = fields.get("pose") or Pose()
            self._covariance = np.zeros(36, np.float64)
            if fields:
                set_fields(self, fields)


class PoseWithCovarianceStamped(Message):
    """Message geometry_msgs/msg/PoseWithCovarianceStamped."""

    ROS_TYPE = "geometry_msgs/msg/PoseWithCovarianceStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'PoseWithCovariance'),
    )

    if TYPE_CHECKING:
        header: Header
        pose: PoseWithCovariance
        def __init__(self, *, header: Header = ..., pose: PoseWithCovariance = ...) -> None: ...
    else:
        __slots__ = ["_header", "_pose"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._pose = fields.get("pose") or PoseWithCovariance()
            if fields:
                set_fields(self, fields)


class QuaternionStamped(Message):
    """Message geometry_msgs/msg/QuaternionStamped."""

    ROS_TYPE = "geometry_msgs/msg/QuaternionStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
    )

    if TYPE_CHECKING:
        header: Header
        quaternion: Quaternion
        def __init__(self, *, header: Header = ..., quaternion: Quaternion = ...) -> None: ...
    else:
        __slots__ = ["_header", "_quaternion"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._quaternion = fields.get("quaternion") or Quaternion()
            if fields:
                set_fields(self, fields)


class Transform(Message):
    """Rotation, then translation: transforms points from the child frame to the parent frame."""

    ROS_TYPE = "geometry_msgs/msg/Transform"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
    )

    if TYPE_CHECKING:
        translation: Vector3
        rotation: Quaternion
        def __init__(self, *, translation: Vector3 = ..., rotation: Quaternion = ...) -> None: ...
    else:
        __slots__ = ["_translation", "_rotation"]

        def __init__(self, **fields: Any) -> None:
            self._translation = fields.get("translation") or Vector3()
            self._rotation = fields.get("rotation") or Quaternion()
            if fields:
                set_fields(self, fields)


class TransformStamped(Message):
    """The transform from child_frame_id to the frame of the header."""

    ROS_TYPE = "geometry_msgs/msg/TransformStamped"
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
        __slots__ = ["_header", "_child_frame_id", "_transform"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._child_frame_id = ""
            self._transform = fields.get("transform") or Transform()
            if fields:
                set_fields(self, fields)


class Twist(Message):
    """Linear velocity in m/s and angular velocity in rad/s."""

    ROS_TYPE = "geometry_msgs/msg/Twist"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        linear: Vector3
        angular: Vector3
        def __init__(self, *, linear: Vector3 = ..., angular: Vector3 = ...) -> None: ...
    else:
        __slots__ = ["_linear", "_angular"]

        def __init__(self, **fields: Any) -> None:
            self._linear = fields.get("linear") or Vector3()
            self._angular = fields.get("angular") or Vector3()
            if fields:
                set_fields(self, fields)


class TwistStamped(Message):
    """Message geometry_msgs/msg/TwistStamped."""

    ROS_TYPE = "geometry_msgs/msg/TwistStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Twist'),
    )

    if TYPE_CHECKING:
        header: Header
        twist: Twist
        def __init__(self, *, header: Header = ..., twist: Twist = ...) -> None: ...
    else:
        __slots__ = ["_header", "_twist"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._twist = fields.get("twist") or Twist()
            if fields:
                set_fields(self, fields)


class TwistWithCovariance(Message):
    """A twist and its 6x6 covariance, row by row: linear x, y, z, angular x, y, z."""

    ROS_TYPE = "geometry_msgs/msg/TwistWithCovariance"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Twist'),
        Array(BasicType('double'), 36),
    )

    if TYPE_CHECKING:
        twist: Twist
        covariance = NumberArray[np.float64]()
        def __init__(self, *, twist: Twist = ..., covariance: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_twist", "_covariance"]

        def __init__(self, **fields: Any) -> None:
            self._twist = fields.get("twist") or Twist()
            self._covariance = np.zeros(36, np.float64)
            if fields:
                set_fields(self, fields)


class TwistWithCovarianceStamped(Message):
    """Message geometry_msgs/msg/TwistWithCovarianceStamped."""

    ROS_TYPE = "geometry_msgs/msg/TwistWithCovarianceStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'TwistWithCovariance'),
    )

    if TYPE_CHECKING:
        header: Header
        twist: TwistWithCovariance
        def __init__(self, *, header: Header = ..., twist: TwistWithCovariance = ...) -> None: ...
    else:
        __slots__ = ["_header", "_twist"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._twist = fields.get("twist") or TwistWithCovariance()
            if fields:
                set_fields(self, fields)


class Vector3Stamped(Message):
    """Message geometry_msgs/msg/Vector3Stamped."""

    ROS_TYPE = "geometry_msgs/msg/Vector3Stamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        header: Header
        vector: Vector3
        def __init__(self, *, header: Header = ..., vector: Vector3 = ...) -> None: ...
    else:
        __slots__ = ["_header", "_vector"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._vector = fields.get("vector") or Vector3()
            if fields:
                set_fields(self, fields)


class VelocityStamped(Message):
    """A velocity of one frame relative to another, with its stamp and the frame that it is expressed in."""

    ROS_TYPE = "geometry_msgs/msg/VelocityStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedString(),
        UnboundedString(),
        NamespacedType(('geometry_msgs', 'msg'), 'Twist'),
    )

    if TYPE_CHECKING:
        header: Header
        body_frame_id: str
        reference_frame_id: str
        velocity: Twist
        def __init__(self, *, header: Header = ..., body_frame_id: str = ..., reference_frame_id: str = ..., velocity: Twist = ...) -> None: ...
    else:
        __slots__ = ["_header", "_body_frame_id", "_reference_frame_id", "_velocity"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._body_frame_id = ""
            self._reference_frame_id = ""
            self._velocity = fields.get("velocity") or Twist()
            if fields:
                set_fields(self, fields)


class Wrench(Message):
    """Force in N and torque in N m."""

    ROS_TYPE = "geometry_msgs/msg/Wrench"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
    )

    if TYPE_CHECKING:
        force: Vector3
        torque: Vector3
        def __init__(self, *, force: Vector3 = ..., torque: Vector3 = ...) -> None: ...
    else:
        __slots__ = ["_force", "_torque"]

        def __init__(self, **fields: Any) -> None:
            self._force = fields.get("force") or Vector3()
            self._torque = fields.get("torque") or Vector3()
            if fields:
                set_fields(self, fields)


class WrenchStamped(Message):
    """Message geometry_msgs/msg/WrenchStamped."""

    ROS_TYPE = "geometry_msgs/msg/WrenchStamped"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Wrench'),
    )

    if TYPE_CHECKING:
        header: Header
        wrench: Wrench
        def __init__(self, *, header: Header = ..., wrench: Wrench = ...) -> None: ...
    else:
        __slots__ = ["_header", "_wrench"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._wrench = fields.get("wrench") or Wrench()
            if fields:
                set_fields(self, fields)
