# SPDX-License-Identifier: Apache-2.0
"""The kernels are exact, and their results for all CPU levels agree to 1e-15."""

import os
import subprocess
import sys

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

import coframe
from coframe import _core
from coframe.sensors import deskew

# Between neighboring samples, in radians: from none to half a turn, on both sides of where the slerp series changes.
TURNS = [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 5e-3, 0.0116, 0.0118, 0.1, 0.123, 0.124, 0.5, 0.58, 0.6, 1.0, 2.0, 3.0]
TURNS += [np.pi - 1e-3, np.pi - 1e-6, np.pi - 1e-9, np.pi]
SHARES = 33
PERIOD = 10_000_000

BUFFER = """
import sys
import numpy as np
import coframe
from coframe.sensors import deskew, transform_cloud
random = np.random.default_rng(0)
buffer = coframe.Buffer(None)
for i in range(200):
    for child, size in (("a", 1.0), ("b", 1e-3), ("c", 0.05), ("d", 0.3)):
        q = np.append(size * random.normal(size=3), 1.0)
        parent, child = ("odom", child) if child == "a" else (chr(ord(child) - 1), child)
        buffer.set(parent, child, coframe.Transform(random.normal(size=3), q), 1 + i * 1_000_000)
ordered = np.sort(random.integers(1, 199_000_000, 5003))
"""

# All code paths of the kernels: the same time for many points, many times between the same samples, any order.
MOVED = (
    BUFFER
    + """
for times in (ordered, random.permutation(ordered), np.repeat(ordered[::100], 100)[:5003], ordered // 200 + 1):
    for dtype in DTYPES:
        points = np.random.default_rng(1).normal(size=(5003, 3)).astype(dtype)
        for source, target in (("d", "odom"), ("odom", "d")):
            moved = deskew(points, times, buffer, target, source=source)
            sys.stdout.buffer.write(moved.astype("f8").tobytes())
        moved = transform_cloud(points, buffer.lookup("odom", "d", int(times[0])))
        sys.stdout.buffer.write(moved.astype("f8").tobytes())
"""
)

# Forwards and back, in order, in any order, and few; with velocities.
LOOK_UPS = (
    BUFFER
    + """
for times in (ordered, random.permutation(ordered), random.permutation(ordered)[:99], ordered // 200 + 1):
    for source, target in (("d", "odom"), ("odom", "d")):
        out = np.empty((len(times), 7))
        sys.stdout.buffer.write(buffer.lookup_many(target, source, times, out=out).tobytes())
        _, twists = buffer.lookup_many(target, source, times, out=out, twist=True)
        sys.stdout.buffer.write(out.tobytes() + (1e-3 * twists).tobytes())
"""
)

STORED = (
    BUFFER
    + """
rows = np.random.default_rng(3).normal(size=(1003, 7))
stamps = np.arange(1, 1004)
one_by_one, batch = coframe.Buffer(None), coframe.Buffer(None)
for stamp, row in zip(stamps.tolist(), rows.tolist()):
    one_by_one._set_values("a", "b", stamp, *row, False, "")
batch.set_many("a", "b", stamps, rows)
for each in (one_by_one, batch):
    for stamp in stamps.tolist():
        sys.stdout.buffer.write(np.array(each.lookup("a", "b", stamp).values).tobytes())
"""
)


MOVING = """
import sys
import numpy as np
from coframe.robots import parse_urdf

types = ["continuous", "prismatic", "fixed", "planar", "floating", "continuous", "continuous"]
links = "".join(f"<link name='l{i}'/>" for i in range(len(types) + 1))
joints = "".join(
    f"<joint name='j{i}' type='{kind}'><parent link='l{i}'/><child link='l{i + 1}'/><axis xyz='1 {i} 2'/>"
    f"<origin xyz='0.1 {i} 0.3' rpy='{i} 2 3'/><limit lower='-9' upper='9'/></joint>"
    for i, kind in enumerate(types)
)
robot = parse_urdf(f"<robot name='r'>{links}{joints}</robot>")
rng = np.random.default_rng(5)
for count in (1, 3, 64, 1001):
    for largest in (1.0, 3e4, 1e7):
        at = {f"j{i}": rng.uniform(-largest, largest, count) for i in (0, 5, 6)}
        at |= {"j1": rng.normal(size=count), "j3": rng.normal(size=(count, 3)), "j4": rng.normal(size=(count, 7))}
        out = np.empty((len(robot.links), count, 7))
        sys.stdout.buffer.write(robot.frames(at, out=out).tobytes())
"""


