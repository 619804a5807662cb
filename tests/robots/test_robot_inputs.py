# SPDX-License-Identifier: Apache-2.0
"""Positions as arrays and JointStates, robots over time, Jacobians of points, limits."""

import numpy as np
import pytest

import coframe
from coframe.robots import parse_urdf
from sensor_msgs.msg import JointState

SECOND = 1_000_000_000
ARM = """
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="hand"/><link name="left"/><link name="right"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0" rpy="0.3 0 0"/>
    <axis xyz="0 1 0"/></joint>
  <joint name="slide" type="prismatic"><parent link="lower"/><child link="hand"/><origin xyz="0.5 0 0"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.2" effort="1" velocity="1"/></joint>
  <joint name="left_finger" type="prismatic"><parent link="hand"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.05" effort="1" velocity="1"/></joint>
  <joint name="right_finger" type="prismatic"><parent link="hand"/><child link="right"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.05" effort="1" velocity="1"/><mimic joint="left_finger"/></joint>
</robot>
"""
FREE = ("shoulder", "elbow", "slide", "left_finger")


@pytest.fixture
def robot():
    return parse_urdf(ARM)


def joint_state(stamp, **positions):
    message = JointState(name=list(positions), position=list(positions.values()))
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
    return message


def test_arrays_and_messages_are_positions_too(robot):
    assert robot.free_joints == FREE
    values = [0.1, 0.2, 0.05, 0.01]
    by_name = robot.frames(dict(zip(FREE, values, strict=True)))
    assert robot.frames(values) == robot.frames(np.array(values)) == by_name
    assert robot.frames(joint_state(0, **dict(zip(FREE, values, strict=True)), wheel=3.0)) == by_name
    batch = robot.frames(np.array([values, values]))
    assert batch["hand"].shape == (2,)
    assert batch["hand"][1].is_close(by_name["hand"])
    assert robot.jacobian("hand", np.array([values])).shape == (1, 6, 4)
    assert robot.joint_transforms(values)["elbow"].is_close(robot.joint_transforms({"elbow": 0.2})["elbow"])


def test_wrong_positions_name_the_joints(robot):
    with pytest.raises(ValueError, match=r"shape \(4,\) or \(N, 4\), with a column for each of shoulder, elbow"):
        robot.frames([0.1, 0.2])
    with pytest.raises(ValueError, match="the position of joint 'elbow' is not finite"):
        robot.frames([0.1, np.nan, 0, 0])
    with pytest.raises(ValueError, match=r"No joint named 'elbw'. Did you mean 'elbow'"):
        robot.frames({"elbw": 1.0})
    with pytest.raises(ValueError, match=r"contains wheel. Known joints: shoulder, elbow, slide"):
        robot.frames(joint_state(0, wheel=1.0))
    with pytest.raises(ValueError, match="has 1 names and 0 positions"):
        robot.frames(JointState(name=["elbow"]))


def numerical_jacobian(robot, frame, values, point):
    """Velocities of a point along the axes of the root, from small steps."""
    step = 1e-6
    columns = []
    for i in range(len(values)):
        poses = []
        for sign in (1, -1):
            moved = np.array(values)
            moved[i] += sign * step
            poses.append(robot.frames(moved)[frame])
        linear = (poses[0] @ point - poses[1] @ point) / (2 * step)
        turn = (poses[0] @ poses[1].inverse().replace(target=poses[0].source, source=None)).as_rotvec() / (2 * step)
        columns.append(np.concatenate([linear, turn]))
    return np.stack(columns, axis=1)


def test_jacobians_of_points_along_any_axes(robot):
    values, point = [0.3, -0.7, 0.1, 0.02], [0.2, -0.1, 0.4]
    for frame in ("hand", "right"):
        expected = numerical_jacobian(robot, frame, values, point)
        np.testing.assert_allclose(robot.jacobian(frame, values, point=point), expected, atol=1e-8)
        for axes in (frame, "upper"):
            back = robot.frames(values)[axes].rotation.T
            turned = np.concatenate([back @ expected[:3], back @ expected[3:]])
            found = robot.jacobian(frame, values, point=point, expressed_in=axes)
            np.testing.assert_allclose(found, turned, atol=1e-8)
    assert not robot.jacobian("base", values, point=point).any()
    many = robot.jacobian("hand", np.array([values] * 3), point=point, expressed_in="hand")
    np.testing.assert_allclose(many[2], robot.jacobian("hand", values, point=point, expressed_in="hand"), atol=1e-15)
    with pytest.raises(ValueError, match="No link named 'hnd'"):
        robot.jacobian("hand", values, expressed_in="hnd")


def test_limits_are_checked_and_clipped(robot):
    given = {"shoulder": [-1.5, 0.5, 1.25], "elbow": 100.0, "left_finger": 0.06}
    outside = robot.limit_violations(given)
    assert outside["shoulder"].tolist() == [-0.5, 0.0, 0.25]
    assert outside["left_finger"] == pytest.approx([0.01] * 3)
    assert outside["right_finger"] == pytest.approx([0.01] * 3)  # it follows
    assert outside.keys() == {"shoulder", "left_finger", "right_finger"}
    clipped = robot.clip(given)
    assert clipped["shoulder"].tolist() == [-1.0, 0.5, 1.0]
    assert (clipped["elbow"], clipped["left_finger"]) == (100.0, pytest.approx(0.05))
    assert robot.limit_violations(clipped) == {}


def test_joint_states_become_a_buffer(robot):
    messages = [joint_state(s * SECOND, shoulder=0.1 * s, elbow=0.2 * s) for s in (3, 1, 2)]
    messages += [joint_state(s * SECOND, left_finger=0.01 * s) for s in (1, 3)]
    buffer = robot.buffer(messages)
    when = 2 * SECOND + SECOND // 2
    expected = robot.frames({"shoulder": 0.25, "elbow": 0.5, "left_finger": 0.025})
    for link in ("lower", "hand", "left", "right"):
        assert buffer.lookup("base", link, when).is_close(expected[link], translation=1e-12, rotation=1e-12)
    assert [edge.child for edge in buffer.edges() if edge.static] == ["hand"]  # nothing moves the slide
    assert buffer.span("base", "right") == (SECOND, 3 * SECOND)
    with pytest.raises(ValueError, match="the list contains no JointState message"):
        robot.buffer([])


def test_arrays_with_stamps_become_a_buffer(robot):
    times = np.array([1, 2]) * SECOND
    buffer = robot.buffer(np.array([[0.0, 0, 0, 0], [1.0, 0, 0.1, 0]]), times)
    expected = robot.frames({"shoulder": 0.5, "slide": 0.05})["hand"]
    assert buffer.lookup("base", "hand", 3 * SECOND // 2).is_close(expected, translation=1e-12, rotation=1e-12)


def test_a_robot_is_shown(robot):
    pytest.importorskip("websockets")
    for positions in (None, [0.1, 0.2, 0.0, 0.0], [joint_state(SECOND, elbow=1.0), joint_state(2 * SECOND, elbow=2.0)]):
        with robot.show(positions, port=0) as viewer:
            assert viewer.url.startswith("http://127.0.0.1:")
    with pytest.raises(ValueError, match="takes one configuration"):
        robot.show(np.zeros((2, 4)), port=0)


def test_pinocchio_is_asked_for_by_name(robot, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pinocchio", None)
    with pytest.raises(ModuleNotFoundError, match="pip install pin"):
        robot.to_pinocchio()
    with pytest.raises(ModuleNotFoundError, match="pip install pin"):
        coframe.Transform().as_pinocchio()
