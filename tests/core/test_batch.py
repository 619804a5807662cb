# SPDX-License-Identifier: Apache-2.0
"""Batches of lookups and insertions: each row equals a single call, for every order and number of threads."""

import threading

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

import coframe

SECOND = 1_000_000_000


def random_poses(rng, count):
    return np.concatenate(
        [rng.normal(size=(count, 3)), Rotation.random(count, random_state=rng.integers(2**31)).as_quat()], 1
    )


def row_by_row(buffer, target, source, stamps):
    """Return poses (N, 7), with NaN for rows without a transform."""
    rows = []
    for stamp in stamps.tolist():
        try:
            rows.append(buffer.lookup(target, source, stamp).values)
        except coframe.TransformException:
            rows.append((np.nan,) * 7)
    return np.array(rows).reshape(-1, 7)


@pytest.fixture
def tree():
    """Five edges: one is static, one changed its parent, one has equal stamps, one has a single sample."""
    rng = np.random.default_rng(7)
    buffer = coframe.Buffer(None)
    stamps = 10 * SECOND + np.sort(rng.integers(0, 5 * SECOND, 700))
    buffer.set_many("map", "odom", stamps, random_poses(rng, 700))
    buffer.set_many("odom", "base", stamps + 3, random_poses(rng, 700))
    buffer.set("base", "mast", coframe.Transform([0, 0, 1]), static=True)
    for stamp, parent in ((10 * SECOND, "odom"), (12 * SECOND, "mast"), (12 * SECOND, "base"), (14 * SECOND, "mast")):
        pose = random_poses(rng, 1)[0]
        buffer.set(parent, "camera", coframe.Transform(pose[:3], pose[3:]), stamp)
    buffer.set("camera", "lens", coframe.Transform([1, 2, 3]), 13 * SECOND)
    return buffer, stamps


@pytest.mark.parametrize(
    ("target", "source"), [("map", "base"), ("mast", "map"), ("map", "camera"), ("lens", "map"), ("base", "base")]
)
@pytest.mark.parametrize("threads", [1, 3])
def test_each_row_equals_a_lookup(tree, target, source, threads):
    buffer, samples = tree
    rng = np.random.default_rng(1)
    stamps = np.concatenate(
        [
            rng.integers(9 * SECOND, 16 * SECOND, 2000),
            samples,
            samples + 3,
            [0, 1, 13 * SECOND, 12 * SECOND],
        ]
    )
    stamps = rng.permutation(stamps)
    found = buffer.lookup_many(target, source, stamps, on_error="nan", threads=threads)
    expected = row_by_row(buffer, target, source, stamps)
    np.testing.assert_allclose(np.concatenate([found.translation, found.quaternion], 1), expected, rtol=0, atol=1e-12)


def test_interpolation_equals_scipys_slerp():
    rng = np.random.default_rng(2)
    for angle in (1e-12, 1e-7, 1e-3, 0.3, 2.0, np.pi - 1e-9):
        axis = rng.normal(size=3)
        ends = Rotation.random(random_state=3) * Rotation.from_rotvec(
            np.outer([0.0, angle], axis / np.linalg.norm(axis))
        )
        buffer = coframe.Buffer(None)
        poses = np.concatenate([rng.normal(size=(2, 3)), ends.as_quat()], 1)
        buffer.set_many("a", "b", [SECOND, 2 * SECOND], poses)
        stamps = rng.integers(SECOND, 2 * SECOND, 500)
        found = Rotation.from_quat(buffer.lookup_many("a", "b", stamps).quaternion)
        expected = Slerp([0.0, 1.0], ends)((stamps - SECOND) / SECOND)
        assert (found.inv() * expected).magnitude().max() < 1e-12


def test_out_is_filled(tree):
    buffer, samples = tree
    poses, matrices = np.empty((700, 7)), np.empty((700, 4, 4))
    assert buffer.lookup_many("map", "odom", samples, out=poses) is poses
    assert buffer.lookup_many("map", "odom", samples, out=matrices) is matrices
    batch = buffer.lookup_many("map", "odom", samples)
    np.testing.assert_array_equal(poses[:, :3], batch.translation)
    np.testing.assert_array_equal(matrices, batch.matrix)
    with pytest.raises(ValueError, match=r"out must be float64 of shape \(700, 7\)"):
        buffer.lookup_many("map", "odom", samples, out=np.empty((700, 6)))