def answers_of_all_levels(program):
    """Return the numbers that a program prints for each CPU level."""
    answers = {}
    for level in _core.CPU_LEVELS:
        result = subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "COFRAME_CPU_LEVEL": level},
            capture_output=True,
            check=True,
        )
        answers[level] = np.frombuffer(result.stdout, dtype=np.float64)
    return answers


@pytest.mark.parametrize(("dtypes", "rounding"), [(("f8", ">f8"), 0.0), (("f4", ">f4"), 2.0**-23)])
def test_all_levels_transform_points_equally(dtypes, rounding):
    answers = answers_of_all_levels(f"DTYPES = {dtypes}\n{MOVED}")
    plain = answers.pop("plain")
    assert plain.size > 300_000
    for level, moved in answers.items():
        # Each of four links adds an error of its own to points that are some meters away.
        np.testing.assert_allclose(moved, plain, rtol=rounding, atol=1e-14, err_msg=level)


def test_all_levels_look_up_the_same_poses():
    answers = answers_of_all_levels(LOOK_UPS)
    plain = answers.pop("plain")
    assert plain.size > 50_000
    for level, found in answers.items():
        np.testing.assert_allclose(found, plain, rtol=0, atol=1e-14, err_msg=level)


def test_all_levels_compute_the_same_robot_poses():
    answers = answers_of_all_levels(MOVING)
    plain = answers.pop("plain")
    assert plain.size == 3 * 8 * 7 * (1 + 3 + 64 + 1001)
    for level, found in answers.items():
        np.testing.assert_allclose(found, plain, rtol=0, atol=1e-13, err_msg=level)


def test_all_levels_store_bitwise_equal_samples():
    """Single and in batches; the lookups are at the times of the samples."""
    answers = answers_of_all_levels(STORED)
    plain = answers.pop("plain")
    one_by_one, in_batch = np.split(plain, 2)
    np.testing.assert_array_equal(one_by_one, in_batch)
    for level, found in answers.items():
        np.testing.assert_array_equal(found, plain, err_msg=level)


