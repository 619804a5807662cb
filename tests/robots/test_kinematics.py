# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics, compared with SciPy, with finite differences and with the recording of a real robot."""

import itertools
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from coframe.robots import parse_urdf

LINKS = ["base", "a", "b", "c", "d", "tip"]


def described(*joints):
    links = "".join(f"<link name='{name}'/>" for name in LINKS[: len(joints) + 1])
    return f"<robot name='r'>{links}{''.join(joints)}</robot>"


def joint(name, kind, parent, child, inside=""):
    limit = "<limit lower='-3' upper='3' effort='1' velocity='1'/>" if kind in {"revolute", "prismatic"} else ""
    return (
        f"<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>"
        f"<origin xyz='0.1 -0.2 0.3' rpy='0.3 -0.4 0.5'/>{inside}{limit}</joint>"
    )


ALL_TYPES = described(
    joint("turn", "revolute", "base", "a", "<axis xyz='1 2 3'/>"),
    joint("slide", "prismatic", "a", "b", "<axis xyz='0 -1 0'/>"),
    joint("stay", "fixed", "b", "c"),
    joint("spin", "continuous", "c", "d", "<axis xyz='0 0.6 0.8'/>"),
    joint("push", "planar", "d", "tip", "<axis xyz='0 1 0'/>"),
)


def matrix(translation=(0, 0, 0), rotation=None):
    m = np.eye(4)
    m[:3, 3] = translation
    if rotation is not None:
        m[:3, :3] = rotation.as_matrix()
    return m


ORIGIN = matrix((0.1, -0.2, 0.3), Rotation.from_euler("xyz", [0.3, -0.4, 0.5]))


def about(axis, angle):
    return matrix(rotation=Rotation.from_rotvec(np.array(axis) / np.linalg.norm(axis) * angle))


def by_hand(turn, slide, spin, push):
    """Return the pose of the tip from SciPy and 4x4 matrices."""
    x, y, angle = push
    motions = [
        about((1, 2, 3), turn),
        matrix((0, -slide, 0)),
        np.eye(4),
        about((0, 0.6, 0.8), spin),
        # The plane is perpendicular to y. Its axes x and y are rotated like the normal, from z to y.
        matrix((x, 0, -y)) @ about((0, 1, 0), angle),
    ]
    tip = np.eye(4)
    for motion in motions:
        tip = tip @ ORIGIN @ motion
    return tip


def test_every_type_of_joint_agrees_with_scipy():
    robot = parse_urdf(ALL_TYPES)
    rng = np.random.default_rng(1)
    for turn, slide, spin, *push in rng.uniform(-3, 3, (50, 6)):
        frames = robot.frames({"turn": turn, "slide": slide, "spin": spin, "push": push})
        assert list(frames) == LINKS
        assert (frames["tip"].target, frames["tip"].source) == ("base", "tip")
        np.testing.assert_allclose(frames["tip"].matrix, by_hand(turn, slide, spin, push), atol=1e-13)


def test_a_floating_joint_has_a_pose():
    robot = parse_urdf(described(joint("free", "floating", "base", "a")))
    pose = [1, 2, 3, 0.1, 0.2, 0.3, 2.0]
    expected = ORIGIN @ matrix(pose[:3], Rotation.from_quat(pose[3:]))
    np.testing.assert_allclose(robot.frames({"free": pose})["a"].matrix, expected, atol=1e-15)
    np.testing.assert_allclose(robot.frames()["a"].matrix, ORIGIN, atol=1e-15)


def test_a_planar_joint_without_an_axis_moves_in_x_and_y():
    robot = parse_urdf(described(joint("push", "planar", "base", "a")))
    expected = ORIGIN @ matrix((1, 2, 0)) @ about((0, 0, 1), 0.5)
    np.testing.assert_allclose(robot.frames({"push": [1, 2, 0.5]})["a"].matrix, expected, atol=1e-15)


