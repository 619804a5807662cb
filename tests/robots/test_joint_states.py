# SPDX-License-Identifier: Apache-2.0
"""Joint states: default positions, sources, mimic joints and steps."""

import math

import pytest

from coframe.robots import RobotDescriptionError, parse_urdf
from coframe.robots.joint_states import JointStates

LIMIT = "<limit lower='{}' upper='{}' effort='1' velocity='1'/>"


def robot(**joints):
    """Return a robot with a chain of joints, given by name as type and inner XML."""
    links = "".join(f"<link name='l{i}'/>" for i in range(len(joints) + 1))
    described = "".join(
        f"<joint name='{name}' type='{kind}'><parent link='l{i}'/><child link='l{i + 1}'/>{inside}</joint>"
        for i, (name, (kind, inside)) in enumerate(joints.items())
    )
    return parse_urdf(f"<robot name='r'>{links}{described}</robot>")


def mimic(leader, multiplier=1.0, offset=0.0):
    return LIMIT.format(-9, 9) + f"<mimic joint='{leader}' multiplier='{multiplier}' offset='{offset}'/>"


def fields(states):
    fields = states.fields()
    return dict(zip(fields.names, fields.positions, strict=True))


ARM = {
    "spin": ("continuous", ""),
    "lift": ("prismatic", LIMIT.format(0.2, 0.6)),
    "stay": ("fixed", ""),
    "free": ("floating", ""),
    "far": ("revolute", mimic("near", -2, 0.5)),
    "near": ("revolute", mimic("lift", 3, 0.1)),
}


def test_default_positions_and_mimic_joints_in_any_order():
    assert fields(JointStates(robot(**ARM))) == pytest.approx({"spin": 0.0, "lift": 0.4, "far": -2.1, "near": 1.3})
    states = JointStates(robot(**ARM), zeros={"lift": 0.3}, use_mimic_tags=False)
    assert fields(states) == pytest.approx({"spin": 0.0, "lift": 0.3, "far": 0.0, "near": 0.0})


def test_dependent_joints_override_mimic_tags():
    states = JointStates(robot(**ARM), dependent={"near": ("spin", 2.0, 1.0), "gone": ("spin", 1.0, 0.0)})
    states.update(["spin"], [0.25])
    assert fields(states) == pytest.approx({"spin": 0.25, "lift": 0.4, "near": 1.5, "far": -2.5})


def test_sources_override_default_positions_but_not_mimic_joints():
    states = JointStates(robot(**ARM), positions=False)
    assert states.fields() == (["spin", "lift", "far", "near"], [], [], [])
    states.update(["lift", "near", "unknown"], [0.5, 7.0, 8.0], [0.1, 7.0, 8.0], [2.0, 7.0, 8.0])
    names, positions, velocities, efforts = states.fields()
    assert dict(zip(names, positions, strict=True)) == pytest.approx({"spin": 0, "lift": 0.5, "near": 1.6, "far": -2.7})
    assert dict(zip(names, velocities, strict=True)) == pytest.approx(
        {"spin": 0, "lift": 0.1, "near": 0.3, "far": -0.6}
    )
    assert dict(zip(names, efforts, strict=True)) == pytest.approx({"spin": 0, "lift": 2, "near": 2, "far": 2})
    states.update(["spin"], [], [0.5])  # a source can contain only velocities
    assert fields(states)["spin"] == 0.0
    for wrong in ([1.0, 2.0], [float("nan")]):
        with pytest.raises(ValueError, match=r"values|not finite"):
            states.update(["spin"], wrong)


def test_defaults_of_velocities_and_efforts():
    assert JointStates(robot(**ARM), velocities=True, efforts=True).fields()[2:] == ([0.0] * 4, [0.0] * 4)


def test_soft_limits_narrow_the_limits():
    soft = "<safety_controller soft_lower_limit='0.3' soft_upper_limit='9' k_velocity='1'/>"
    arm = robot(lift=("prismatic", LIMIT.format(0.2, 0.6) + soft), spin=("continuous", soft))
    narrow = JointStates(arm).free
    assert (narrow["lift"].lower, narrow["lift"].upper) == (0.3, 0.6)
    assert (narrow["spin"].lower, narrow["spin"].upper) == (0.3, math.pi)
    wide = JointStates(arm, use_smallest_limits=False).free
    assert (wide["lift"].lower, wide["lift"].upper) == (0.2, 0.6)
    assert (wide["spin"].lower, wide["spin"].upper) == (-math.pi, math.pi)


def test_steps_move_joints_back_and_forth_or_around():
    states = JointStates(robot(spin=("continuous", ""), turn=("revolute", LIMIT.format(-1, 1))))
    seen = []
    for _ in range(9):
        states.step(0.75)
        seen.append(tuple(fields(states).values()))
    turns = [turn for _, turn in seen]
    assert turns == pytest.approx([0.75, 1, 0.25, -0.5, -1, -0.25, 0.5, 1, 0.25])
    assert [spin for spin, _ in seen][3:6] == pytest.approx([3.0, -math.pi, -math.pi + 0.75])


@pytest.mark.parametrize(
    ("dependent", "reason"),
    [
        ({"spin": ("near", 1.0, 0.0), "lift": ("spin", 1.0, 0.0)}, r"infinite recursive mimic chain: \['spin', 'near'"),
        ({"spin": ("spin", 1.0, 0.0)}, "infinite recursive mimic chain"),
        ({"spin": ("missing", 1.0, 0.0)}, "joint 'spin' depends on 'missing'"),
        ({"spin": ("free", 1.0, 0.0)}, "joint 'spin' depends on 'free', which is not a revolute"),
    ],
)
def test_invalid_mimic_rules_raise_an_error(dependent, reason):
    with pytest.raises(RobotDescriptionError, match=reason):
        JointStates(robot(**ARM), dependent=dependent)
