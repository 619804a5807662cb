# SPDX-License-Identifier: Apache-2.0
"""The doctor names the mistake behind a wrong transform if other data shows the right one, and no other cause."""

import numpy as np
import pytest
from recordings import START
from runs import MS, SECOND, Run, rpy, yaw
from scipy.spatial.transform import Rotation

from coframe.messages import find

MOUNT = """<robot name="r"><link name="base_link"/><link name="lidar"/><link name="arm"/><link name="slide"/>
<joint name="mount" type="fixed"><parent link="base_link"/><child link="lidar"/>
<origin xyz="0.1 -0.2 0.3" rpy="0.1 -0.4 1.2"/></joint>
<joint name="turn" type="continuous"><parent link="base_link"/><child link="arm"/><axis xyz="0 0 1"/>
<origin xyz="0 0 0.5" rpy="0.3 0 0"/></joint>
<joint name="lift" type="prismatic"><parent link="base_link"/><child link="slide"/><axis xyz="0 0 1"/>
<limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>"""
PLACE, TURN = np.array([0.1, -0.2, 0.3]), Rotation.from_euler("xyz", [0.1, -0.4, 1.2])


@pytest.fixture
def found(examine):
    """Return the only finding with a code."""

    def found(run, code):
        (finding,) = [one for one in examine(run).every_finding() if one.code == code]
        return finding

    return found


def later(seconds):
    return START + round(seconds * SECOND)


def described():
    run = Run.healthy(skip={"static"})
    run.message("/robot_description", "std_msgs/msg/String", find("std_msgs/msg/String")(data=MOUNT), START)
    for i in range(100):
        message = find("sensor_msgs/msg/JointState")(name=["turn", "lift"], position=angles(i))
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(later(i / 20), SECOND)
        run.message("/joint_states", "sensor_msgs/msg/JointState", message, later(i / 20))
    return run


def angles(i):
    return [1.0 + 0.01 * i, 0.2 + 0.001 * i]


def moving(run, arm=lambda q: q, slide=lambda q: q):
    for i in range(100):
        q, s = angles(i)
        turn = Rotation.from_euler("x", 0.3) * Rotation.from_euler("z", arm(q))
        run.tf("base_link", "arm", later(i / 20), (0, 0, 0.5), turn.as_quat())
        run.tf("base_link", "slide", later(i / 20), (0, 0, slide(s)))


@pytest.mark.parametrize(
    ("place", "turn", "cause", "fix"),
    [
        (
            PLACE,
            np.roll(TURN.as_quat(), 1),
            "the pose agrees with it within 0 mm and 0 degrees if its quaternion is read as w, x, y, z",
            "A quaternion of ROS is x, y, z, w",
        ),
        (-TURN.inv().apply(PLACE), TURN.inv().as_quat(), "if it is inverted", "publish transform.inverse()"),
        (PLACE * 1000, TURN.as_quat(), "if its translation is read in millimeters", "divide by 1000"),
        (PLACE, Rotation.from_euler("xyz", np.degrees([0.1, -0.4, 1.2])).as_quat(), "used as radians", "math.radians"),
        (PLACE, (TURN**2).as_quat(), "if its angle is halved", "math.sin(yaw / 2)"),
        (PLACE, Rotation.from_euler("xyz", [1.2, -0.4, 0.1]).as_quat(), "the order yaw, pitch, roll", "order"),
    ],
    ids=["w first", "inverted", "millimeters", "degrees", "half angle", "order of angles"],
)
def test_wrong_mounts_are_explained_by_the_robot_description(found, place, turn, cause, fix):
    run = described()
    run.tf("base_link", "lidar", START, place, turn, static=True)
    moving(run)
    finding = found(run, "TF023")
    assert cause in finding.text
    assert fix in finding.fix
    assert "Another node" not in finding.why


def test_a_mount_that_was_only_moved_has_no_cause(found):
    run = described()
    run.tf("base_link", "lidar", START, PLACE * 1.1, rpy(0.12, -0.4, 1.2), static=True)
    moving(run)
    finding = found(run, "TF023")
    assert " if " not in finding.text
    assert finding.fix.startswith("Decide which pose is correct.")


