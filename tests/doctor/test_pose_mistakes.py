# SPDX-License-Identifier: Apache-2.0
"""Mistakes in poses are recognized by trial; SciPy, not coframe, makes the wrong poses."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from coframe import quaternion
from coframe.doctor.pose_mistakes import corrections, explain

MOUNTS = ([10.0, -20.0, 130.0], [-90.0, 0.0, -75.0], [0.0, 0.0, 40.0], [0.0, 35.0, 0.0], [170.0, 5.0, -30.0])
PLACE = np.array([0.31, -0.12, 0.74])


def pose(rotation, place=PLACE):
    return np.concatenate([place, rotation.as_quat()])[None]


def reading(wrong, right):
    found = explain(wrong, right)
    return None if found is None else found.reading


WRONG_ROTATIONS = {
    "read as w, x, y, z": lambda a: Rotation.from_quat(np.roll(Rotation.from_euler("xyz", a, True).as_quat(), 1)),
    "expects w, x, y, z": lambda a: Rotation.from_quat(np.roll(Rotation.from_euler("xyz", a, True).as_quat(), -1)),
    "degrees that were used as radians": lambda a: Rotation.from_euler("xyz", a),
    "degrees to radians twice": lambda a: Rotation.from_euler("xyz", np.radians(a), True),
    "rotation is inverted": lambda a: Rotation.from_euler("xyz", a, True).inv(),
    "halved": lambda a: Rotation.from_euler("xyz", a, True) ** 2,
    "halved twice": lambda a: Rotation.from_euler("xyz", a, True) ** 0.5,
    "fixed axes": lambda a: Rotation.from_euler("XYZ", a, True),
    "order yaw, pitch, roll": lambda a: Rotation.from_euler("ZYX", a, True),
    "about its z axis": lambda a: Rotation.from_euler("xyz", a, True) * Rotation.from_euler("z", -90, True),
    "OpenGL": lambda a: Rotation.from_euler("xyz", a, True) * Rotation.from_euler("x", 180, True),
}


@pytest.mark.parametrize("name", WRONG_ROTATIONS)
@pytest.mark.parametrize("angles", MOUNTS)
def test_wrong_rotations_are_explained(name, angles):
    """The mistake itself is named, unless a simpler one gives the same rotation, as for rotations about one axis."""
    right = pose(Rotation.from_euler("xyz", angles, True))
    wrong = pose(WRONG_ROTATIONS[name](angles))
    if Rotation.from_quat(wrong[0, 3:]).approx_equal(Rotation.from_quat(right[0, 3:]), atol=1e-3):
        assert explain(wrong, right) is None
        return
    found = explain(wrong, right)
    assert found is not None
    if np.count_nonzero(angles) == 3:
        assert name in found.reading
    assert found.meters < 1e-9
    assert found.radians < 1e-3


@pytest.mark.parametrize("angles", MOUNTS)
def test_an_inverted_transform_is_one_mistake(angles):
    right = pose(Rotation.from_euler("xyz", angles, True))
    turn = Rotation.from_quat(right[0, 3:]).inv()
    assert reading(pose(turn, -turn.apply(PLACE)), right) == "it is inverted"


@pytest.mark.parametrize(
    ("wrong", "name"),
    [
        (PLACE * 1000, "millimeters"),
        (PLACE * 100, "centimeters"),
        (PLACE / 0.0254, "inches"),
        (PLACE / 1000, "divided by 1000 twice"),
        (PLACE * [1, -1, 1], "the sign of y is changed"),
        (PLACE[[1, 0, 2]], "in the order y, x, z"),
        (PLACE * 0, "its translation is set"),
    ],
)
def test_wrong_translations_are_explained(wrong, name):
    turn = Rotation.from_euler("xyz", MOUNTS[0], True)
    assert name in reading(pose(turn, wrong), pose(turn))


def test_two_mistakes_are_named_together():
    turn = Rotation.from_euler("xyz", MOUNTS[0], True)
    wrong = pose(Rotation.from_quat(np.roll(turn.as_quat(), 1)), PLACE * 1000)
    both = "its quaternion is read as w, x, y, z and its translation is read in millimeters"
    assert reading(wrong, pose(turn)) == both


def test_one_explained_part_is_named_alone():
    turn = Rotation.from_euler("xyz", MOUNTS[0], True)
    found = explain(pose(Rotation.from_quat(np.roll(turn.as_quat(), 1)), PLACE + 0.07), pose(turn))
    assert found.text("the URDF") == (
        "the rotation of the pose agrees with the URDF within 0 degrees if its quaternion is read as w, x, y, z"
    )


def test_poses_that_no_mistake_relates_are_not_explained():
    """Of random pairs of mounts, none is explained: a wrong cause would be worse than none."""
    random = np.random.default_rng(5)
    turns = Rotation.random(200, random).as_quat()
    places = random.uniform(-1, 1, (200, 3))
    poses = np.concatenate([places, turns], axis=1)
    assert [explain(poses[i : i + 1], poses[i + 1 : i + 2]) for i in range(0, 200, 2)] == [None] * 100


def test_turns_about_one_axis_that_differ_by_chance_are_rarely_explained():
    """With one angle, a chance match within 1 mrad is possible; it must stay as rare as the tolerance implies."""
    random = np.random.default_rng(6)
    angles = random.uniform(-np.pi, np.pi, (200, 2))
    found = [
        explain(pose(Rotation.from_euler("z", first)), pose(Rotation.from_euler("z", second)))
        for first, second in angles
    ]
    assert sum(each is not None for each in found) <= 2


@pytest.mark.parametrize("angles", MOUNTS)
def test_small_errors_of_calibration_are_not_explained(angles):
    turn = Rotation.from_euler("xyz", angles, True)
    off = Rotation.from_rotvec([0.01, -0.02, 0.015])
    assert explain(pose(turn * off, PLACE + 0.01), pose(turn)) is None


def test_corrections_contain_what_was_meant():
    """Without a known pose, the corrections include the right one for every reversible mistake."""
    turn = Rotation.from_euler("xyz", [90.0, 0.0, 40.0], True)
    right = np.concatenate([PLACE, turn.as_quat()])
    wrong_turns = [
        np.roll(turn.as_quat(), 1),
        np.roll(turn.as_quat(), -1),
        Rotation.from_euler("xyz", [90.0, 0.0, 40.0]).as_quat(),
        turn.inv().as_quat(),
        (turn**2).as_quat(),
        Rotation.from_euler("ZYX", [90.0, 0.0, 40.0], True).as_quat(),
        quaternion.multiply(turn.as_quat(), Rotation.from_euler("x", 180, True).as_quat()),
    ]
    for wrong in wrong_turns:
        poses = [each.pose for each in corrections(np.concatenate([PLACE, wrong]))]
        assert max(abs(each[3:] @ right[3:]) for each in poses) == pytest.approx(1.0, abs=1e-9)
