# SPDX-License-Identifier: Apache-2.0
"""Gravity, lidars and odometry topics contradict wrong transforms (TF029), and never right ones."""

import numpy as np
import pytest
from recordings import START
from runs import MS, SECOND, Run, stamp_message
from scipy.spatial.transform import Rotation

from coframe.messages import find

MOUNT = Rotation.from_euler("xyz", [0.05, -0.04, 0.6])
PLACE = np.array([0.25, -0.1, 0.4])
WALLS = 6.0  # meters from the center of a square room to its walls


def later(seconds):
    return START + round(seconds * SECOND)


def robot(seconds):
    """Return the pose of a robot that drives along a circle on a slope of 0 degrees: position and rotation."""
    return np.array([2 * np.cos(seconds / 3), 2 * np.sin(seconds / 3), 0.0]), Rotation.from_euler(
        "z", seconds / 3 + 1.6
    )


def hits(place, turn, rays):
    """Return the points, in the sensor, at which rays hit the walls, the floor or the ceiling."""
    directions = turn.apply(rays)
    with np.errstate(divide="ignore"):
        low = (np.array([-WALLS, -WALLS, -0.05]) - place) / directions
        high = (np.array([WALLS, WALLS, 3.0]) - place) / directions
    far = np.where(directions > 0, high, low).min(axis=1)
    return rays * far[:, None]


def driving(place=PLACE, turn=None, *, noise=0.0, drift=0.0, still=False, flat=False, skip=()):
    """Return a run of a robot with a lidar (truly at MOUNT), whose transform is published with `place` and `turn`."""
    random = np.random.default_rng(1)
    run = Run()
    run.tf("base_link", "lidar", START, place, MOUNT.as_quat() if turn is None else turn, static=True)
    cloud, field = find("sensor_msgs/msg/PointCloud2"), find("sensor_msgs/msg/PointField")
    fields = [field(name=name, offset=4 * i, datatype=7, count=1) for i, name in enumerate("xyz")]
    bearing = np.linspace(-np.pi, np.pi, 360, endpoint=False)
    heights = [0.0] if flat else np.linspace(-0.3, 0.3, 7)
    rays = np.concatenate([np.stack([np.cos(bearing), np.sin(bearing), np.full(360, z)], axis=1) for z in heights])
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    for i in range(600):
        at = 0.0 if still else i / 50
        where, heading = robot(at)
        published = where + random.normal(0, noise, 3) + [drift * at, 0, 0]
        run.tf("odom", "base_link", later(i / 50), published, heading.as_quat(), arrived=later(i / 50) + MS)
        if i % 5 == 0 and "points" not in skip:
            points = hits(where + heading.apply(PLACE), heading * MOUNT, rays) + random.normal(0, noise, rays.shape)
            message = cloud(height=1, width=len(points), fields=fields, point_step=12, row_step=12 * len(points),
                            data=points.astype("<f4").tobytes(), is_dense=True)  # fmt: skip
            message.header.stamp, message.header.frame_id = stamp_message(later(i / 50)), "lidar"
            run.message("/points", "sensor_msgs/msg/PointCloud2", message, later(i / 50) + 2 * MS)
    return run


@pytest.fixture
def contradictions(examine):
    return lambda run: [one for one in examine(run).every_finding() if one.code == "TF029"]


def test_points_of_a_lidar(only):
    finding = only(driving(turn=np.roll(MOUNT.as_quat(), 1)), "TF029")
    assert finding.edge == ("base_link", "lidar")
    assert finding.text.startswith("the scans of /points do not fit together while the robot moves: joined, ")
    assert finding.text.endswith("if its quaternion is read as w, x, y, z")
    assert "--x 0.25 --y -0.1 --z 0.4 --qx " in finding.fix


@pytest.mark.parametrize(
    ("turn", "reading"),
    [
        (MOUNT.inv(), "its rotation is inverted"),
        (MOUNT**2, "its angle is halved"),
        (MOUNT * Rotation.from_euler("x", 180, True), "it is turned by 180 degrees about its x axis"),
        (MOUNT * Rotation.from_euler("z", 90, True), "it is turned by -90 degrees about its z axis"),
        (Rotation.from_quat(np.roll(MOUNT.as_quat(), -1)), "expects w, x, y, z"),
    ],
)
def test_mistakes_in_the_mount_of_a_lidar(contradictions, turn, reading):
    (finding,) = contradictions(driving(turn=turn.as_quat()))
    assert reading.removesuffix(" degrees about its z axis") in finding.text


