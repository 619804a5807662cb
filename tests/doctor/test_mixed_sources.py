# SPDX-License-Identifier: Apache-2.0
"""Topics with the messages of two sources are found; those that have several by design are not."""

import numpy as np
import pytest
from recordings import START
from runs import SECOND, Run, stamp_message, yaw

from coframe.messages import find

SCAN = "sensor_msgs/msg/LaserScan"
ODOMETRY = "nav_msgs/msg/Odometry"
POSE = "geometry_msgs/msg/PoseStamped"


def at(seconds):
    return START + round(seconds * SECOND)


def robot():
    """Return a run with two lidars, whose scans are not in it yet."""
    run = Run.healthy(skip={"scan"})
    run.tf("base_link", "rear_lidar", START, (-0.1, 0.0, 0.3), static=True)
    return run


def pose(run, seconds, place, type_=ODOMETRY, topic="/odometry", frame="odom"):
    message = find(type_)()
    message.header.stamp, message.header.frame_id = stamp_message(at(seconds)), frame
    where = message.pose if type_ == POSE else message.pose.pose
    where.position.x, where.position.y = map(float, place)
    where.orientation.z, where.orientation.w = yaw(0.0)[2:]
    run.message(topic, type_, message, at(seconds + 0.001))


def test_scans_of_two_lidars_on_one_topic(only):
    run = robot()
    for i in range(100):
        run.scan(at(i / 10), "lidar")
        run.scan(at(i / 10 + 0.03), "rear_lidar")
    finding = only(run, "TF028")
    assert finding.topic == "/scan"
    assert "alternate between 2 frames: 'lidar' (100 messages), 'rear_lidar' (100 messages)" in finding.text
    assert "merge A B --prefix" in finding.fix


def test_a_rare_second_source_far_into_a_long_topic(only):
    run = robot()
    for i in range(1100):
        run.scan(at(i / 100), "rear_lidar" if 500 <= i < 800 and i % 2 else "lidar")
    assert "'rear_lidar' (150 messages)" in only(run, "TF028").text


@pytest.mark.parametrize("type_", [ODOMETRY, POSE, "geometry_msgs/msg/PoseWithCovarianceStamped"])
def test_the_odometry_of_two_robots_with_equal_frames(only, type_):
    run, random = robot(), np.random.default_rng(7)
    for i in range(550):
        seconds = i / 50
        if i % 50 < 25 or random.random() < 0.7:  # not one after the other
            pose(run, seconds, (seconds * 0.3, 0.0), type_)
        pose(run, seconds + 0.007, (3.0 - seconds * 0.2, 1.0), type_)
    assert "jump back and forth between two tracks" in only(run, "TF028").text


@pytest.mark.parametrize("place", ["still", "driving", "noisy", "corrected", "circle"])
def test_one_robot_is_one_source(examine, place):
    run, random = robot(), np.random.default_rng(3)
    for i in range(550):
        where = {
            "still": (0.0, 0.0),
            "driving": (i / 50, 0.0),
            "noisy": (i / 500 + random.normal() * 0.3, random.normal() * 0.3),
            "corrected": (i / 50 + (i // 200) * 5.0, 0.0),
            "circle": (np.cos(i / 10), np.sin(i / 10)),
        }[place]
        pose(run, i / 50, where)
    assert examine(run).findings == []


def test_the_frame_may_change_when_a_driver_is_restarted(examine):
    run = robot()
    for i in range(100):
        run.scan(at(i / 10), "lidar" if i < 50 else "rear_lidar")
    assert examine(run).findings == []


@pytest.mark.parametrize(
    ("type_", "topic"),
    [
        ("visualization_msgs/msg/Marker", "/markers"),
        ("sensor_msgs/msg/Range", "/sonars"),
        ("geometry_msgs/msg/PointStamped", "/clicked_point"),
        (POSE, "/goal_pose"),
    ],
)
def test_topics_that_have_several_sources_by_design(examine, type_, topic):
    run = robot()
    for i in range(100 if type_ != POSE else 11):
        if type_ == POSE:
            pose(run, i + 0.5, (i % 2 * 5.0, 0.0), POSE, topic)
            continue
        message = find(type_)()
        message.header.stamp = stamp_message(at(i / 10))
        message.header.frame_id = "lidar" if i % 2 else "rear_lidar"
        run.message(topic, type_, message, at(i / 10))
    assert examine(run).findings == []
