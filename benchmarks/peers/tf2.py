"""tf2's Python interface as programs use it, for whoever provides it: Debian's ROS 1, a ROS 2, or coframe.

Nothing but the standard library and tf2 itself: this runs in the provider's Python.
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


def message(link: int, index: int, stamp: int | None = None) -> Any:
    """A link's sample as a TransformStamped."""
    result = geometry_msgs.TransformStamped()
    result.header.frame_id, result.child_frame_id = frame(link), frame(link + 1)
    result.header.stamp = message_time(motion.stamp(link, index) if stamp is None else stamp)
    t, r = result.transform.translation, result.transform.rotation
    t.x, t.y, t.z, r.x, r.y, r.z, r.w = motion.values(link, index)
    return result


def filled(depth: int, samples: int = motion.SAMPLES) -> Any:
    """A buffer with a chain that is so deep."""
    buffer = tf2_py.BufferCore(duration(max(10, samples * motion.STEP // NS + 1)))
    for link in range(depth):
        for index in range(samples):
            buffer.set_transform(message(link, index), "bench")
    return buffer


def asked(depth: int, stamp: int, samples: int = motion.SAMPLES) -> dict[str, Any]:
    """What a question about the whole chain at a time takes."""
    return {
        "buffer": filled(depth, samples),
        "time": time(stamp),
        "source": frame(depth),
        "TransformException": tf2_py.TransformException,
    }


def lookup(depth: int, stamp: int = 0, samples: int = motion.SAMPLES) -> Statement:
    return Statement("buffer.lookup_transform_core('f0', source, time)", asked(depth, stamp, samples))


def can_transform(depth: int, stamp: int = 0) -> Statement:
    return Statement("buffer.can_transform_core('f0', source, time)", asked(depth, stamp))


def failing_lookup(depth: int, then: str = "pass") -> Statement:
    """The time asked for is before all data; the exception is caught, and then something done with it."""
    code = f"""
try:
    buffer.lookup_transform_core('f0', source, time)
except TransformException as error:
    {then}
"""
    return Statement(code, asked(depth, 1))


def time_travel(depth: int) -> Statement:
    code = "buffer.lookup_transform_full_core('f0', time, source, earlier, 'f0')"
    return Statement(code, {**asked(depth, motion.between(400)), "earlier": time(motion.between(300))})


def set_transform() -> Statement:
    """New samples of one link, more than the buffer keeps."""
    count = 8 * motion.SAMPLES
    names = {"buffer": filled(1), "messages": [message(0, index) for index in range(count)]}
    return Statement(
        "buffer.set_transform(next(fresh), 'bench')", names, setup="buffer.clear(); fresh = iter(messages)", limit=count
    )


def cloud(points: int) -> Any:
    """A PointCloud2 of points with intensities, all float32, in the frame that `message(1, ...)` tells of."""
    sensor_msgs: Any = importlib.import_module("sensor_msgs.msg")
    result = sensor_msgs.PointCloud2()
    result.header.frame_id, result.header.stamp = frame(2), message_time(motion.START)
    result.height, result.width, result.point_step, result.row_step = 1, points, 16, 16 * points
    result.fields = [
        sensor_msgs.PointField(name=name, offset=4 * place, datatype=sensor_msgs.PointField.FLOAT32, count=1)
        for place, name in enumerate(("x", "y", "z", "intensity"))
    ]
    result.data = b"".join(struct.pack("<4f", i % 97, i % 89, i % 13, i % 256) for i in range(points))
    result.is_dense = True
    return result


def transform_cloud(points: int) -> Statement:
    """A cloud from one frame to another, message to message."""
    do_transform_cloud = importlib.import_module("tf2_sensor_msgs.tf2_sensor_msgs").do_transform_cloud
    names = {"do_transform_cloud": do_transform_cloud, "cloud": cloud(points), "transform": message(1, 7)}
    return Statement("do_transform_cloud(cloud, transform)", names, items=points)
