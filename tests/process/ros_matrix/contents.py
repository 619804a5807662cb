# SPDX-License-Identifier: Apache-2.0
"""What both sides of the matrix know: the message types with their contents, and the names of topics and nodes."""

import array
import importlib
import random

NODE, LIFECYCLE_NODE = "peer", "peer_lifecycle"
LATCHED, STATIC, BEST_EFFORT = "/latched", "/tf_static", "/best_effort"
LOG_LINE = "the peer is running"
TYPES = (
    *("std_msgs/String", "std_msgs/ColorRGBA", "std_msgs/Float64MultiArray", "std_msgs/UInt8MultiArray"),
    *("geometry_msgs/PoseStamped", "geometry_msgs/Twist", "geometry_msgs/PoseArray", "geometry_msgs/TransformStamped"),
    *("geometry_msgs/PoseWithCovarianceStamped", "sensor_msgs/LaserScan", "sensor_msgs/Imu", "sensor_msgs/JointState"),
    *("sensor_msgs/CameraInfo", "sensor_msgs/Image", "sensor_msgs/PointCloud2", "sensor_msgs/BatteryState"),
    *("nav_msgs/Odometry", "nav_msgs/OccupancyGrid", "nav_msgs/Path", "visualization_msgs/MarkerArray"),
)
LARGE = {"sensor_msgs/Image": 921_600, "sensor_msgs/PointCloud2": 1_000_000}  # bytes of data

_SCALARS = {
    "boolean": lambda numbers: bool(numbers.getrandbits(1)),
    "float": lambda numbers: numbers.randrange(-1000, 1000) / 8,
    "double": lambda numbers: numbers.randrange(-1000, 1000) / 8,
    "octet": lambda numbers: bytes([numbers.getrandbits(8)]),
    "string": lambda numbers: f"base_link {numbers.randrange(100)} é",
}
for _bits in (8, 16, 32, 64):
    _SCALARS[f"uint{_bits}"] = lambda numbers, bits=_bits: numbers.getrandbits(bits)
    _SCALARS[f"int{_bits}"] = lambda numbers, bits=_bits: numbers.getrandbits(bits) - (1 << (bits - 1))


def topic_of(type_name):
    """Return the topic of a message type."""
    return "/types/" + type_name.replace("/", "_").lower()


def message_class(type_name):
    """Return a message class, given "std_msgs/String"."""
    package, name = type_name.split("/")
    return getattr(importlib.import_module(f"{package}.msg"), name)


def message_of(type_name):
    """Return the message that the peer publishes: random values, which are the same in every process."""
    message = _filled(message_class(type_name)(), random.Random(type_name))
    if (size := LARGE.get(type_name)) is not None:
        message.data = array.array("B", random.Random(size).randbytes(size))
    return message


def plain(value):
    """Return a message as lists and dictionaries, which are equal for equal messages of different libraries."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, (bytes, bytearray, str)):
        return value
    if hasattr(value, "tolist"):
        return value.tolist()
    return [plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def _filled(message, numbers):
    for name, kind in message.get_fields_and_field_types().items():
        setattr(message, name, _value(kind, numbers))
    return message


def _value(kind, numbers):
    if kind.startswith("sequence<"):
        return [_value(kind[9:-1].split(",")[0], numbers) for _ in range(2)]
    if kind.endswith("]"):
        item, _, count = kind[:-1].partition("[")
        return [_value(item, numbers) for _ in range(int(count))]
    if kind in _SCALARS:
        return _SCALARS[kind](numbers)
    return _filled(message_class(kind)(), numbers)
