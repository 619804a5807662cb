# SPDX-License-Identifier: Apache-2.0
"""Batches as arrays: they are read-only like single transforms, and NumPy and pandas see the poses."""

import copy
import pickle

import numpy as np
import pandas as pd
import pytest

import coframe

SECOND = 1_000_000_000
ARRAYS = ("translation", "quaternion", "stamps")


@pytest.fixture
def batch():
    buffer = coframe.Buffer(cache=None)
    for second in (1, 2, 3):
        buffer.set("map", "base", coframe.Transform.from_rpy([second, 0, 0], yaw=0.1 * second), second * SECOND)
    return buffer.lookup_many("map", "base", np.array([1, 2, 3]) * SECOND, extrapolate="1s")


@pytest.mark.parametrize(
    "derive",
    [
        lambda batch: batch,
        lambda batch: batch[1:],
        lambda batch: batch.inverse(),
        lambda batch: batch @ batch.inverse(),
        lambda batch: coframe.Transform(batch.translation.copy(), stamp=batch.stamps.copy()),
        lambda batch: pickle.loads(pickle.dumps(batch)),
        copy.deepcopy,
        copy.copy,
    ],
)
def test_no_array_of_a_batch_can_be_changed(batch, derive):
    derived = derive(batch)
    for name in ARRAYS:
        with pytest.raises(ValueError, match="read-only"):
            getattr(derived, name)[0] = 7
    with pytest.raises(ValueError, match="read-only"):
        derived.x[0] = 7


def test_extrapolations_are_read_only(batch):
    with pytest.raises(ValueError, match="read-only"):
        batch.extrapolated[0] = 7


def test_a_trajectory_is_read_only():
    buffer = coframe.Buffer(cache=None)
    buffer.set("map", "base", coframe.Transform(), SECOND)
    buffer.set("map", "base", coframe.Transform([1, 0, 0]), 2 * SECOND)
    with pytest.raises(ValueError, match="read-only"):
        buffer.trajectory("map", "base").translation[0] = 7


def test_the_array_of_the_caller_stays_writable():
    buffer = coframe.Buffer(cache=None)
    buffer.set("map", "base", coframe.Transform([1, 0, 0]), SECOND)
    out = np.empty((1, 7))
    stamps = np.array([SECOND])
    buffer.lookup_many("map", "base", stamps, out=out)
    buffer.lookup_many("map", "base", stamps)
    out[:] = stamps[:] = 0


def test_values_and_arrays_of_a_batch_are_its_poses(batch):
    poses = np.concatenate([batch.translation, batch.quaternion], axis=1)
    assert np.array_equal(batch.values, poses)
    assert np.array_equal(np.asarray(batch), poses)
    assert np.asarray(batch, dtype=np.float32).dtype == np.float32
    assert np.array_equal(np.concatenate([batch, batch]), np.concatenate([poses, poses]))
    assert np.array_equal(pd.DataFrame(batch).to_numpy(), poses)


def test_an_array_of_a_single_transform_has_its_values():
    transform = coframe.Transform([1.0, 2.0, 3.0])
    assert np.asarray(transform).tolist() == list(transform.values) == [1, 2, 3, 0, 0, 0, 1]


def test_an_array_without_a_copy_is_refused(batch):
    with pytest.raises(ValueError, match="without a copy"):
        batch.__array__(copy=False)


@pytest.mark.parametrize("matrix", [np.diag([1.0, 1, -1, 1]), np.eye(4)[[1, 0, 2, 3]], np.diag([-1.0, -1, -1, 1])])
def test_a_reflection_is_named_as_one(matrix):
    with pytest.raises(ValueError, match="is a reflection, not a rotation: its determinant is -1"):
        coframe.Transform.from_matrix(matrix)


@pytest.mark.parametrize("scale", [2.0, 0.0, np.nan])
def test_a_matrix_that_is_no_rotation_is_not_called_a_reflection(scale):
    with pytest.raises(ValueError, match=r"not a rotation: R R\^T differs"):
        coframe.Transform.from_matrix(np.diag([1, 1, scale, 1]))


def test_set_many_names_a_zero_quaternion():
    buffer = coframe.Buffer()
    poses = [[0, 0, 0, 0, 0, 0, 1], [1, 2, 3, 0, 0, 0, 0]]
    with pytest.raises(
        coframe.InvalidArgumentException, match=r"^row 1: the quaternion of 'a' -> 'b' is zero"
    ) as caught:
        buffer.set_many("a", "b", [1, 2], poses)
    assert "0 0 0 1" in caught.value.hint