def test_the_best_level_is_chosen_and_another_can_be_requested():
    assert _core.CPU_LEVELS[0] == "plain"
    show = "from coframe import _core; print(_core.CPU_LEVEL)"
    environment = {name: value for name, value in os.environ.items() if name != "COFRAME_CPU_LEVEL"}
    for asked, got in ((None, _core.CPU_LEVELS[-1]), ("", _core.CPU_LEVELS[-1]), *((x, x) for x in _core.CPU_LEVELS)):
        extra = {} if asked is None else {"COFRAME_CPU_LEVEL": asked}
        result = subprocess.run(
            [sys.executable, "-c", show], env={**environment, **extra}, capture_output=True, text=True, check=True
        )
        assert result.stdout.strip() == got
    result = subprocess.run(
        [sys.executable, "-c", show],
        env={**environment, "COFRAME_CPU_LEVEL": "pdp-11"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "COFRAME_CPU_LEVEL is pdp-11, but this processor has plain" in result.stderr


def slerp_by_hand(a, b, t):
    """Return the interpolation along the shorter arc, computed one by one with libm."""
    cosine = float(np.dot(a, b))
    if cosine < 0.0:
        b, cosine = -b, -cosine
    angle = np.arctan2(np.linalg.norm(b - cosine * a), cosine)
    if angle < 1e-8:
        return (1 - t) * a + t * b
    return (np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / np.sin(angle)


@pytest.fixture(scope="module")
def turns():
    """Return a buffer with pairs of samples, times between them, and the expected quaternions."""
    random = np.random.default_rng(7)
    buffer = coframe.Buffer(None)
    times, expected, start = [], [], 1_000_000_000
    for turn in TURNS:
        for _ in range(4):
            first = Rotation.random(random_state=random.integers(1 << 30))
            axis = random.normal(size=3)
            second = Rotation.from_rotvec(turn * axis / np.linalg.norm(axis)) * first
            for stamp, rotation in ((start, first), (start + PERIOD, second)):
                buffer.set("odom", "lidar", coframe.Transform(quaternion=rotation.as_quat()), stamp)
            ends = [buffer.lookup("odom", "lidar", stamp).quaternion for stamp in (start, start + PERIOD)]
            for share in np.linspace(0, 1, SHARES)[:-1]:
                time = start + round(share * PERIOD)
                times.append(time)
                expected.append(slerp_by_hand(*ends, (time - start) / PERIOD))
            start += 2 * PERIOD
    return buffer, np.array(times), np.array(expected)


@pytest.mark.parametrize("order", ["as they come", "shuffled", "together"])
def test_interpolation_of_rotations_of_any_size(order, turns):
    buffer, times, expected = turns
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    copies = 30 if order == "together" else 1
    points = np.repeat(np.tile(corners, (len(times), 1)), copies, axis=0)
    each = np.repeat(times, 4 * copies)
    by_hand = np.repeat(Rotation.from_quat(expected).as_matrix().transpose(0, 2, 1), copies, axis=1)
    where = np.arange(len(points))
    if order == "shuffled":
        where = np.random.default_rng(0).permutation(where)
    result = np.empty_like(points)
    result[where] = deskew(points[where], each[where], buffer, "odom", source="lidar")
    result = result.reshape(len(times), 4 * copies, 3)
    assert np.abs(result[:, :copies]).max() < 1e-12
    assert np.abs(result[:, copies:] - by_hand).max() < 1e-12


def test_interpolation_equals_scipys_slerp(turns):
    buffer, times, _ = turns
    stamps = np.unique(times // PERIOD * PERIOD)
    small = [i for i, turn in enumerate(np.repeat(TURNS, 4)) if turn < 3.1]  # half a turn may go either way
    points = np.random.default_rng(1).normal(size=(SHARES - 1, 3))
    for i in small:
        start = int(stamps[i])
        ends = Rotation.from_quat([buffer.lookup("odom", "lidar", s).quaternion for s in (start, start + PERIOD)])
        own = times[(times >= start) & (times < start + PERIOD)]
        expected = Slerp([0, 1], ends)((own - start) / PERIOD).apply(points)
        assert np.abs(deskew(points, own, buffer, "odom", source="lidar") - expected).max() < 1e-12


def test_batches_equal_single_lookups(turns):
    buffer, times, expected = turns
    for time, by_hand in zip(times[::7], expected[::7], strict=True):
        found = buffer.lookup("odom", "lidar", int(time)).quaternion
        assert min(np.abs(found - by_hand).max(), np.abs(found + by_hand).max()) < 1e-12


def test_translations_far_away_and_long_intervals():
    """Stamps more than 52 days apart, up to the full range of int64."""
    far = 1e7
    for length in (2**51, 2**52, 2**53 + 1, 2**62):
        buffer = coframe.Buffer(None)
        buffer.set("odom", "lidar", coframe.Transform([far, 0, 0]), 1)
        buffer.set("odom", "lidar", coframe.Transform([far + 1, 0, 0]), 1 + length)
        times = np.linspace(1, length, 500).astype(np.int64)
        result = deskew(np.zeros((500, 3)), times, buffer, "odom", source="lidar")[:, 0]
        assert np.allclose(result - far, (times - 1) / length, rtol=0, atol=1e-8)
