# Written by scripts/generate_messages.py from interfaces/sensor_msgs/msg; do not edit.
"""Messages of sensor_msgs."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any, Final

import coframe.lazy_numpy as np
from coframe.distributions import follows
from coframe.messages.definition import Array, BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.builtin_interfaces.msg import Time
from coframe.messages.generated.geometry_msgs.msg import Point32, Quaternion, Transform, Twist, Vector3, Wrench
from coframe.messages.generated.std_msgs.msg import Header

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberArray, NumberSequence


if TYPE_CHECKING or not follows("humble"):
    class BatteryState(Message):
        """Message sensor_msgs/msg/BatteryState."""

        ROS_TYPE = "sensor_msgs/msg/BatteryState"
        SLOT_TYPES = (
            NamespacedType(('std_msgs', 'msg'), 'Header'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('uint8'),
            BasicType('uint8'),
            BasicType('uint8'),
            BasicType('boolean'),
            UnboundedSequence(BasicType('float')),
            UnboundedSequence(BasicType('float')),
            UnboundedString(),
            UnboundedString(),
        )
        POWER_SUPPLY_STATUS_UNKNOWN: Final = 0
        POWER_SUPPLY_STATUS_CHARGING: Final = 1
        POWER_SUPPLY_STATUS_DISCHARGING: Final = 2
        POWER_SUPPLY_STATUS_NOT_CHARGING: Final = 3
        POWER_SUPPLY_STATUS_FULL: Final = 4
        POWER_SUPPLY_HEALTH_UNKNOWN: Final = 0
        POWER_SUPPLY_HEALTH_GOOD: Final = 1
        POWER_SUPPLY_HEALTH_OVERHEAT: Final = 2
        POWER_SUPPLY_HEALTH_DEAD: Final = 3
        POWER_SUPPLY_HEALTH_OVERVOLTAGE: Final = 4
        POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: Final = 5
        POWER_SUPPLY_HEALTH_COLD: Final = 6
        POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: Final = 7
        POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: Final = 8
        POWER_SUPPLY_TECHNOLOGY_UNKNOWN: Final = 0
        POWER_SUPPLY_TECHNOLOGY_NIMH: Final = 1
        POWER_SUPPLY_TECHNOLOGY_LION: Final = 2
        POWER_SUPPLY_TECHNOLOGY_LIPO: Final = 3
        POWER_SUPPLY_TECHNOLOGY_LIFE: Final = 4
        POWER_SUPPLY_TECHNOLOGY_NICD: Final = 5
        POWER_SUPPLY_TECHNOLOGY_LIMN: Final = 6
        POWER_SUPPLY_TECHNOLOGY_TERNARY: Final = 7
        POWER_SUPPLY_TECHNOLOGY_VRLA: Final = 8

        if TYPE_CHECKING:
            header: Header
            voltage: float
            temperature: float
            current: float
            charge: float
            capacity: float
            design_capacity: float
            percentage: float
            power_supply_status: int
            power_supply_health: int
            power_supply_technology: int
            present: bool
            cell_voltage = NumberSequence[float]()
            cell_temperature = NumberSequence[float]()
            location: str
            serial_number: str
            def __init__(self, *, header: Header = ..., voltage: float = ..., temperature: float = ..., current: float = ..., charge: float = ..., capacity: float = ..., design_capacity: float = ..., percentage: float = ..., power_supply_status: int = ..., power_supply_health: int = ..., power_supply_technology: int = ..., present: bool = ..., cell_voltage: Iterable[float] = ..., cell_temperature: Iterable[float] = ..., location: str = ..., serial_number: str = ...) -> None: ...
        else:
            __slots__ = ["_header", "_voltage", "_temperature", "_current", "_charge", "_capacity", "_design_capacity", "_percentage", "_power_supply_status", "_power_supply_health", "_power_supply_technology", "_present", "_cell_voltage", "_cell_temperature", "_location", "_serial_number"]

            def __init__(self, **fields: Any) -> None:
                self._header = fields.get("header") or Header()
                self._voltage = 0.0
                self._temperature = 0.0
                self._current = 0.0
                self._charge = 0.0
                self._capacity = 0.0
                self._design_capacity = 0.0
                self._percentage = 0.0
                self._power_supply_status = 0
                self._power_supply_health = 0
                self._power_supply_technology = 0
                self._present = False
                self._cell_voltage = array("f")
                self._cell_temperature = array("f")
                self._location = ""
                self._serial_number = ""
                if fields:
                    set_fields(self, fields)

else:
    class BatteryState(Message):
        """Message sensor_msgs/msg/BatteryState."""

        ROS_TYPE = "sensor_msgs/msg/BatteryState"
        SLOT_TYPES = (
            NamespacedType(('std_msgs', 'msg'), 'Header'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('uint8'),
            BasicType('uint8'),
            BasicType('uint8'),
            BasicType('boolean'),
            UnboundedSequence(BasicType('float')),
            UnboundedSequence(BasicType('float')),
            UnboundedString(),
            UnboundedString(),
        )
        POWER_SUPPLY_STATUS_UNKNOWN: Final = 0
        POWER_SUPPLY_STATUS_CHARGING: Final = 1
        POWER_SUPPLY_STATUS_DISCHARGING: Final = 2
        POWER_SUPPLY_STATUS_NOT_CHARGING: Final = 3
        POWER_SUPPLY_STATUS_FULL: Final = 4
        POWER_SUPPLY_HEALTH_UNKNOWN: Final = 0
        POWER_SUPPLY_HEALTH_GOOD: Final = 1
        POWER_SUPPLY_HEALTH_OVERHEAT: Final = 2
        POWER_SUPPLY_HEALTH_DEAD: Final = 3
        POWER_SUPPLY_HEALTH_OVERVOLTAGE: Final = 4
        POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: Final = 5
        POWER_SUPPLY_HEALTH_COLD: Final = 6
        POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: Final = 7
        POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: Final = 8
        POWER_SUPPLY_TECHNOLOGY_UNKNOWN: Final = 0
        POWER_SUPPLY_TECHNOLOGY_NIMH: Final = 1
        POWER_SUPPLY_TECHNOLOGY_LION: Final = 2
        POWER_SUPPLY_TECHNOLOGY_LIPO: Final = 3
        POWER_SUPPLY_TECHNOLOGY_LIFE: Final = 4
        POWER_SUPPLY_TECHNOLOGY_NICD: Final = 5
        POWER_SUPPLY_TECHNOLOGY_LIMN: Final = 6

        if TYPE_CHECKING:
            header: Header
            voltage: float
            temperature: float
            current: float
            charge: float
            capacity: float
            design_capacity: float
            percentage: float
            power_supply_status: int
            power_supply_health: int
            power_supply_technology: int
            present: bool
            cell_voltage = NumberSequence[float]()
            cell_temperature = NumberSequence[float]()
            location: str
            serial_number: str
            def __init__(self, *, header: Header = ..., voltage: float = ..., temperature: float = ..., current: float = ..., charge: float = ..., capacity: float = ..., design_capacity: float = ..., percentage: float = ..., power_supply_status: int = ..., power_supply_health: int = ..., power_supply_technology: int = ..., present: bool = ..., cell_voltage: Iterable[float] = ..., cell_temperature: Iterable[float] = ..., location: str = ..., serial_number: str = ...) -> None: ...
        else:
            __slots__ = ["_header", "_voltage", "_temperature", "_current", "_charge", "_capacity", "_design_capacity", "_percentage", "_power_supply_status", "_power_supply_health", "_power_supply_technology", "_present", "_cell_voltage", "_cell_temperature", "_location", "_serial_number"]

            def __init__(self, **fields: Any) -> None:
                self._header = fields.get("header") or Header()
                self._voltage = 0.0
                self._temperature = 0.0
                self._current = 0.0
                self._charge = 0.0
                self._capacity = 0.0
                self._design_capacity = 0.0
                self._percentage = 0.0
                self._power_supply_status = 0
                self._power_supply_health = 0
                self._power_supply_technology = 0
                self._present = False
                self._cell_voltage = array("f")
                self._cell_temperature = array("f")
                self._location = ""
                self._serial_number = ""
                if fields:
                    set_fields(self, fields)


class RegionOfInterest(Message):
    """Message sensor_msgs/msg/RegionOfInterest."""

    ROS_TYPE = "sensor_msgs/msg/RegionOfInterest"
    SLOT_TYPES = (
        BasicType('uint32'),
        BasicType('uint32'),
        BasicType('uint32'),
        BasicType('uint32'),
        BasicType('boolean'),
    )

    if TYPE_CHECKING:
        x_offset: int
        y_offset: int
        height: int
        width: int
        do_rectify: bool
        def __init__(self, *, x_offset: int = ..., y_offset: int = ..., height: int = ..., width: int = ..., do_rectify: bool = ...) -> None: ...
    else:
        __slots__ = ["_x_offset", "_y_offset", "_height", "_width", "_do_rectify"]

        def __init__(self, **fields: Any) -> None:
            self._x_offset = 0
            self._y_offset = 0
            self._height = 0
            self._width = 0
            self._do_rectify = False
            if fields:
                set_fields(self, fields)


class CameraInfo(Message):
    """Calibration of a camera: distortion d, intrinsics k, rectification r, projection p."""

    ROS_TYPE = "sensor_msgs/msg/CameraInfo"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('uint32'),
        BasicType('uint32'),
        UnboundedString(),
        UnboundedSequence(BasicType('double')),
        Array(BasicType('double'), 9),
        Array(BasicType('double'), 9),
        Array(BasicType('double'), 12),
        BasicType('uint32'),
        BasicType('uint32'),
        NamespacedType(('sensor_msgs', 'msg'), 'RegionOfInterest'),
    )

    if TYPE_CHECKING:
        header: Header
        height: int
        width: int
        distortion_model: str
        d = NumberSequence[float]()
        k = NumberArray[np.float64]()
        r = NumberArray[np.float64]()
        p = NumberArray[np.float64]()
        binning_x: int
        binning_y: int
        roi: RegionOfInterest
        def __init__(self, *, header: Header = ..., height: int = ..., width: int = ..., distortion_model: str = ..., d: Iterable[float] = ..., k: Iterable[float] = ..., r: Iterable[float] = ..., p: Iterable[float] = ..., binning_x: int = ..., binning_y: int = ..., roi: RegionOfInterest = ...) -> None: ...
    else:
        __slots__ = ["_header", "_height", "_width", "_distortion_model", "_d", "_k", "_r", "_p", "_binning_x", "_binning_y", "_roi"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._height = 0
            self._width = 0
            self._distortion_model = ""
            self._d = array("d")
            self._k = np.zeros(9, np.float64)
            self._r = np.zeros(9, np.float64)
            self._p = np.zeros(12, np.float64)
            self._binning_x = 0
            self._binning_y = 0
            self._roi = fields.get("roi") or RegionOfInterest()
            if fields:
                set_fields(self, fields)


class ChannelFloat32(Message):
    """Message sensor_msgs/msg/ChannelFloat32."""

    ROS_TYPE = "sensor_msgs/msg/ChannelFloat32"
    SLOT_TYPES = (
        UnboundedString(),
        UnboundedSequence(BasicType('float')),
    )

    if TYPE_CHECKING:
        name: str
        values = NumberSequence[float]()
        def __init__(self, *, name: str = ..., values: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_name", "_values"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._values = array("f")
            if fields:
                set_fields(self, fields)


class CompressedImage(Message):
    """An image as the bytes of a compressed file; format names the codec."""

    ROS_TYPE = "sensor_msgs/msg/CompressedImage"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedString(),
        UnboundedSequence(BasicType('uint8')),
    )

    if TYPE_CHECKING:
        header: Header
        format: str
        data = NumberSequence[int]()
        def __init__(self, *, header: Header = ..., format: str = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_format", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._format = ""
            self._data = array("B")
            if fields:
                set_fields(self, fields)


class FluidPressure(Message):
    """Message sensor_msgs/msg/FluidPressure."""

    ROS_TYPE = "sensor_msgs/msg/FluidPressure"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        header: Header
        fluid_pressure: float
        variance: float
        def __init__(self, *, header: Header = ..., fluid_pressure: float = ..., variance: float = ...) -> None: ...
    else:
        __slots__ = ["_header", "_fluid_pressure", "_variance"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._fluid_pressure = 0.0
            self._variance = 0.0
            if fields:
                set_fields(self, fields)


class Illuminance(Message):
    """Message sensor_msgs/msg/Illuminance."""

    ROS_TYPE = "sensor_msgs/msg/Illuminance"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        header: Header
        illuminance: float
        variance: float
        def __init__(self, *, header: Header = ..., illuminance: float = ..., variance: float = ...) -> None: ...
    else:
        __slots__ = ["_header", "_illuminance", "_variance"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._illuminance = 0.0
            self._variance = 0.0
            if fields:
                set_fields(self, fields)


class Image(Message):
    """An uncompressed image, row by row."""

    ROS_TYPE = "sensor_msgs/msg/Image"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('uint32'),
        BasicType('uint32'),
        UnboundedString(),
        BasicType('uint8'),
        BasicType('uint32'),
        UnboundedSequence(BasicType('uint8')),
    )

    if TYPE_CHECKING:
        header: Header
        height: int
        width: int
        encoding: str
        is_bigendian: int
        step: int
        data = NumberSequence[int]()
        def __init__(self, *, header: Header = ..., height: int = ..., width: int = ..., encoding: str = ..., is_bigendian: int = ..., step: int = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_height", "_width", "_encoding", "_is_bigendian", "_step", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._height = 0
            self._width = 0
            self._encoding = ""
            self._is_bigendian = 0
            self._step = 0
            self._data = array("B")
            if fields:
                set_fields(self, fields)


class Imu(Message):
    """Orientation, angular velocity in rad/s, linear acceleration in m/s^2; covariance -1: not measured."""

    ROS_TYPE = "sensor_msgs/msg/Imu"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Quaternion'),
        Array(BasicType('double'), 9),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        Array(BasicType('double'), 9),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        Array(BasicType('double'), 9),
    )

    if TYPE_CHECKING:
        header: Header
        orientation: Quaternion
        orientation_covariance = NumberArray[np.float64]()
        angular_velocity: Vector3
        angular_velocity_covariance = NumberArray[np.float64]()
        linear_acceleration: Vector3
        linear_acceleration_covariance = NumberArray[np.float64]()
        def __init__(self, *, header: Header = ..., orientation: Quaternion = ..., orientation_covariance: Iterable[float] = ..., angular_velocity: Vector3 = ..., angular_velocity_covariance: Iterable[float] = ..., linear_acceleration: Vector3 = ..., linear_acceleration_covariance: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_orientation", "_orientation_covariance", "_angular_velocity", "_angular_velocity_covariance", "_linear_acceleration", "_linear_acceleration_covariance"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._orientation = fields.get("orientation") or Quaternion()
            self._orientation_covariance = np.zeros(9, np.float64)
            self._angular_velocity = fields.get("angular_velocity") or Vector3()
            self._angular_velocity_covariance = np.zeros(9, np.float64)
            self._linear_acceleration = fields.get("linear_acceleration") or Vector3()
            self._linear_acceleration_covariance = np.zeros(9, np.float64)
            if fields:
                set_fields(self, fields)


class JointState(Message):
    """Positions (rad or m), velocities and efforts of named joints."""

    ROS_TYPE = "sensor_msgs/msg/JointState"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(UnboundedString()),
        UnboundedSequence(BasicType('double')),
        UnboundedSequence(BasicType('double')),
        UnboundedSequence(BasicType('double')),
    )

    if TYPE_CHECKING:
        header: Header
        name: list[str]
        position = NumberSequence[float]()
        velocity = NumberSequence[float]()
        effort = NumberSequence[float]()
        def __init__(self, *, header: Header = ..., name: list[str] = ..., position: Iterable[float] = ..., velocity: Iterable[float] = ..., effort: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_name", "_position", "_velocity", "_effort"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._name = []
            self._position = array("d")
            self._velocity = array("d")
            self._effort = array("d")
            if fields:
                set_fields(self, fields)


class Joy(Message):
    """Message sensor_msgs/msg/Joy."""

    ROS_TYPE = "sensor_msgs/msg/Joy"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(BasicType('float')),
        UnboundedSequence(BasicType('int32')),
    )

    if TYPE_CHECKING:
        header: Header
        axes = NumberSequence[float]()
        buttons = NumberSequence[int]()
        def __init__(self, *, header: Header = ..., axes: Iterable[float] = ..., buttons: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_axes", "_buttons"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._axes = array("f")
            self._buttons = array("i")
            if fields:
                set_fields(self, fields)


class JoyFeedback(Message):
    """Message sensor_msgs/msg/JoyFeedback."""

    ROS_TYPE = "sensor_msgs/msg/JoyFeedback"
    SLOT_TYPES = (
        BasicType('uint8'),
        BasicType('uint8'),
        BasicType('float'),
    )
    TYPE_LED: Final = 0
    TYPE_RUMBLE: Final = 1
    TYPE_BUZZER: Final = 2

    if TYPE_CHECKING:
        type: int
        id: int
        intensity: float
        def __init__(self, *, type: int = ..., id: int = ..., intensity: float = ...) -> None: ...
    else:
        __slots__ = ["_type", "_id", "_intensity"]

        def __init__(self, **fields: Any) -> None:
            self._type = 0
            self._id = 0
            self._intensity = 0.0
            if fields:
                set_fields(self, fields)


class JoyFeedbackArray(Message):
    """Message sensor_msgs/msg/JoyFeedbackArray."""

    ROS_TYPE = "sensor_msgs/msg/JoyFeedbackArray"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('sensor_msgs', 'msg'), 'JoyFeedback')),
    )

    if TYPE_CHECKING:
        array: list[JoyFeedback]
        def __init__(self, *, array: list[JoyFeedback] = ...) -> None: ...
    else:
        __slots__ = ["_array"]

        def __init__(self, **fields: Any) -> None:
            self._array = []
            if fields:
                set_fields(self, fields)


class LaserEcho(Message):
    """Message sensor_msgs/msg/LaserEcho."""

    ROS_TYPE = "sensor_msgs/msg/LaserEcho"
    SLOT_TYPES = (
        UnboundedSequence(BasicType('float')),
    )

    if TYPE_CHECKING:
        echoes = NumberSequence[float]()
        def __init__(self, *, echoes: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_echoes"]

        def __init__(self, **fields: Any) -> None:
            self._echoes = array("f")
            if fields:
                set_fields(self, fields)


class LaserScan(Message):
    """One sweep of a planar laser: angles in rad, times in s, ranges in m."""

    ROS_TYPE = "sensor_msgs/msg/LaserScan"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        UnboundedSequence(BasicType('float')),
        UnboundedSequence(BasicType('float')),
    )

    if TYPE_CHECKING:
        header: Header
        angle_min: float
        angle_max: float
        angle_increment: float
        time_increment: float
        scan_time: float
        range_min: float
        range_max: float
        ranges = NumberSequence[float]()
        intensities = NumberSequence[float]()
        def __init__(self, *, header: Header = ..., angle_min: float = ..., angle_max: float = ..., angle_increment: float = ..., time_increment: float = ..., scan_time: float = ..., range_min: float = ..., range_max: float = ..., ranges: Iterable[float] = ..., intensities: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_angle_min", "_angle_max", "_angle_increment", "_time_increment", "_scan_time", "_range_min", "_range_max", "_ranges", "_intensities"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._angle_min = 0.0
            self._angle_max = 0.0
            self._angle_increment = 0.0
            self._time_increment = 0.0
            self._scan_time = 0.0
            self._range_min = 0.0
            self._range_max = 0.0
            self._ranges = array("f")
            self._intensities = array("f")
            if fields:
                set_fields(self, fields)


class MagneticField(Message):
    """Message sensor_msgs/msg/MagneticField."""

    ROS_TYPE = "sensor_msgs/msg/MagneticField"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('geometry_msgs', 'msg'), 'Vector3'),
        Array(BasicType('double'), 9),
    )

    if TYPE_CHECKING:
        header: Header
        magnetic_field: Vector3
        magnetic_field_covariance = NumberArray[np.float64]()
        def __init__(self, *, header: Header = ..., magnetic_field: Vector3 = ..., magnetic_field_covariance: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_magnetic_field", "_magnetic_field_covariance"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._magnetic_field = fields.get("magnetic_field") or Vector3()
            self._magnetic_field_covariance = np.zeros(9, np.float64)
            if fields:
                set_fields(self, fields)


class MultiDOFJointState(Message):
    """Message sensor_msgs/msg/MultiDOFJointState."""

    ROS_TYPE = "sensor_msgs/msg/MultiDOFJointState"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(UnboundedString()),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Transform')),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Twist')),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Wrench')),
    )

    if TYPE_CHECKING:
        header: Header
        joint_names: list[str]
        transforms: list[Transform]
        twist: list[Twist]
        wrench: list[Wrench]
        def __init__(self, *, header: Header = ..., joint_names: list[str] = ..., transforms: list[Transform] = ..., twist: list[Twist] = ..., wrench: list[Wrench] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_joint_names", "_transforms", "_twist", "_wrench"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._joint_names = []
            self._transforms = []
            self._twist = []
            self._wrench = []
            if fields:
                set_fields(self, fields)


class MultiEchoLaserScan(Message):
    """Message sensor_msgs/msg/MultiEchoLaserScan."""

    ROS_TYPE = "sensor_msgs/msg/MultiEchoLaserScan"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        UnboundedSequence(NamespacedType(('sensor_msgs', 'msg'), 'LaserEcho')),
        UnboundedSequence(NamespacedType(('sensor_msgs', 'msg'), 'LaserEcho')),
    )

    if TYPE_CHECKING:
        header: Header
        angle_min: float
        angle_max: float
        angle_increment: float
        time_increment: float
        scan_time: float
        range_min: float
        range_max: float
        ranges: list[LaserEcho]
        intensities: list[LaserEcho]
        def __init__(self, *, header: Header = ..., angle_min: float = ..., angle_max: float = ..., angle_increment: float = ..., time_increment: float = ..., scan_time: float = ..., range_min: float = ..., range_max: float = ..., ranges: list[LaserEcho] = ..., intensities: list[LaserEcho] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_angle_min", "_angle_max", "_angle_increment", "_time_increment", "_scan_time", "_range_min", "_range_max", "_ranges", "_intensities"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._angle_min = 0.0
            self._angle_max = 0.0
            self._angle_increment = 0.0
            self._time_increment = 0.0
            self._scan_time = 0.0
            self._range_min = 0.0
            self._range_max = 0.0
            self._ranges = []
            self._intensities = []
            if fields:
                set_fields(self, fields)


if TYPE_CHECKING or not follows("humble"):
    class NavSatStatus(Message):
        """Message sensor_msgs/msg/NavSatStatus."""

        ROS_TYPE = "sensor_msgs/msg/NavSatStatus"
        SLOT_TYPES = (
            BasicType('int8'),
            BasicType('uint16'),
        )
        STATUS_UNKNOWN: Final = -2
        STATUS_NO_FIX: Final = -1
        STATUS_FIX: Final = 0
        STATUS_SBAS_FIX: Final = 1
        STATUS_GBAS_FIX: Final = 2
        SERVICE_UNKNOWN: Final = 0
        SERVICE_GPS: Final = 1
        SERVICE_GLONASS: Final = 2
        SERVICE_COMPASS: Final = 4
        SERVICE_GALILEO: Final = 8
        STATUS__DEFAULT: Final = -2

        if TYPE_CHECKING:
            status: int
            service: int
            def __init__(self, *, status: int = ..., service: int = ...) -> None: ...
        else:
            __slots__ = ["_status", "_service"]

            def __init__(self, **fields: Any) -> None:
                self._status = -2
                self._service = 0
                if fields:
                    set_fields(self, fields)

else:
    class NavSatStatus(Message):
        """Message sensor_msgs/msg/NavSatStatus."""

        ROS_TYPE = "sensor_msgs/msg/NavSatStatus"
        SLOT_TYPES = (
            BasicType('int8'),
            BasicType('uint16'),
        )
        STATUS_NO_FIX: Final = -1
        STATUS_FIX: Final = 0
        STATUS_SBAS_FIX: Final = 1
        STATUS_GBAS_FIX: Final = 2
        SERVICE_GPS: Final = 1
        SERVICE_GLONASS: Final = 2
        SERVICE_COMPASS: Final = 4
        SERVICE_GALILEO: Final = 8

        if TYPE_CHECKING:
            status: int
            service: int
            def __init__(self, *, status: int = ..., service: int = ...) -> None: ...
        else:
            __slots__ = ["_status", "_service"]

            def __init__(self, **fields: Any) -> None:
                self._status = 0
                self._service = 0
                if fields:
                    set_fields(self, fields)


class NavSatFix(Message):
    """Message sensor_msgs/msg/NavSatFix."""

    ROS_TYPE = "sensor_msgs/msg/NavSatFix"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('sensor_msgs', 'msg'), 'NavSatStatus'),
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
        Array(BasicType('double'), 9),
        BasicType('uint8'),
    )
    COVARIANCE_TYPE_UNKNOWN: Final = 0
    COVARIANCE_TYPE_APPROXIMATED: Final = 1
    COVARIANCE_TYPE_DIAGONAL_KNOWN: Final = 2
    COVARIANCE_TYPE_KNOWN: Final = 3

    if TYPE_CHECKING:
        header: Header
        status: NavSatStatus
        latitude: float
        longitude: float
        altitude: float
        position_covariance = NumberArray[np.float64]()
        position_covariance_type: int
        def __init__(self, *, header: Header = ..., status: NavSatStatus = ..., latitude: float = ..., longitude: float = ..., altitude: float = ..., position_covariance: Iterable[float] = ..., position_covariance_type: int = ...) -> None: ...
    else:
        __slots__ = ["_header", "_status", "_latitude", "_longitude", "_altitude", "_position_covariance", "_position_covariance_type"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._status = fields.get("status") or NavSatStatus()
            self._latitude = 0.0
            self._longitude = 0.0
            self._altitude = 0.0
            self._position_covariance = np.zeros(9, np.float64)
            self._position_covariance_type = 0
            if fields:
                set_fields(self, fields)


class PointCloud(Message):
    """Message sensor_msgs/msg/PointCloud."""

    ROS_TYPE = "sensor_msgs/msg/PointCloud"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'Point32')),
        UnboundedSequence(NamespacedType(('sensor_msgs', 'msg'), 'ChannelFloat32')),
    )

    if TYPE_CHECKING:
        header: Header
        points: list[Point32]
        channels: list[ChannelFloat32]
        def __init__(self, *, header: Header = ..., points: list[Point32] = ..., channels: list[ChannelFloat32] = ...) -> None: ...
    else:
        __slots__ = ["_header", "_points", "_channels"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._points = []
            self._channels = []
            if fields:
                set_fields(self, fields)


if TYPE_CHECKING or not follows("lyrical"):
    class PointField(Message):
        """One channel of a PointCloud2: name, offset in bytes, type and count."""

        ROS_TYPE = "sensor_msgs/msg/PointField"
        SLOT_TYPES = (
            UnboundedString(),
            BasicType('uint32'),
            BasicType('uint8'),
            BasicType('uint32'),
        )
        INT8: Final = 1
        UINT8: Final = 2
        INT16: Final = 3
        UINT16: Final = 4
        INT32: Final = 5
        UINT32: Final = 6
        FLOAT32: Final = 7
        FLOAT64: Final = 8

        if TYPE_CHECKING:
            name: str
            offset: int
            datatype: int
            count: int
            def __init__(self, *, name: str = ..., offset: int = ..., datatype: int = ..., count: int = ...) -> None: ...
        else:
            __slots__ = ["_name", "_offset", "_datatype", "_count"]

            def __init__(self, **fields: Any) -> None:
                self._name = ""
                self._offset = 0
                self._datatype = 0
                self._count = 0
                if fields:
                    set_fields(self, fields)

else:
    class PointField(Message):
        """One channel of a PointCloud2: name, offset in bytes, type and count."""

        ROS_TYPE = "sensor_msgs/msg/PointField"
        SLOT_TYPES = (
            UnboundedString(),
            BasicType('uint32'),
            BasicType('uint8'),
            BasicType('uint32'),
        )
        INT8: Final = 1
        UINT8: Final = 2
        INT16: Final = 3
        UINT16: Final = 4
        INT32: Final = 5
        UINT32: Final = 6
        FLOAT32: Final = 7
        FLOAT64: Final = 8
        INT64: Final = 9
        UINT64: Final = 10
        BOOL: Final = 11

        if TYPE_CHECKING:
            name: str
            offset: int
            datatype: int
            count: int
            def __init__(self, *, name: str = ..., offset: int = ..., datatype: int = ..., count: int = ...) -> None: ...
        else:
            __slots__ = ["_name", "_offset", "_datatype", "_count"]

            def __init__(self, **fields: Any) -> None:
                self._name = ""
                self._offset = 0
                self._datatype = 0
                self._count = 0
                if fields:
                    set_fields(self, fields)


class PointCloud2(Message):
    """Points as one binary blob that `fields` describes."""

    ROS_TYPE = "sensor_msgs/msg/PointCloud2"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('uint32'),
        BasicType('uint32'),
        UnboundedSequence(NamespacedType(('sensor_msgs', 'msg'), 'PointField')),
        BasicType('boolean'),
        BasicType('uint32'),
        BasicType('uint32'),
        UnboundedSequence(BasicType('uint8')),
        BasicType('boolean'),
    )

    if TYPE_CHECKING:
        header: Header
        height: int
        width: int
        fields: list[PointField]
        is_bigendian: bool
        point_step: int
        row_step: int
        data = NumberSequence[int]()
        is_dense: bool
        def __init__(self, *, header: Header = ..., height: int = ..., width: int = ..., fields: list[PointField] = ..., is_bigendian: bool = ..., point_step: int = ..., row_step: int = ..., data: Iterable[int] = ..., is_dense: bool = ...) -> None: ...
    else:
        __slots__ = ["_header", "_height", "_width", "_fields", "_is_bigendian", "_point_step", "_row_step", "_data", "_is_dense"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._height = 0
            self._width = 0
            self._fields = []
            self._is_bigendian = False
            self._point_step = 0
            self._row_step = 0
            self._data = array("B")
            self._is_dense = False
            if fields:
                set_fields(self, fields)


if TYPE_CHECKING or not follows("humble"):
    class Range(Message):
        """One reading of a range sensor in m, angles in rad."""

        ROS_TYPE = "sensor_msgs/msg/Range"
        SLOT_TYPES = (
            NamespacedType(('std_msgs', 'msg'), 'Header'),
            BasicType('uint8'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
        )
        ULTRASOUND: Final = 0
        INFRARED: Final = 1

        if TYPE_CHECKING:
            header: Header
            radiation_type: int
            field_of_view: float
            min_range: float
            max_range: float
            range: float
            variance: float
            def __init__(self, *, header: Header = ..., radiation_type: int = ..., field_of_view: float = ..., min_range: float = ..., max_range: float = ..., range: float = ..., variance: float = ...) -> None: ...
        else:
            __slots__ = ["_header", "_radiation_type", "_field_of_view", "_min_range", "_max_range", "_range", "_variance"]

            def __init__(self, **fields: Any) -> None:
                self._header = fields.get("header") or Header()
                self._radiation_type = 0
                self._field_of_view = 0.0
                self._min_range = 0.0
                self._max_range = 0.0
                self._range = 0.0
                self._variance = 0.0
                if fields:
                    set_fields(self, fields)

else:
    class Range(Message):
        """One reading of a range sensor in m, angles in rad."""

        ROS_TYPE = "sensor_msgs/msg/Range"
        SLOT_TYPES = (
            NamespacedType(('std_msgs', 'msg'), 'Header'),
            BasicType('uint8'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
            BasicType('float'),
        )
        ULTRASOUND: Final = 0
        INFRARED: Final = 1

        if TYPE_CHECKING:
            header: Header
            radiation_type: int
            field_of_view: float
            min_range: float
            max_range: float
            range: float
            def __init__(self, *, header: Header = ..., radiation_type: int = ..., field_of_view: float = ..., min_range: float = ..., max_range: float = ..., range: float = ...) -> None: ...
        else:
            __slots__ = ["_header", "_radiation_type", "_field_of_view", "_min_range", "_max_range", "_range"]

            def __init__(self, **fields: Any) -> None:
                self._header = fields.get("header") or Header()
                self._radiation_type = 0
                self._field_of_view = 0.0
                self._min_range = 0.0
                self._max_range = 0.0
                self._range = 0.0
                if fields:
                    set_fields(self, fields)


class RelativeHumidity(Message):
    """Message sensor_msgs/msg/RelativeHumidity."""

    ROS_TYPE = "sensor_msgs/msg/RelativeHumidity"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        header: Header
        relative_humidity: float
        variance: float
        def __init__(self, *, header: Header = ..., relative_humidity: float = ..., variance: float = ...) -> None: ...
    else:
        __slots__ = ["_header", "_relative_humidity", "_variance"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._relative_humidity = 0.0
            self._variance = 0.0
            if fields:
                set_fields(self, fields)


class Temperature(Message):
    """Message sensor_msgs/msg/Temperature."""

    ROS_TYPE = "sensor_msgs/msg/Temperature"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        header: Header
        temperature: float
        variance: float
        def __init__(self, *, header: Header = ..., temperature: float = ..., variance: float = ...) -> None: ...
    else:
        __slots__ = ["_header", "_temperature", "_variance"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._temperature = 0.0
            self._variance = 0.0
            if fields:
                set_fields(self, fields)


class TimeReference(Message):
    """Message sensor_msgs/msg/TimeReference."""

    ROS_TYPE = "sensor_msgs/msg/TimeReference"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'Header'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        header: Header
        time_ref: Time
        source: str
        def __init__(self, *, header: Header = ..., time_ref: Time = ..., source: str = ...) -> None: ...
    else:
        __slots__ = ["_header", "_time_ref", "_source"]

        def __init__(self, **fields: Any) -> None:
            self._header = fields.get("header") or Header()
            self._time_ref = fields.get("time_ref") or Time()
            self._source = ""
            if fields:
                set_fields(self, fields)
