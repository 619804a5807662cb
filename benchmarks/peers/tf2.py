# SPDX-License-Identifier: Apache-2.0
"""Programs that use tf2's Python interface, for any provider: Debian's ROS 1, a ROS 2, or coframe.

This module uses only the standard library and tf2, because it runs in the provider's Python.
"""

import importlib
import struct
from typing import Any

from benchmarks import motion
from benchmarks.motion import NS, frame
from benchmarks.statement import Statement

tf2_py: Any = importlib.import_module("tf2_py")
geometry_msgs: Any = importlib.import_module("geometry_msgs.msg")

try:
    importlib.import_module("rclpy")
except ImportError:
    genpy: Any = importlib.import_module("genpy")

    def time(stamp: int) -> Any:
        return genpy.Time(stamp // NS, stamp % NS)

    def message_time(stamp: int) -> Any:
        return time(stamp)

    def duration(seconds: int) -> Any:
        return genpy.Duration(seconds)
else:
    rclpy_time: Any = importlib.import_module("rclpy.time")
    rclpy_duration: Any = importlib.import_module("rclpy.duration")

    def time(stamp: int) -> Any:
        return rclpy_time.Time(nanoseconds=stamp)

    def message_time(stamp: int) -> Any:
        return time(stamp).to_msg()

    def duration(seconds: int) -> Any:
        return rclpy_duration.Duration(seconds=seconds)


def message(edge: int, index: int, stamp: int | None = None) -> Any:
    """Return a sample of an edge as a TransformStamped."""
    result = geometry_msgs.TransformStamped()
    result.header.frame_id, result.child_frame_id = frame(edge), frame(edge + 1)
    result.header.stamp = message_time(motion.stamp(edge, index) if stamp is None else stamp)
    t, r = result.transform.translation, result.transform.rotation
    t.x, t.y, t.z, r.x, r.y, r.z, r.w = motion.values(edge, index)
    return result


def filled(depth: int, samples: int = motion.SAMPLES) -> Any:
    """Return a buffer with a chain of this depth."""
    buffer = tf2_py.BufferCore(duration(max(10, samples * motion.STEP // NS + 1)))
    for edge in range(depth):
        for index in range(samples):
            buffer.set_transform(message(edge, index), "bench")
    return buffer


def names_for(depth: int, stamp: int, samples: int = motion.SAMPLES) -> dict[str, Any]:
    """Return the names that a lookup over the whole chain uses."""
    return {
        "buffer": filled(depth, samples),
        "time": time(stamp),
        "source": frame(depth),
        "TransformException": tf2_py.TransformException,
    }


def lookup(depth: int, stamp: int = 0, samples: int = motion.SAMPLES) -> Statement:
    return Statement("buffer.lookup_transform_core('f0', source, time)", names_for(depth, stamp, samples))


def can_transform(depth: int, stamp: int = 0) -> Statement:
    return Statement("buffer.can_transform_core('f0', source, time)", names_for(depth, stamp))


def failing_lookup(depth: int, then: str = "pass") -> Statement:
    """Return a lookup before all data, whose exception is caught and passed to the statement `then`."""
    code = f"""
try:
    buffer.lookup_transform_core('f0', source, time)
except TransformException as error:
    {then}
"""
    return Statement(code, names_for(depth, 1))


def time_travel(depth: int) -> Statement:
    code = "buffer.lookup_transform_full_core('f0', time, source, earlier, 'f0')"
    return Statement(code, {**names_for(depth, motion.between(400)), "earlier": time(motion.between(300))})


def set_transform() -> Statement:
    """Return the insertion of new samples of one edge, more than the buffer keeps."""
    count = 8 * motion.SAMPLES
    names = {"buffer": filled(1), "messages": [message(0, index) for index in range(count)]}
    return Statement(
        "buffer.set_transform(next(fresh), 'bench')", names, setup="buffer.clear(); fresh = iter(messages)", limit=count
    )


def cloud(points: int) -> Any:
    """Return a PointCloud2 with float32 points and intensities, in the child frame of `message(1, ...)`."""
    sensor_msgs: Any = importlib.import_module("sensor_msgs.msg")
    result = sensor_msgs.PointCloud2()
    result.header.frame_id, result.header.stamp = frame(2), message_time(motion.START)
    result.height, result.width, result.point_step, result.row_step = 1, points, 16, 16 * points
    result.fields = [
        sensor_msgs.PointField(name=name, offset=4 * index, datatype=sensor_msgs.PointField.FLOAT32, count=1)
        for index, name in enumerate(("x", "y", "z", "intensity"))
    ]
    result.data = b"".join(struct.pack("<4f", i % 97, i % 89, i % 13, i % 256) for i in range(points))
    result.is_dense = True
    return result


def transform_cloud(points: int) -> Statement:
    """Return the transformation of a cloud, from message to message."""
    do_transform_cloud = importlib.import_module("tf2_sensor_msgs.tf2_sensor_msgs").do_transform_cloud
    names = {"do_transform_cloud": do_transform_cloud, "cloud": cloud(points), "transform": message(1, 7)}
    return Statement("do_transform_cloud(cloud, transform)", names, items=points)
