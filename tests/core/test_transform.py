# SPDX-License-Identifier: Apache-2.0
"""Transforms form a group and their values are right, for all batch shapes, compared with SciPy."""

import copy
import pickle
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import coframe
from coframe import Transform

SHAPES = [(), (1,), (7,), (2, 3)]


def random_transform(rng, shape=(), **names):
    return Transform(rng.normal(size=(*shape, 3)) * 10, rng.normal(size=(*shape, 4)), **names)


@pytest.fixture
def rng():
    return np.random.default_rng(5)


@pytest.mark.parametrize("shape", SHAPES)
def test_group_axioms(rng, shape):
    a, b, c = (random_transform(rng, shape) for _ in range(3))
    assert ((a @ b) @ c).is_close(a @ (b @ c), translation=1e-12, rotation=1e-12)
    assert (a @ a.inverse()).is_close(Transform(), translation=1e-12, rotation=1e-12)
    assert (a @ Transform()).is_close(a, translation=0, rotation=1e-15)
    assert (a @ b).shape == shape


@pytest.mark.parametrize("shape", SHAPES)
def test_matrix_and_back(rng, shape):
    a, b = random_transform(rng, shape), random_transform(rng, shape)
    np.testing.assert_allclose((a @ b).matrix, a.matrix @ b.matrix, atol=1e-12)
    assert Transform.from_matrix(a.matrix).is_close(a, translation=0, rotation=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
def test_rotation_and_rpy_equal_those_of_scipy(rng, shape):
    a = random_transform(rng, shape)
    theirs = Rotation.from_quat(a.quaternion.reshape(-1, 4))
    np.testing.assert_allclose(a.rotation.reshape(-1, 3, 3), theirs.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(a.rpy.reshape(-1, 3), theirs.as_euler("xyz"), atol=1e-9)
    assert Transform.from_rpy(a.translation, a.rpy).is_close(a, translation=0, rotation=1e-9)


def test_rotations_near_half_turns_round_trip_through_matrices(rng):
    axes = rng.normal(size=(100, 3))
    half_turns = Rotation.from_rotvec(axes / np.linalg.norm(axes, axis=1)[:, None] * (np.pi - 1e-9))
    a = Transform(quaternion=half_turns.as_quat())
    assert Transform.from_matrix(a.matrix).is_close(a, rotation=1e-9)


@pytest.mark.parametrize("pitch", [np.pi / 2, -np.pi / 2])
def test_gimbal_lock_keeps_the_rotation(pitch):
    a = Transform.from_rpy(rpy=[0.3, pitch, 0.4])
    roll, found, yaw = a.rpy
    assert yaw == 0
    assert found == pytest.approx(pitch)
    assert Transform.from_rpy(rpy=[roll, found, yaw]).is_close(a, rotation=1e-7)


def test_points(rng):
    a = random_transform(rng)
    points = rng.normal(size=(50, 3))
    expected = (a.matrix @ np.c_[points, np.ones(50)].T).T[:, :3]
    np.testing.assert_allclose(a @ points, expected, atol=1e-12)
    np.testing.assert_allclose(a @ points[0], expected[0], atol=1e-12)
    batch = random_transform(rng, (50,))
    np.testing.assert_allclose((batch @ points)[7], batch[7] @ points[7], atol=1e-12)
    with pytest.raises(ValueError, match=r"points must have shape \(..., 3\)"):
        _ = a @ np.zeros((3, 4))


def test_frames_are_checked_and_propagated(rng):
    map_odom = random_transform(rng, target="map", source="odom", stamp=5)
    odom_base = random_transform(rng, target="odom", source="base", stamp=5)
    both = map_odom @ odom_base
    assert (both.target, both.source, both.stamp) == ("map", "base", 5)
    assert (both.inverse().target, both.inverse().source) == ("base", "map")
    with pytest.raises(coframe.FrameMismatchException, match=r"map <- odom with base <- odom: 'odom' is not 'base'"):
        _ = map_odom @ odom_base.inverse()


def test_invalid_values_are_refused():
    with pytest.raises(coframe.InvalidArgumentException, match="finite"):
        Transform([float("nan"), 0, 0])
    with pytest.raises(coframe.InvalidArgumentException, match="quaternion must not be zero"):
        Transform(quaternion=[0, 0, 0, 0])
    with pytest.raises(ValueError, match=r"shape \(..., 3\), not \(2,\)"):
        Transform([1, 2])
    with pytest.raises(ValueError, match="not a rotation"):
        Transform.from_matrix(np.diag([2.0, 1, 1, 1]))
    with pytest.raises(ValueError, match="not a rotation"):
        Transform.from_matrix(np.diag([-1.0, 1, 1, 1]))
    with pytest.raises(TypeError, match="float of seconds"):
        Transform(stamp=1.5)


def test_batches_are_sequences(rng):
    batch = random_transform(rng, (4,), target="a", source="b", stamp=None)
    assert len(batch) == 4
    assert [one.shape for one in batch] == [()] * 4
    assert batch[1:3].shape == (2,)
    stamped = Transform(np.zeros((2, 3)), stamp=np.array([10, 20]))
    assert [one.stamp for one in stamped] == [10, 20]
    with pytest.raises(TypeError, match="no length"):
        len(batch[0])


def test_values_are_kept_by_pickle_and_copy(rng):
    for a in (random_transform(rng, target="a", source="b", stamp=7), random_transform(rng, (3,))):
        assert pickle.loads(pickle.dumps(a)) == a
        assert copy.deepcopy(a) == a
    buffer = coframe.Buffer()
    buffer.set("odom", "base", Transform(), 1)
    guess = buffer.lookup("odom", "base", 4, extrapolate="10ns")
    assert copy.copy(guess).extrapolated == pickle.loads(pickle.dumps(guess)).extrapolated == 3
    error = pickle.loads(pickle.dumps(coframe.LookupException.with_details("text", target="a", hint="do")))
    assert (str(error), error.target, error.hint) == ("text", "a", "do")


@pytest.mark.parametrize("shape", SHAPES)
def test_components_are_floats_or_arrays(rng, shape):
    a = random_transform(rng, shape)
    for axis, (length, angle) in enumerate([(a.x, a.roll), (a.y, a.pitch), (a.z, a.yaw)]):
        np.testing.assert_array_equal(length, a.translation[..., axis])
        np.testing.assert_array_equal(angle, a.rpy[..., axis])
        assert (type(length), type(angle)) == ((float, float) if shape == () else (np.ndarray, np.ndarray))


def test_angles_by_name():
    assert Transform.from_rpy(yaw=0.5) == Transform.from_rpy(rpy=[0, 0, 0.5])
    whole = Transform.from_rpy([1, 2, 3], roll=0.1, pitch=0.2, yaw=0.3, target="a", source="b", stamp=7)
    assert whole == Transform.from_rpy([1, 2, 3], [0.1, 0.2, 0.3], target="a", source="b", stamp=7)
    batch = Transform.from_rpy(roll=0.1, yaw=[0.0, 0.5])
    assert batch.shape == (2,)
    np.testing.assert_allclose(batch.rpy, [[0.1, 0, 0], [0.1, 0, 0.5]], atol=1e-15)
    with pytest.raises(TypeError, match="not both"):
        Transform.from_rpy(rpy=[0, 0, 1], yaw=0.0)
    with pytest.raises(coframe.InvalidArgumentException, match="must be finite"):
        Transform.from_rpy(yaw=np.nan)


@pytest.mark.parametrize("shape", SHAPES)
def test_points_are_transformed_by_name(rng, shape):
    a = random_transform(rng, shape)
    points = rng.normal(size=(*shape, 3))
    np.testing.assert_array_equal(a.transform_point(points), a @ points)
    message = SimpleNamespace(x=1.0, y=2.0, z=3.0)
    np.testing.assert_array_equal(a.transform_point(message), a @ [1.0, 2.0, 3.0])
    with pytest.raises(TypeError, match="a @ b"):
        a.transform_point(a)
    with pytest.raises(ValueError, match="shape"):
        a.transform_point([1.0, 2.0])


@pytest.mark.parametrize("shape", SHAPES[:3])
def test_scipy_round_trip(rng, shape):
    a = random_transform(rng, shape)
    rotation, translation = a.as_scipy()
    assert isinstance(rotation, Rotation)
    np.testing.assert_allclose(rotation.as_matrix(), a.rotation, atol=1e-12)
    assert Transform.from_scipy(rotation, translation).is_close(a, translation=0, rotation=1e-12)
    named = Transform.from_scipy(rotation, target="a", source="b")
    assert (named.target, named.source) == ("a", "b")
    with pytest.raises(TypeError, match=r"must be a scipy.spatial.transform.Rotation or RigidTransform, not list"):
        Transform.from_scipy([0, 0, 0, 1])


def test_missing_scipy_is_one_sentence(monkeypatch):
    for name in ("scipy", "scipy.spatial", "scipy.spatial.transform"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ModuleNotFoundError, match="needs SciPy, which is not installed") as caught:
        Transform().as_scipy()
    assert caught.value.__suppress_context__


@pytest.mark.parametrize("size", [1e-320, 1e-200, 1.0, 1e200, 1e308])
def test_quaternions_of_any_length_are_normalized(size):
    np.testing.assert_allclose(Transform(quaternion=[0.0, 0.0, 0.0, size]).quaternion, [0, 0, 0, 1])
    half = Transform(quaternion=[[size, 0.0, 0.0, size], [0.0, 0.0, 0.0, 1.0]]).quaternion
    np.testing.assert_allclose(half, [[np.sqrt(0.5), 0, 0, np.sqrt(0.5)], [0, 0, 0, 1]], atol=1e-3)


def test_a_batch_is_independent_of_its_source_array():
    positions = np.zeros((4, 3))
    batch = Transform(positions)
    positions[:] = 7.0
    assert (batch.translation == 0.0).all()


def test_a_transform_is_true_and_not_an_array_for_numpy():
    assert Transform()
    assert not Transform(np.zeros((0, 3)))
    with pytest.raises(TypeError, match="unsupported operand"):
        np.zeros(3) @ Transform()


def test_arrays_of_a_transform_are_read_only(rng):
    for a in (random_transform(rng), random_transform(rng, (3,))):
        with pytest.raises(ValueError, match="read-only"):
            a.translation[0] = 9


class Loud(np.ndarray):
    def tolist(self):
        raise AssertionError("a batch becomes objects of Python")


def test_a_batch_stays_in_arrays():
    many = coframe.Transform(np.zeros((5, 3)).view(Loud), np.tile([0.0, 0.0, 0.0, 1.0], (5, 1)).view(Loud))
    assert many.shape == (5,)