def test_a_batch_equals_single_configurations():
    robot = parse_urdf(ALL_TYPES)
    rng = np.random.default_rng(2)
    turn, push = rng.uniform(-3, 3, 40), rng.uniform(-3, 3, (40, 3))
    together = robot.frames({"turn": turn, "slide": 0.5, "push": push})
    links = robot.joint_transforms({"turn": turn, "slide": 0.5, "push": push})
    assert {frame.shape for frame in together.values()} == {(40,)}
    for i in range(40):
        alone = robot.frames({"turn": turn[i], "slide": 0.5, "push": push[i]})
        for link, frame in alone.items():
            np.testing.assert_allclose(together[link].matrix[i], frame.matrix, atol=1e-14)
    assert (links["spin"].target, links["spin"].source) == ("c", "d")
    np.testing.assert_allclose((together["c"] @ links["spin"]).matrix, together["d"].matrix, atol=1e-14)


def test_large_angles_agree_with_numpy():
    robot = parse_urdf(described(joint("spin", "continuous", "base", "a", "<axis xyz='0 0.6 0.8'/>")))
    quarters = np.arange(-2000, 2000) * (np.pi / 4)
    angles = np.concatenate((quarters, np.nextafter(quarters, 9e9), [1e5, 2e5, -2e5 - 1e-3, 1e9, -1e15, 1e-300, -0.0]))
    sine, cosine = np.sin(angles / 2), np.cos(angles / 2)
    turns = Rotation.from_quat(np.stack([0 * angles, 0.6 * sine, 0.8 * sine, cosine], axis=-1))
    expected = [ORIGIN @ matrix(rotation=turn) for turn in turns]
    np.testing.assert_allclose(robot.frames({"spin": angles})["a"].matrix, expected, rtol=0, atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(robot.frames({"spin": angles})["a"].quaternion, axis=-1), 1, atol=1e-15)


@pytest.mark.parametrize("threads", [1, 3])
def test_a_batch_into_an_array(threads):
    robot = parse_urdf(ALL_TYPES)
    rng = np.random.default_rng(3)
    table = rng.uniform(-3, 3, (1000, 6))  # columns of a table are not contiguous
    at = {"turn": table[:, 0], "slide": table[:, 1], "spin": table[:, 2], "push": table[:, 3:]}
    out = np.full((len(LINKS), 1000, 7), np.nan)
    assert robot.frames(at, out=out, threads=threads) is out
    for (link, frame), rows in zip(robot.frames(at).items(), out, strict=True):
        np.testing.assert_array_equal(rows, np.hstack((frame.translation, frame.quaternion)), err_msg=link)
    for wrong in (np.empty((6, 999, 7)), np.empty((6, 1000, 7), np.float32), np.empty((6, 1000, 14))[..., ::2]):
        with pytest.raises(ValueError, match="out must be a contiguous float64 array"):
            robot.frames(at, out=wrong)
    assert robot.frames({"turn": np.empty(0)})["tip"].shape == (0,)


def test_kinematics_in_many_threads_at_once():
    """Threads can share the native tree, because calls do not modify it."""
    robot = parse_urdf(ALL_TYPES)
    angles = np.linspace(-3, 3, 200_000)
    expected = robot.frames({"turn": angles})["tip"].translation
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _: robot.frames({"turn": angles})["tip"].translation, range(8)):
            np.testing.assert_array_equal(found, expected)