def test_an_inverted_mount_of_a_lidar(contradictions):
    (finding,) = contradictions(driving(-MOUNT.inv().apply(PLACE), MOUNT.inv().as_quat()))
    assert "if it is inverted" in finding.text or "if its rotation is inverted" in finding.text


@pytest.mark.parametrize(
    "options",
    [{}, {"noise": 0.03}, {"noise": 0.1}, {"drift": 0.05}, {"drift": 0.3}, {"still": True}, {"flat": True},
     {"flat": True, "noise": 0.05}],
    ids=["clean", "noise", "much noise", "drift", "much drift", "at rest", "one plane", "one plane with noise"],
)  # fmt: skip
def test_right_mounts_are_never_contradicted(examine, options):
    assert examine(driving(**options)).findings == []


def test_a_lidar_at_rest_shows_no_mistake(contradictions):
    assert contradictions(driving(turn=np.roll(MOUNT.as_quat(), 1), still=True)) == []


def with_imu(turn, published, *, moving=False, sign=1.0):
    """Return a healthy run with an IMU that is truly turned by `turn`, and published with `published`."""
    random = np.random.default_rng(2)
    run = Run.healthy()
    run.tf("base_link", "imu", START, (0.05, 0.0, 0.1), published.as_quat(), static=True)
    up = turn.inv().apply([0, 0, 9.81])
    for i in range(1000):
        message = find("sensor_msgs/msg/Imu")()
        message.header.stamp, message.header.frame_id = stamp_message(later(i / 100)), "imu"
        felt = sign * up + random.normal(0, 0.05, 3) + (random.normal(0, 3, 3) if moving else 0)
        for name, vector in (("linear_acceleration", felt), ("angular_velocity", random.normal(0, 0.003, 3))):
            for axis, value in zip("xyz", vector, strict=True):
                setattr(getattr(message, name), axis, float(value))
        run.message("/imu", "sensor_msgs/msg/Imu", message, later(i / 100) + MS)
    return run


IMU = Rotation.from_euler("xyz", [90, 0, 30], True)


TILTED = Rotation.from_euler("xyz", [50, -20, 30], True)


@pytest.mark.parametrize(
    ("turn", "published", "reading"),
    [
        (IMU, Rotation.from_quat(np.roll(IMU.as_quat(), 1)), "if its quaternion is read as w, x, y, z"),
        (IMU, Rotation.from_euler("xyz", [90.0, 0.0, 30.0]), "if its angles are degrees that were used as radians"),
        (IMU, IMU.inv(), "if its rotation is inverted"),
        (TILTED, TILTED**2, "if its angle is halved"),
        (TILTED, Rotation.from_quat(np.roll(TILTED.as_quat(), -1)), "expects w, x, y, z"),
    ],
    ids=["w first", "degrees", "inverted", "half angle", "w last"],
)
def test_gravity_at_rest(examine, turn, published, reading):
    (finding,) = [one for one in examine(with_imu(turn, published)).every_finding() if one.code == "TF029"]
    assert finding.text.startswith("at rest, the acceleration of /imu points ")
    assert reading in finding.text
    assert "it points up within" in finding.text


@pytest.mark.parametrize(
    ("turn", "published", "options"),
    [
        (IMU, IMU, {}),
        (Rotation.identity(), Rotation.identity(), {"sign": -1.0}),
        (IMU, Rotation.from_quat(np.roll(IMU.as_quat(), 1)), {"moving": True}),
        (Rotation.from_euler("xyz", [8, -5, 30], True), Rotation.identity(), {}),
        (Rotation.from_euler("xyz", [31, -17, 30], True), Rotation.from_euler("xyz", [3, 4, 12], True), {}),
    ],
    ids=["right", "acceleration downward", "moving", "on a slope", "no common mistake"],
)
def test_gravity_is_silent_where_nothing_is_certain(contradictions, turn, published, options):
    assert contradictions(with_imu(turn, published, **options)) == []