def test_clip_uses_the_nearest_time_with_data(tree):
    buffer, samples = tree
    found = buffer.lookup_many("map", "base", [SECOND, 12 * SECOND, 99 * SECOND], on_error="clip")
    assert found.stamps.tolist() == [samples[0] + 3, 12 * SECOND, samples[-1]]
    with pytest.raises(coframe.LookupException):
        buffer.lookup_many("map", "nobody", [SECOND], on_error="clip")


@pytest.mark.parametrize(("target", "source"), [("map", "base"), ("base", "map"), ("odom", "mast"), ("camera", "map")])
def test_twists_are_the_rate_of_change(tree, target, source):
    buffer, _ = tree
    stamps = np.random.default_rng(4).integers(12 * SECOND + 1000, 13 * SECOND, 200)
    found, twists = buffer.lookup_many(target, source, stamps, twist=True)
    step = 100  # nanoseconds
    later = buffer.lookup_many(target, source, stamps + step)
    between = np.searchsorted(np.sort(np.concatenate([tree[1], tree[1] + 3])), [stamps, stamps + step])
    smooth = between[0] == between[1]  # no sample within the step
    linear = (later.translation - found.translation) / (step * 1e-9)
    turn = Rotation.from_quat(later.quaternion) * Rotation.from_quat(found.quaternion).inv()
    np.testing.assert_allclose(twists[smooth, :3], linear[smooth], atol=2e-3 * np.abs(twists).max())
    np.testing.assert_allclose(
        twists[smooth, 3:], turn.as_rotvec()[smooth] / (step * 1e-9), atol=2e-3 * np.abs(twists).max()
    )


def test_rows_are_consistent_during_insertions():
    """Each value encodes its stamp, so a row that mixes two states of the buffer is detected."""
    buffer, stop = coframe.Buffer("2s"), threading.Event()

    def feed():
        stamp = SECOND
        while not stop.is_set():
            stamp += 100_000
            for child in ("b", "c"):
                buffer._set_values(
                    "a" if child == "b" else "b", child, stamp, stamp * 1e-9, *(0.0,) * 5, 1.0, False, ""
                )

    feeder = threading.Thread(target=feed)
    feeder.start()
    try:
        for _ in range(200):
            newest = buffer.latest_common_time("a", "c") if buffer.can_transform("a", "c", timeout="10s") else 0
            stamps = np.arange(max(newest - SECOND, SECOND + 100_000), newest, 777_777)
            found = buffer.lookup_many("a", "c", stamps, on_error="nan")
            good = ~np.isnan(found.translation[:, 0])
            np.testing.assert_allclose(found.translation[good, 0], 2e-9 * stamps[good], rtol=1e-12)
    finally:
        stop.set()
        feeder.join()


