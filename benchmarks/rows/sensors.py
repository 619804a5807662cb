# SPDX-License-Identifier: Apache-2.0
"""Transformation of point clouds, and deskewing of points with individual times."""

from collections.abc import Callable, Generator
from typing import Any

import numpy as np

from benchmarks import motion, ours
from benchmarks.measuring import AtMost, Contender, Row, Target, TimesAsFast
from benchmarks.peers import DEBIAN, ROS2, Tf2, by_hand
from benchmarks.rows.batch import batch, filled
from benchmarks.rows.tf2_rows import drop_in, versus_tf2
from benchmarks.statement import Statement

CLOUD = 100_000
SCAN, SCAN_SAMPLES = 1_000_000, 1_000
FIRINGS = 1_800
"""Distinct times in a sweep of a rotating lidar: all channels of a column measure at the same time."""


NEW, INTO = "transform_cloud(cloud, transform)", "transform_cloud(cloud, transform, out=out)"


def transforming(code: str = NEW) -> Statement:
    """Return the transformation of a cloud with intensities, from message to message."""
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


def versus_copying(name: str, code: str, target: Target | None) -> Row:
    def contenders() -> Generator[Contender]:
        from benchmarks.peers import tf2

        yield transforming(code)
        data = np.frombuffer(bytes(tf2.cloud(CLOUD).data), dtype=np.uint8)
        yield batch("data.tobytes()", CLOUD, data=data)

    return Row(name, "floor: copying the bytes", contenders, target)


def versus_numpy() -> Row:
    """Return a row for a matrix product on the fields of the cloud."""

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
    """Return a million float32 points and their times, with a number of distinct times."""
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


def deskew_versus_copying(name: str, times: int, target: Target | None) -> Row:
    def contenders() -> Generator[Contender]:
        yield deskewing(times)
        yield batch("points.copy()", SCAN, **scan(times))

    return Row(f"deskew, 1e6 points, {name}, D=1, per point", "floor: copying the points", contenders, target)


def deskew_versus_hand(reference: str, make: Callable[[Any], Any]) -> Row:
    """Return a row for a peer that computes only the poses, without transforming the points."""

    def contenders() -> Generator[Contender]:
        yield deskewing(SCAN)
        yield batch(
            "other.at(times)", SCAN, other=make([ours.stamps_and_values(0, SCAN_SAMPLES)]), times=scan(SCAN)["times"]
        )

    return Row("deskew, 1e6 points, distinct times, D=1, per point", reference, contenders)


ROWS = [
    versus_tf2(
        "transform_cloud, 1e5 points, per point",
        transforming,
        DEBIAN,
        "transform_cloud",
        CLOUD,
        target=TimesAsFast(500),
        needs=("tf2_sensor_msgs",),
    ),
    versus_copying("transform_cloud, 1e5 points, per point", NEW, AtMost(3)),
    versus_copying("transform_cloud, 1e5 points, into a message, per point", INTO, None),
    versus_numpy(),
    cloud_drop_in(DEBIAN),
    cloud_drop_in(ROS2),
    deskew_versus_copying("distinct times", SCAN, AtMost(10)),
    deskew_versus_copying("1800 times", FIRINGS, None),
    deskew_versus_hand("poses only, numpy by hand", by_hand.Numpy),
    deskew_versus_hand("poses only, scipy's Slerp", by_hand.Scipy),
]