def with_odometry(wrong, offset=0.0):
    run = driving(skip={"points"})
    rows = list(run.rows)
    run.rows.clear()
    run.rows += [row for row in rows if row[0] != "/tf"]
    for i in range(600):
        where, heading = robot(i / 50)
        where, heading = where + np.array([0.0, 0.0, 0.3]), heading * Rotation.from_euler("x", 0.1)
        place, turn = wrong(where, heading)
        run.tf("odom", "base_link", later(i / 50), place, turn, arrived=later(i / 50) + MS)
        message = find("nav_msgs/msg/Odometry")()
        message.header.stamp, message.header.frame_id = stamp_message(later(i / 50)), "odom"
        message.child_frame_id = "base_link"
        pose = message.pose.pose
        for axis, value in zip("xyz", where + offset, strict=True):
            setattr(pose.position, axis, float(value))
        for axis, value in zip("xyzw", heading.as_quat(), strict=True):
            setattr(pose.orientation, axis, float(value))
        run.message("/odom", "nav_msgs/msg/Odometry", message, later(i / 50) + MS)
    return run


@pytest.mark.parametrize(
    ("wrong", "reading"),
    [
        (lambda place, turn: (place, np.roll(turn.as_quat(), 1)), "if its quaternion is read as w, x, y, z"),
        (lambda place, turn: (-turn.inv().apply(place), turn.inv().as_quat()), "if it is inverted"),
        (lambda place, turn: (place / 1000, turn.as_quat()), "millimeters"),
        (lambda place, turn: (place * [1, -1, 1], turn.as_quat()), "if the sign of y is changed"),
    ],
    ids=["w first", "inverted", "millimeters", "sign"],
)
def test_odometry_topic(contradictions, wrong, reading):
    (finding,) = contradictions(with_odometry(wrong))
    assert finding.edge == ("odom", "base_link")
    assert finding.text.startswith("differs from /odom: ")
    assert reading in finding.text


@pytest.mark.parametrize("offset", [0.0, 0.2])
def test_an_estimate_may_differ_from_its_odometry(contradictions, offset):
    assert contradictions(with_odometry(lambda place, turn: (place, turn.as_quat()), offset)) == []


def test_hostile_values_give_no_findings_and_no_exceptions(contradictions):
    run = driving(turn=MOUNT.as_quat())
    cloud, field = find("sensor_msgs/msg/PointCloud2"), find("sensor_msgs/msg/PointField")
    fields = [field(name=name, offset=8 * i, datatype=8, count=1) for i, name in enumerate("xyz")]
    values = np.tile([np.nan, np.inf, -np.inf, 1e300, -1e300, 0.0], (100, 1))
    for i in range(20):
        at = later(1 + i / 10)
        message = cloud(height=1, width=200, fields=fields, point_step=24, row_step=4800, data=values.tobytes())
        message.header.stamp, message.header.frame_id = stamp_message(at), "lidar"
        run.message("/bad_points", "sensor_msgs/msg/PointCloud2", message, at)
        short = cloud(height=1, width=2_000_000, fields=fields, point_step=24, row_step=4800, data=b"123")
        short.header.stamp, short.header.frame_id = stamp_message(at), "lidar"
        run.message("/short", "sensor_msgs/msg/PointCloud2", short, at)
        scan = find("sensor_msgs/msg/LaserScan")(time_increment=float("inf"), ranges=[1.0, float("nan"), 1e38])
        scan.header.stamp, scan.header.frame_id = stamp_message(at), "lidar"
        run.message("/bad_scan", "sensor_msgs/msg/LaserScan", scan, at)
        imu = find("sensor_msgs/msg/Imu")()
        imu.header.stamp, imu.header.frame_id = stamp_message(at), "lidar"
        imu.linear_acceleration.x = imu.angular_velocity.z = float("inf")
        run.message("/imu", "sensor_msgs/msg/Imu", imu, at)
        odometry = find("nav_msgs/msg/Odometry")(child_frame_id="base_link")
        odometry.header.stamp, odometry.header.frame_id = stamp_message(at), "odom"
        odometry.pose.pose.orientation.w = 0.0 if i % 2 else float("nan")
        run.message("/odom", "nav_msgs/msg/Odometry", odometry, at)
    assert contradictions(run) == []