class TestSetMany:
    @pytest.mark.parametrize("cache", [None, "3s", 0])
    def test_equals_single_insertions(self, cache):
        rng = np.random.default_rng(5)
        stamps = rng.permutation(np.concatenate([SECOND + rng.integers(0, 10 * SECOND, 900), np.full(30, 5 * SECOND)]))
        poses = random_poses(rng, len(stamps))
        many, single = coframe.Buffer(cache), coframe.Buffer(cache)
        stored = many.set_many("a", "b", stamps, poses, authority="me")
        for i in np.argsort(stamps, kind="stable"):
            single._set_values("a", "b", int(stamps[i]), *poses[i].tolist(), False, "me")
        assert many.all_frames_as_yaml() == single.all_frames_as_yaml()
        assert stored == single.statistics["stored"]
        asked = rng.integers(SECOND, 11 * SECOND, 500)
        np.testing.assert_array_equal(row_by_row(many, "a", "b", asked), row_by_row(single, "a", "b", asked))

    def test_a_batch_provides_its_stamps(self):
        buffer = coframe.Buffer()
        batch = coframe.Transform(np.eye(3), stamp=np.array([1, 2, 3]) * SECOND)
        assert buffer.set_many("a", "b", None, batch) == 3
        assert buffer.lookup("a", "b", 2 * SECOND).translation.tolist() == [0, 1, 0]

    def test_samples_older_than_the_cache_are_skipped(self):
        buffer = coframe.Buffer("1s")
        buffer.set("a", "b", coframe.Transform(), 10 * SECOND)
        assert buffer.set_many("a", "b", [SECOND, 10 * SECOND + 1], np.tile([0, 0, 0, 0, 0, 0, 1.0], (2, 1))) == 1

    def test_refused_values_store_nothing(self):
        buffer = coframe.Buffer()
        poses = np.tile([0, 0, 0, 0, 0, 0, 1.0], (3, 1))
        poses[1, 6] = 0.0
        with pytest.raises(coframe.InvalidArgumentException, match="row 1: the quaternion of 'a' -> 'b' is zero"):
            buffer.set_many("a", "b", [1, 2, 3], poses)
        assert buffer.frame_names() == []

    def test_shapes_are_checked(self):
        with pytest.raises(ValueError, match=r"stamps must have shape \(N,\) and poses \(N, 7\)"):
            coframe.Buffer().set_many("a", "b", [1, 2], np.zeros((3, 7)))

    def test_it_wakes_waiting_threads(self):
        buffer = coframe.Buffer()
        found = []
        thread = threading.Thread(target=lambda: found.append(buffer.wait("a", "b", 3 * SECOND, timeout="20s")))
        thread.start()
        buffer.set_many("a", "b", np.arange(1, 5) * SECOND, np.tile([0, 0, 0, 0, 0, 0, 1.0], (4, 1)))
        thread.join()
        assert found[0].stamp == 3 * SECOND

    @pytest.mark.parametrize(("parent", "child"), [("a", "a"), ("", "a"), ("a", "")])
    def test_names_are_refused_like_in_set(self, parent, child):
        buffer = coframe.Buffer()
        with pytest.raises(coframe.InvalidArgumentException, match="row 0: TF_"):
            buffer.set_many(parent, child, [1, 2], [[0, 0, 0, 0, 0, 0, 1]] * 2)


class TestTrajectory:
    def test_poses_at_the_times_of_the_samples(self, tree):
        buffer, samples = tree
        path = buffer.trajectory("map", "base")
        inside = np.unique(np.concatenate([samples, samples + 3]))
        np.testing.assert_array_equal(path.stamps, inside[(inside >= samples[0] + 3) & (inside <= samples[-1])])
        part = buffer.trajectory("map", "base", 11 * SECOND, 12 * SECOND)
        assert (part.stamps[0], part.stamps[-1]) == (11 * SECOND, 12 * SECOND)

    def test_steps_are_within_the_limits_and_few(self):
        buffer = coframe.Buffer(None)
        stamps = np.arange(1, 102) * SECOND // 10
        x = np.concatenate([np.zeros(50), np.linspace(0, 3, 26), np.full(25, 3.0)])
        yaw = np.concatenate([np.zeros(76), np.linspace(0, 2, 25)])
        poses = np.zeros((101, 7))
        poses[:, 0], poses[:, 3:] = x, Rotation.from_euler("z", yaw[:, None]).as_quat()
        buffer.set_many("map", "base", stamps, poses)
        path = buffer.trajectory("map", "base", max_translation=0.05, max_rotation=0.1)
        steps = np.linalg.norm(np.diff(path.translation, axis=0), axis=1)
        turns = (Rotation.from_quat(path.quaternion[:-1]).inv() * Rotation.from_quat(path.quaternion[1:])).magnitude()
        assert steps.max() <= 0.05 + 1e-9
        assert turns.max() <= 0.1 + 1e-9
        assert len(path) <= 1.2 * (3 / 0.05 + 2 / 0.1) + 2
        assert path.stamps[0] == stamps[0]
        assert path.stamps[-1] == stamps[-1]

    def test_static_edges_give_one_pose(self):
        buffer = coframe.Buffer()
        buffer.set("a", "b", coframe.Transform([1, 2, 3]), static=True)
        assert buffer.trajectory("a", "b").translation.tolist() == [[1, 2, 3]]

    def test_limits_must_be_positive(self, tree):
        with pytest.raises(ValueError, match="max_rotation must be positive"):
            tree[0].trajectory("map", "base", max_rotation=0.0)
