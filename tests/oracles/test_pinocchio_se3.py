# SPDX-License-Identifier: Apache-2.0
"""SE(3) of 1e5 random poses, compared with Pinocchio. `make test-slow` installs it."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from coframe import Transform

pytestmark = pytest.mark.slow
pinocchio = pytest.importorskip("pinocchio", reason="Pinocchio (pip install --group oracle) is not installed")

MANY = 100_000


def random_twists(rng):
    axes = rng.normal(size=(MANY, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = rng.uniform(0, np.pi, MANY)
    angles[: MANY // 4] = 10 ** rng.uniform(-15, 0, MANY // 4)
    angles[MANY // 4 : MANY // 2] = np.pi - 10 ** rng.uniform(-15, 0, MANY // 4)
    return np.concatenate([rng.uniform(-5, 5, (MANY, 3)), axes * angles[:, None]], axis=1)


def test_exponential_logarithm_and_composition():
    rng = np.random.default_rng(2)
    twists = random_twists(rng)
    ours = Transform.exp(twists)
    theirs = [pinocchio.exp6(twist) for twist in twists]
    # Pinocchio's series for small angles ends early: with extended precision it is 2e-12 off, and ours 3e-15.
    np.testing.assert_allclose(ours.matrix, [pose.homogeneous for pose in theirs], rtol=0, atol=4e-12)
    theirs = ours.as_pinocchio()
    products = [a * b for a, b in zip(theirs, theirs[::-1], strict=True)]
    np.testing.assert_allclose((ours @ ours[::-1]).matrix, [each.homogeneous for each in products], rtol=0, atol=1e-12)
    angles = np.linalg.norm(twists[:, 3:], axis=1)
    # From a matrix, the axis next to half a turn is known to the square root of its precision only.
    far = angles < np.pi - 0.5
    logarithms = np.array([pinocchio.log6(pose).vector for pose in theirs])
    np.testing.assert_allclose(ours.log()[far], logarithms[far], rtol=0, atol=1e-11)
    np.testing.assert_allclose(ours.log(), twists, rtol=0, atol=1e-12)


def test_objects_round_trip():
    rng = np.random.default_rng(3)
    poses = Transform(rng.normal(size=(20, 3)), Rotation.random(20, rng=rng).as_quat(), target="a")
    assert Transform.from_pinocchio(poses.as_pinocchio()).is_close(poses, translation=1e-15, rotation=1e-14)
    one = poses[0].as_pinocchio()
    assert isinstance(one, pinocchio.SE3)
    np.testing.assert_allclose(one.action, poses[0].adjoint(), atol=1e-14)
    assert Transform.from_pinocchio(one, target="a", source="b").source == "b"
    with pytest.raises(TypeError, match=r"must be a pinocchio.SE3"):
        Transform.from_pinocchio(3)