@pytest.mark.parametrize(
    ("wrong", "edge", "cause"),
    [
        ({"arm": np.degrees}, "arm", "their values in degrees were used as radians"),
        ({"arm": np.radians}, "arm", "converted from degrees to radians twice"),
        ({"arm": np.negative}, "arm", "the joint positions have the opposite sign"),
        ({"arm": lambda q: 2 * q}, "arm", "sin(angle) was used for sin(angle / 2)"),
        ({"slide": lambda s: 1000 * s}, "slide", "their values in millimeters were used"),
    ],
    ids=["degrees", "twice", "sign", "half angle", "millimeters"],
)
def test_wrong_joints_are_explained_by_the_joint_states(found, wrong, edge, cause):
    run = described()
    run.tf("base_link", "lidar", START, PLACE, TURN.as_quat(), static=True)
    moving(run, **wrong)
    finding = found(run, "TF023")
    assert finding.edge == ("base_link", edge)
    assert cause in finding.text


def test_a_joint_that_moves_by_another_law_has_no_cause(found):
    run = described()
    run.tf("base_link", "lidar", START, PLACE, TURN.as_quat(), static=True)
    moving(run, arm=lambda q: q + 0.2 * np.sin(q))
    finding = found(run, "TF023")
    assert " if " not in finding.text


def flickering(wrong):
    """Return a run of a robot on a slope, whose pose is published by two nodes."""
    run = Run.healthy(skip={"odom"})
    for i in range(600):
        turn = Rotation.from_euler("xyz", [0.1, 0.2, 0.5 + i / 100])
        place = np.array([i / 100, 0.3, 0.1])
        run.tf("odom", "base_link", later(i / 50), place, turn.as_quat(), arrived=later(i / 50) + MS)
        run.tf("odom", "base_link", later(i / 50) + MS, *wrong(place, turn), arrived=later(i / 50) + 2 * MS)
    return run


@pytest.mark.parametrize(
    ("wrong", "cause"),
    [
        (lambda place, turn: (place, np.roll(turn.as_quat(), 1)), "if its quaternion is read as w, x, y, z"),
        (lambda place, turn: (-turn.inv().apply(place), turn.inv().as_quat()), "if it is inverted"),
        (lambda place, turn: (place * 1000, turn.as_quat()), "if its translation is read in millimeters"),
        (lambda place, turn: (place + 0.2, turn.as_quat()), None),
    ],
    ids=["w first", "inverted", "millimeters", "another place"],
)
def test_two_publishers_that_disagree(found, wrong, cause):
    finding = found(flickering(wrong), "TF003")
    assert ("one of them agrees with the other" in finding.text) == (cause is not None)
    assert (cause or "jumps") in finding.text


@pytest.mark.parametrize("at", [200, 400])
def test_a_pose_that_jumps_into_another_order_of_the_quaternion(found, at):
    run = Run.healthy(skip={"odom"})
    for i in range(600):
        turn = Rotation.from_euler("z", i / 300).as_quat()
        run.tf("odom", "base_link", later(i / 50), (i / 100, 0, 0), np.roll(turn, 1) if i >= at else turn)
    finding = found(run, "TF020")
    assert "after the jump, the pose agrees with that before within " in finding.text
    assert finding.text.endswith("if its quaternion is read as w, x, y, z")


def test_a_robot_that_was_moved_has_no_cause(found):
    run = Run.healthy(skip={"odom"})
    for i in range(600):
        run.tf("odom", "base_link", later(i / 50), (i / 100 + 7 * (i >= 300), 0, 0), yaw(i / 300 + 2 * (i >= 300)))
    finding = found(run, "TF020")
    assert " if " not in finding.text


def test_static_and_dynamic_values_of_one_edge(found):
    run = Run.healthy(skip={"scan"})
    turn = Rotation.from_euler("xyz", [0.1, 0.2, 0.7])
    run.tf("base_link", "camera", START, PLACE, np.roll(turn.as_quat(), 1), static=True)
    for i in range(100):
        run.drive(later(i / 10), "base_link", "camera")
        run.rows.pop()
        run.tf("base_link", "camera", later(i / 10), PLACE, turn.as_quat())
    text = found(run, "TF005").text
    assert "the pose on /tf_static agrees with that on /tf within 0 mm and 0 degrees" in text
    assert text.endswith("if its quaternion is read as w, x, y, z")
