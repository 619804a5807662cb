"""Clouds of points seen from another frame, and points that were each taken at a time of their own."""

from collections.abc import Callable, Generator
from typing import Any

import numpy as np

from benchmarks import motion, ours
from benchmarks.measuring import AtMost, Bar, Contender, Row, TimesAsFast
from benchmarks.peers import DEBIAN, ROS2, Tf2, by_hand
from benchmarks.rows.batch import batch, filled
from benchmarks.rows.beside_tf2 import beside_tf2, drop_in
from benchmarks.statement import Statement

CLOUD = 100_000
SCAN, SCAN_SAMPLES = 1_000_000, 1_000
FIRINGS = 1_800
"""Times in a scan of a rotating lidar: all channels of a column measure at once."""


NEW, INTO = "transform_cloud(cloud, transform)", "transform_cloud(cloud, transform, out=out)"


def transforming(code: str = NEW) -> Statement:
    """A cloud of points with intensities, message to message."""
    from benchmarks.peers import tf2
    from coframe.sensors import transform_cloud

    cloud = tf2.cloud(CLOUD)
    names = {
        "transform_cloud": transform_cloud,
        "cloud": cloud,
        "out": tf2.cloud(CLOUD),
        "transform": tf2.message(1, 7),
    }
    return batch(code, CLOUD, **names)


def beside_copying(name: str, code: str, bar: Bar | None) -> Row:
    def contenders() -> Generator[Contender]:
        from benchmarks.peers import tf2

        yield transforming(code)
        data = np.frombuffer(bytes(tf2.cloud(CLOUD).data), dtype=np.uint8)
        yield batch("data.tobytes()", CLOUD, data=data)

    return Row(name, "floor: copying the bytes", contenders, bar)


def beside_numpy() -> Row:
    """The cloud's fields as an array, a matrix product, and back."""

    def contenders() -> Generator[Contender]:
        from benchmarks.peers import tf2
        from coframe import Transform

        yield transforming()
        x, y, z, qx, qy, qz, qw = motion.values(1, 7)
        matrix = Transform([x, y, z], [qx, qy, qz, qw]).matrix.astype(np.float32)
        names = {"data": bytes(tf2.cloud(CLOUD).data), "np": np, "rotation": matrix[:3, :3].T, "offset": matrix[:3, 3]}
        code = """
points = np.frombuffer(data, np.float32).reshape(-1, 4).copy()
points[:, :3] = points[:, :3] @ rotation + offset
points.tobytes()
"""
        yield batch(code, CLOUD, **names)

    return Row("transform_cloud, 1e5 points, per point", "numpy by hand", contenders)


def cloud_drop_in(peer: Tf2) -> Row:
    name = "tf2_sensor_msgs: do_transform_cloud, per point"
    return drop_in(name, peer, "transform_cloud", CLOUD, needs=("tf2_sensor_msgs",))


def scan(times: int) -> dict[str, Any]:
    """A million points of float32, measured at so many times."""
    instants = ours.random_times(times, SCAN_SAMPLES, in_order=True)
    return {
        "points": np.random.default_rng(7).uniform(-50.0, 50.0, (SCAN, 3)).astype(np.float32),
        "times": np.repeat(instants, -(-SCAN // times))[:SCAN],
    }


def deskewing(times: int) -> Statement:
    from coframe.sensors import deskew

    stamp = motion.between(SCAN_SAMPLES // 2)
    names = {"deskew": deskew, "buffer": filled(1, SCAN_SAMPLES), "stamp": stamp, **scan(times)}
    return batch("deskew(points, times, buffer, 'f1', source='f1', fixed='f0', at=stamp)", SCAN, **names)


def deskew_beside_copying(name: str, times: int, bar: Bar | None) -> Row:
    def contenders() -> Generator[Contender]:
        yield deskewing(times)
        yield batch("points.copy()", SCAN, **scan(times))

    return Row(f"deskew, 1e6 points, {name}, D=1, per point", "floor: copying the points", contenders, bar)


def deskew_beside_hand(beside: str, make: Callable[[Any], Any]) -> Row:
    """Theirs is only the poses: what it takes to move the points comes on top."""

    def contenders() -> Generator[Contender]:
        yield deskewing(SCAN)
        yield batch(
            "other.at(times)", SCAN, other=make([ours.stamps_and_values(0, SCAN_SAMPLES)]), times=scan(SCAN)["times"]
        )

    return Row("deskew, 1e6 points, distinct times, D=1, per point", beside, contenders)


ROWS = [
    beside_tf2(
        "transform_cloud, 1e5 points, per point",
        transforming,
        DEBIAN,
        "transform_cloud",
        CLOUD,
        bar=TimesAsFast(500),
        needs=("tf2_sensor_msgs",),
    ),
    beside_copying("transform_cloud, 1e5 points, per point", NEW, AtMost(3)),
    beside_copying("transform_cloud, 1e5 points, into a message, per point", INTO, None),
    beside_numpy(),
    cloud_drop_in(DEBIAN),
    cloud_drop_in(ROS2),
    deskew_beside_copying("distinct times", SCAN, AtMost(10)),
    deskew_beside_copying("1800 times", FIRINGS, None),
    deskew_beside_hand("poses alone, numpy by hand", by_hand.Numpy),
    deskew_beside_hand("poses alone, scipy's Slerp", by_hand.Scipy),
]