def test_a_robot_without_joints():
    lone = parse_urdf("<robot name='r'><link name='base'/></robot>")
    assert list(lone.frames()) == ["base"]
    assert lone.joint_transforms() == {}


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_a_chain_of_mimics_in_any_order(order):
    axis = "<axis xyz='0 0 1'/>"
    joints = [
        joint("z", "continuous", "base", "a", axis),
        joint("m", "continuous", "a", "b", axis + "<mimic joint='z' multiplier='2' offset='0.1'/>"),
        joint("a", "prismatic", "b", "c", axis + "<mimic joint='m' multiplier='-3' offset='0.2'/>"),
    ]
    robot = parse_urdf(described(*(joints[i] for i in order)))
    followed, _ = robot.positions({"z": 0.5})
    assert {name: float(value) for name, value in followed.items()} == pytest.approx({"z": 0.5, "m": 1.1, "a": -3.1})
    positions, _ = robot.positions({"z": 0.5, "m": 7.0})  # a given position overrides the mimic tag
    assert {name: float(value) for name, value in positions.items()} == pytest.approx({"z": 0.5, "m": 7.0, "a": -20.8})
    for given, followed in (({"z": 0.5}, {"z": 0.5, "m": 1.1, "a": -3.1}), ({"m": 7}, {"z": 0, "m": 7, "a": -20.8})):
        explicit = robot.frames(followed)
        batch = robot.frames({name: np.full(3, value) for name, value in given.items()})
        for link, frame in robot.frames(given).items():
            np.testing.assert_allclose(frame.matrix, explicit[link].matrix, atol=1e-14)
            np.testing.assert_allclose(batch[link][1].matrix, explicit[link].matrix, atol=1e-14)
    assert robot.free_joints == ("z",)


def test_default_positions_are_zero_or_the_middle_of_the_limits():
    inside = joint("turn", "revolute", "base", "a")
    outside = joint("slide", "prismatic", "a", "b").replace("lower='-3'", "lower='1'")
    assert parse_urdf(described(inside, outside)).zeros() == {"turn": 0.0, "slide": 2.0}


def test_the_jacobian_is_the_derivative():
    robot = parse_urdf(
        described(
            joint("turn", "revolute", "base", "a", "<axis xyz='1 2 3'/>"),
            joint("slide", "prismatic", "a", "b", "<axis xyz='0 -1 0'/><mimic joint='spin' multiplier='0.3'/>"),
            joint("spin", "continuous", "b", "c", "<axis xyz='0 0.6 0.8'/>"),
            joint("twist", "revolute", "c", "d", "<axis xyz='1 0 0'/><mimic joint='turn' multiplier='-2'/>"),
            joint("unrelated", "revolute", "base", "tip"),
        )
    )
    at = {"turn": 0.3, "spin": -1.2}
    jacobian = robot.jacobian("d", at)
    assert robot.free_joints == ("turn", "unrelated", "spin")
    step = 1e-6
    for column, name in enumerate(robot.free_joints):
        ahead = robot.frames({**at, name: at.get(name, 0.0) + step})["d"]
        behind = robot.frames({**at, name: at.get(name, 0.0) - step})["d"]
        velocity = (ahead.translation - behind.translation) / (2 * step)
        turned = Rotation.from_quat(ahead.quaternion) * Rotation.from_quat(behind.quaternion).inv()
        np.testing.assert_allclose(jacobian[:, column], [*velocity, *turned.as_rotvec() / (2 * step)], atol=1e-8)
    batch = robot.jacobian("d", {"turn": np.array([0.3, 0.9]), "spin": -1.2})
    assert batch.shape == (2, 6, 3)
    np.testing.assert_allclose(batch[0], jacobian, atol=1e-14)


@pytest.mark.parametrize(
    ("positions", "reason"),
    [
        ({"trun": 1.0}, "No joint named 'trun'. Did you mean 'turn'?"),
        ({"stay": 1.0}, "'stay' is fixed"),
        ({"turn": float("nan")}, "position of joint 'turn' is not finite"),
        ({"turn": [0.0] * 100 + [float("inf")]}, "position of joint 'turn' is not finite"),
        ({"turn": 10**400}, "'turn': int too large"),
        ({"turn": "fast"}, "could not convert"),
        ({"push": [1.0, 2.0]}, "position of planar joint 'push'"),
        ({"turn": np.zeros((2, 2))}, "one batch axis"),
        ({"turn": np.zeros(2), "spin": np.zeros(3)}, "shape mismatch"),
    ],
)
def test_invalid_positions_raise_an_error(positions, reason):
    with pytest.raises(ValueError, match=reason.replace("?", r"\?")):
        parse_urdf(ALL_TYPES).frames(positions)
