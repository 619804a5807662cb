# SPDX-License-Identifier: Apache-2.0
"""deskew compared with SciPy's Slerp and with single lookups."""

import copy
import itertools
import threading

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from sensor_data import PERIOD, SECOND, START, Motion, array_of, message_of, xyz

import coframe
from coframe import _core
from coframe.sensors import deskew

COUNT = 3001


@pytest.fixture
def points(random):
    return random.normal(size=(COUNT, 3))


def times_of(kind, motion, random):
    """Return the orders in which points are given."""
    times = np.sort(random.integers(motion.first, motion.last + 1, COUNT))
    times[0], times[-1] = motion.first, motion.last
    if kind == "shuffled":
        random.shuffle(times)
    elif kind == "few":
        times = np.repeat(times[::50], 50)[:COUNT]
    elif kind == "rows":  # as a spinning lidar with several rings publishes them
        times = np.concatenate([times[i::7] for i in range(7)])
    elif kind == "backwards":
        times = times[::-1].copy()
    elif kind == "samples":
        times = random.choice(motion.stamps, COUNT)
    elif kind == "slow":  # all between two samples
        times = motion.first + np.sort(random.integers(0, PERIOD, COUNT))
    return times


KINDS = ["sorted", "shuffled", "few", "rows", "backwards", "samples", "slow"]


@pytest.mark.parametrize("kind", KINDS)
def test_each_point_is_transformed_at_its_own_time(kind, buffer, motion, points, random):
    times = times_of(kind, motion, random)
    before = points.copy()
    result = deskew(points, times, buffer, "odom", source="lidar")
    assert np.array_equal(points, before)
    assert np.abs(result - motion.apply(times, points)).max() < 1e-12
    for i in range(0, COUNT, 300):
        assert np.abs(result[i] - buffer.lookup("odom", "lidar", int(times[i])) @ points[i]).max() < 1e-12


@pytest.mark.parametrize("kind", KINDS)
def test_chains_of_many_edges_in_both_directions(kind, buffer, random, points):
    """lidar -> mast -> base -> odom <- map <- station, with the last edges in the other direction."""
    links = [("odom", "base"), ("base", "mast"), ("map", "odom"), ("map", "station")]
    motions = {child: Motion(seed).fill(buffer, parent, child) for seed, (parent, child) in enumerate(links)}
    for parent, child in (("mast", "tilted"), ("tilted", "lidar"), ("station", "desk")):
        turn = Rotation.random(random_state=8)
        buffer.set(parent, child, coframe.Transform([1, 2, 3], turn.as_quat()), static=True)
    times = times_of(kind, motions["base"], random)
    result = deskew(points, times, buffer, "desk", source="lidar")
    for i in range(0, COUNT, 97):
        expected = buffer.lookup("desk", "lidar", int(times[i])) @ points[i]
        assert np.abs(result[i] - expected).max() < 1e-12


def test_a_moving_target_is_used_at_one_time(buffer, motion, points, random):
    times = times_of("sorted", motion, random)
    at = START + 12 * PERIOD + 345
    in_odom = motion.apply(times, points)
    rotations, translations = motion.at([at])
    expected = rotations.inv().apply(in_odom - translations)
    result = deskew(points, times, buffer, "lidar", source="lidar", fixed="odom", at=at)
    assert np.abs(result - expected).max() < 1e-12
    cloud = message_of(structured(points), stamp=at)
    moved = deskew(cloud, times, buffer, "lidar", fixed="odom")
    assert np.abs(xyz(array_of(moved)[0]) - expected).max() < 1e-12
    assert (moved.header.frame_id, stamp_of(moved)) == ("lidar", at)
    assert (stamp_of(deskew(cloud, times, buffer, "lidar", fixed="odom", at=motion.last))) == motion.last
    latest = deskew(points, times, buffer, "lidar", source="lidar", fixed="odom", at=0)
    assert np.array_equal(latest, deskew(points, times, buffer, "lidar", source="lidar", fixed="odom", at=motion.last))


def structured(points, **fields):
    dtype = [(axis, "f8") for axis in "xyz"] + [(name, values.dtype) for name, values in fields.items()]
    result = np.zeros(len(points), dtype)
    result["x"], result["y"], result["z"] = points.T
    for name, values in fields.items():
        result[name] = values
    return result


def stamp_of(message):
    return message.header.stamp.sec * SECOND + message.header.stamp.nanosec


def test_fields_of_times(buffer, motion, points, random):
    times = times_of("sorted", motion, random)
    expected = deskew(points, times, buffer, "odom", source="lidar")
    since = times - START
    offsets = {
        "t": (since.astype("u4"), "ns", {}),
        "offset_us": (since.astype("f8") / 1e3, "us", {}),
        "offset_ms": (since.astype("f8") / 1e6, "ms", {}),
        "time": (since.astype("f8") / 1e9, "s", {}),
        "timestamp": (times.astype("f8") / 1e9, "s", {"since": 0}),
    }
    fields = {name: values for name, (values, _, _) in offsets.items()}
    cloud = message_of(structured(points, **fields))
    for name, (values, unit, options) in offsets.items():
        result = deskew(cloud, name, buffer, "odom", unit=unit, **options)
        tolerance = 5e-4 if name == "timestamp" else 1e-5 if unit == "s" else 1e-9
        assert np.abs(xyz(array_of(result)[0]) - expected).max() < tolerance, name
        read = array_of(result)[0]
        marked = f"deskewed_{name}"
        assert np.array_equal(read[marked], values), "the values stay as they are"
        assert not {*read.dtype.names} & {"t", "time", "timestamp", name}, "no reader takes them for times again"
        assert cloud.fields[3].name == "t", "the given message is not changed"
        with pytest.raises(ValueError, match="no field"):
            deskew(result, name, buffer, "odom", source="lidar", unit=unit, **options)
        assert (result.header.frame_id, stamp_of(result)) == ("odom", START)
    array = structured(points, **fields)
    result = deskew(array, "t", buffer, "odom", source="lidar", unit="ns", since=START)
    assert np.array_equal(xyz(result), expected)
    result = deskew(points, since, buffer, "odom", source="lidar", unit="ns", since=np.datetime64(START, "ns"))
    assert np.array_equal(result, expected)
    assert np.array_equal(deskew(points, times.view("M8[ns]"), buffer, "odom", source="lidar"), expected)
    with pytest.raises(ValueError, match=r"needs unit=.*'t'"):
        deskew(cloud, "t", buffer, "odom")
    with pytest.raises(ValueError, match="no field 'stamps'"):
        deskew(cloud, "stamps", buffer, "odom", unit="s")
    with pytest.raises(TypeError, match="int64 nanoseconds or datetime64"):
        deskew(points, times / 1e9, buffer, "odom", source="lidar")


def test_a_time_for_each_column_of_an_organized_cloud(buffer, motion, random):
    points = random.normal(size=(16, 100, 3))
    columns = motion.first + np.arange(100) * 1_000_000
    result = deskew(points, columns, buffer, "odom", source="lidar")
    expected = motion.apply(np.tile(columns, 16), points.reshape(-1, 3)).reshape(points.shape)
    assert np.abs(result - expected).max() < 1e-12
    each = np.broadcast_to(columns, (16, 100))
    assert np.array_equal(deskew(points, each, buffer, "odom", source="lidar"), result)
    with pytest.raises(ValueError, match="99 for points of shape"):
        deskew(points, columns[:-1], buffer, "odom", source="lidar")


@pytest.mark.parametrize("dtype", ["f4", ">f4", "f8", ">f8"])
def test_any_layout_in_place_and_as_a_copy(dtype, buffer, motion, points, random):
    times = times_of("rows", motion, random)
    clouds = np.zeros(COUNT, [("t", "u1"), ("z", dtype), ("y", dtype), ("x", dtype)])
    clouds["x"], clouds["y"], clouds["z"] = points.T
    expected = motion.apply(times, xyz(clouds))
    result = deskew(clouds, times, buffer, "odom", source="lidar")
    assert np.allclose(xyz(result), expected, rtol=0, atol=1e-6 if "4" in dtype else 1e-12)
    assert deskew(clouds, times, buffer, "odom", source="lidar", in_place=True) is clouds
    assert result.dtype.names == ("deskewed_t", "z", "y", "x")
    assert np.array_equal(clouds, result.view(clouds.dtype))
    out = np.zeros_like(clouds)
    assert deskew(clouds, times, buffer, "odom", source="lidar", out=out) is out
    assert clouds.dtype.names == out.dtype.names == ("t", "z", "y", "x"), "the caller's arrays keep their fields"


@pytest.mark.parametrize("kind", KINDS)
def test_normals_are_rotated(kind, buffer, motion, points, random):
    times = times_of(kind, motion, random)
    cloud = structured(points, normal_x=points[:, 1], normal_y=points[:, 2], normal_z=points[:, 0])
    result = deskew(cloud, times, buffer, "odom", source="lidar")
    rotations, _ = motion.at(times)
    normals = ("normal_x", "normal_y", "normal_z")
    assert np.abs(xyz(result, normals) - rotations.apply(xyz(cloud, normals))).max() < 1e-12
    columns = deskew(np.hstack((points, points)), times, buffer, "odom", source="lidar", vectors=(3, 4, 5))
    assert np.abs(columns[:, 3:] - rotations.apply(points)).max() < 1e-12


@pytest.mark.parametrize("threads", [2, 5])
@pytest.mark.parametrize("kind", KINDS)
def test_results_do_not_depend_on_the_number_of_threads(kind, threads, buffer, motion, points, random):
    times = times_of(kind, motion, random)
    alone = deskew(points, times, buffer, "odom", source="lidar")
    assert np.array_equal(deskew(points, times, buffer, "odom", source="lidar", threads=threads), alone)


def test_the_error_names_the_point_without_a_transform(buffer, motion, points, random):
    times = times_of("sorted", motion, random)
    times[1234] = motion.last + 7
    before = points.copy()
    with pytest.raises(
        coframe.ExtrapolationException, match=r"^point 1234 of 3001, measured at .* into the future"
    ) as e:
        deskew(points, times, buffer, "odom", source="lidar", in_place=True)
    assert np.array_equal(points, before)
    assert e.value.requested == motion.last + 7
    assert e.value.edge == ("odom", "lidar")
    assert "odom -> lidar has samples" in e.value.hint
    assert isinstance(e.value.__cause__, coframe.ExtrapolationException)
    times[17] = motion.first - 1
    with pytest.raises(coframe.ExtrapolationException, match=r"^point 17 of 3001, .* into the past"):
        deskew(points, times, buffer, "odom", source="lidar")


@pytest.mark.parametrize("kind", KINDS)
def test_points_without_a_transform_become_nan_on_request(kind, buffer, motion, points, random):
    times = times_of(kind, motion, random)
    missing = random.random(COUNT) < 0.1
    times[missing] = random.choice([motion.first - 1, motion.last + 1, 1, -5], missing.sum())
    cloud = structured(points, nx=points[:, 0], ny=points[:, 1], nz=points[:, 2])
    result = deskew(cloud, times, buffer, "odom", source="lidar", on_error="nan")
    for names in (("x", "y", "z"), ("nx", "ny", "nz")):
        assert np.array_equal(np.isnan(xyz(result, names)).all(axis=1), missing)
        assert np.array_equal(np.isnan(xyz(result, names)).any(axis=1), missing)
    expected = motion.apply(times[~missing], points[~missing])
    assert np.abs(xyz(result)[~missing] - expected).max() < 1e-12


def test_times_that_are_nan(buffer, motion, points, random):
    """Lidars publish no time for beams without an echo."""
    seconds = (times_of("sorted", motion, random) - START) / 1e9
    seconds[::10] = np.nan
    seconds[5] = 1e300
    options = {"source": "lidar", "unit": "s", "since": START}
    result = deskew(points, seconds, buffer, "odom", on_error="nan", **options)
    missing = np.isnan(result).any(axis=1)
    assert np.flatnonzero(missing).tolist() == sorted([*range(0, COUNT, 10), 5])
    with pytest.raises(coframe.ExtrapolationException, match=r"^point 0 of 3001"):
        deskew(points, seconds, buffer, "odom", **options)


def test_points_are_not_changed_if_none_has_a_transform(buffer, motion, points):
    before = points.copy()
    times = np.full(COUNT, motion.last + 1)
    for on_error in ("raise", "nan"):
        with pytest.raises(coframe.ExtrapolationException, match=r"^point 0 of 3001"):
            deskew(points, times, buffer, "odom", source="lidar", on_error=on_error, in_place=True)
    assert np.array_equal(points, before)


@pytest.mark.parametrize("localized", [False, True])
def test_a_joint_between_robot_and_sensor_does_not_hide_that_the_robot_moves(motion, points, random, localized):
    """A spinning lidar on a robot, whose map is corrected a little by a localization."""
    buffer = coframe.Buffer(None)
    motion.fill(buffer, "odom", "base_link")
    for i in range(200):
        turned = coframe.Transform.from_rpy([0.0, 0.0, 0.5], [0.0, 0.0, 1.3 * i])
        buffer.set("base_link", "lidar", turned, START + i * PERIOD)
        if localized:
            buffer.set("map", "odom", coframe.Transform([1000.0 * (i // 50), 0.0, 0.0]), START + i * PERIOD)
    buffer.set("base_link", "camera", coframe.Transform([0.3, 0.0, 0.0]), static=True)
    times = START + np.sort(random.integers(0, 40 * PERIOD, len(points)))
    for target in ("base_link", "camera"):
        with pytest.raises(ValueError, match=f"'{target}', which moves with the sensor: for example fixed='odom'"):
            deskew(points, times, buffer, target, source="lidar")
        moved = deskew(points, times, buffer, target, source="lidar", fixed="odom", at=int(times[-1]))
        still = deskew(points, times, buffer, target, source="lidar", fixed=target)
        assert np.abs(moved - still).max() > 1e-3
    deskew(points, times, buffer, "odom", source="lidar")
    if localized:
        deskew(points, times, buffer, "map", source="lidar")


def test_a_joint_of_a_robot_that_stands_still_needs_no_other_frame(points, random):
    buffer = coframe.Buffer(None)
    for i in range(200):
        turned = coframe.Transform.from_rpy([0.0, 0.0, 0.5], [0.0, 0.0, 0.1 * i])
        buffer.set("base_link", "lidar", turned, START + i * PERIOD)
        buffer.set("world", "base_link", coframe.Transform([3.0, 0.0, 0.0]), START + i * PERIOD)
    times = START + np.sort(random.integers(0, 40 * PERIOD, len(points)))
    assert np.isfinite(deskew(points, times, buffer, "base_link", source="lidar")).all()


@pytest.mark.parametrize("mount", ["static", "published"])
def test_a_target_that_moves_with_the_sensor_is_refused(mount, buffer, motion, points, random):
    """Otherwise the result would be that of no deskewing, without a word."""
    for stamp in (motion.first, motion.last):
        turned = coframe.Transform([0.3, 0, 0.1])
        buffer.set("lidar", "cover", turned, None if mount == "static" else stamp, static=mount == "static")
    times = times_of("sorted", motion, random)
    with pytest.raises(ValueError, match="'lidar', which moves with the sensor: for example fixed='odom'"):
        deskew(points, times, buffer, "lidar", source="cover")
    insisted = deskew(points, times, buffer, "lidar", source="cover", fixed="lidar")
    assert np.allclose(insisted, points + np.array([0.3, 0, 0.1]))
    at = motion.first + 5
    result = deskew(points, times, buffer, "lidar", source="cover", fixed="odom", at=at)
    expected = buffer.lookup("lidar", "odom", at) @ motion.apply(times, points + np.array([0.3, 0, 0.1]))
    assert np.abs(result - expected).max() < 1e-9


def test_time_zero_is_the_latest(buffer, motion, points, random):
    times = times_of("sorted", motion, random)
    times[::3] = 0
    result = deskew(points, times, buffer, "odom", source="lidar")
    times[::3] = motion.last
    assert np.array_equal(result, deskew(points, times, buffer, "odom", source="lidar"))


@pytest.mark.parametrize(
    ("target", "source", "error", "text"),
    [
        ("odom", "camera", coframe.LookupException, "^point 0 of 2, .*camera"),
        ("world", "lidar", coframe.LookupException, "^point 0 of 2, .*world"),
        ("odom", "island", coframe.ConnectivityException, "^point 0 of 2, "),
        ("odom", "/lidar", coframe.InvalidArgumentException, "^point 0 of 2, "),
        ("odom", "", coframe.InvalidArgumentException, "^point 0 of 2, "),
    ],
)
def test_unknown_frames_are_refused(target, source, error, text, buffer, motion):
    buffer.set("sea", "island", coframe.Transform(), static=True)
    with pytest.raises(error, match=text):
        deskew(np.zeros((2, 3)), [motion.first, motion.last], buffer, target, source=source)


def test_repeated_stamps_are_handled_like_in_lookups(buffer):
    """Several samples of one stamp, at the ends and in the middle."""
    for number, stamp in enumerate([10, 10, 20, 30, 30, 30, 40, 50, 50]):
        buffer.set("odom", "lidar", coframe.Transform([float(number), 0, 0]), stamp)
    times = np.repeat(np.arange(10, 51), 2)
    for order in (times, times[::-1].copy(), np.random.default_rng(4).permutation(times)):
        result = deskew(np.zeros((len(order), 3)), order, buffer, "odom", source="lidar")
        single = [buffer.lookup("odom", "lidar", int(time)).translation for time in order]
        assert np.allclose(result, single, rtol=0, atol=1e-12)
    for first, last in ((10, 10), (30, 30), (50, 50), (25, 30), (30, 35)):
        order = np.array([first, last])
        result = deskew(np.zeros((2, 3)), order, buffer, "odom", source="lidar")
        single = [buffer.lookup("odom", "lidar", int(time)).translation for time in order]
        assert np.allclose(result, single, rtol=0, atol=1e-12)


def test_a_single_sample_and_static_edges(buffer, points):
    buffer.set("odom", "base", coframe.Transform([1, 0, 0]), 100)
    buffer.set("base", "lidar", coframe.Transform([0, 1, 0]), static=True)
    result = deskew(points, np.full(COUNT, 100), buffer, "odom", source="lidar")
    assert np.allclose(result, points + np.array([1, 1, 0]))
    with pytest.raises(coframe.ExtrapolationException, match=r"^point 0 of 3001"):
        deskew(points, np.full(COUNT, 101), buffer, "odom", source="lidar")
    anywhen = np.random.default_rng(0).integers(-(2**62), 2**62, COUNT)
    assert np.allclose(deskew(points, anywhen, buffer, "base", source="lidar"), points + np.array([0, 1, 0]))


def test_a_frame_that_changes_its_parent(buffer, motion, points, random):
    """Such chains are not cached: each point has its own lookup."""
    buffer.set("odom", "base", coframe.Transform([5, 0, 0]), static=True)
    turned = coframe.Transform([0, 0, 1], Rotation.random(random_state=1).as_quat())
    buffer.set("base", "lidar", turned, motion.last + PERIOD)
    buffer.set("base", "lidar", turned, motion.last + 2 * PERIOD)
    times = np.append(times_of("rows", motion, random)[:-2], [motion.last + PERIOD, motion.last + 3 * PERIOD])
    cloud = structured(points, nx=points[:, 0], ny=points[:, 1], nz=points[:, 2])
    result = deskew(cloud, times, buffer, "odom", source="lidar", on_error="nan")
    assert np.isnan(xyz(result)).any(axis=1).tolist() == [False] * (COUNT - 1) + [True]
    assert np.isnan(xyz(result, ("nx", "ny", "nz"))).any(axis=1).tolist() == [False] * (COUNT - 1) + [True]
    for i in range(0, COUNT - 1, 100):
        single = buffer.lookup("odom", "lidar", int(times[i]))
        assert np.abs(xyz(result)[i] - single @ points[i]).max() < 1e-12
        turned_only = single.rotation @ points[i]
        assert np.abs(xyz(result, ("nx", "ny", "nz"))[i] - turned_only).max() < 1e-12
    with pytest.raises(coframe.ExtrapolationException, match=r"^point 3000 of 3001"):
        deskew(cloud, times, buffer, "odom", source="lidar")


def test_the_fixed_frame_can_be_that_of_the_sensor(buffer, motion, points):
    at = motion.first + 12345
    result = deskew(points, np.zeros(COUNT, np.int64), buffer, "odom", source="lidar", fixed="lidar", at=at)
    assert np.abs(result - motion.apply(np.full(COUNT, at), points)).max() < 1e-12


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({"target": "lidar"}, ValueError, "needs fixed=... for the target"),
        ({"source": None}, TypeError, "needs source="),
        ({"fixed": "odom", "target": "lidar"}, TypeError, "needs at="),
        ({"buffer": "odom"}, TypeError, "needs a coframe.Buffer, not str"),
        ({"on_error": "clip"}, ValueError, "on_error must be"),
        ({"unit": "h"}, ValueError, "unit must be one of"),
        ({"times": ["a", "b"], "unit": "s"}, TypeError, "must be numbers"),
        ({"threads": -1}, ValueError, "threads must be"),
        ({"times": [1, 2, 3]}, ValueError, "3 for points of shape"),
    ],
)
def test_invalid_arguments_are_refused(options, error, text, buffer, motion):
    times = [motion.first, motion.last]
    arguments = {"times": times, "buffer": buffer, "target": "odom", "source": "lidar", **options}
    with pytest.raises(error, match=text):
        deskew(np.zeros((2, 3)), **arguments)


def test_no_points(buffer):
    assert deskew(np.zeros((0, 3)), [], buffer, "odom", source="lidar").shape == (0, 3)
    empty = message_of(np.zeros(0, [(axis, "f4") for axis in "xyz"]))
    assert deskew(empty, np.zeros(0, np.int64), buffer, "odom").header.frame_id == "odom"


def test_insertions_during_deskewing(buffer, motion, points, random):
    """All points use one state of the tree, although newer and older samples are inserted in the meantime."""
    done = threading.Event()
    times = np.tile(times_of("sorted", motion, random), 100)
    wide = np.tile(points, (100, 1))
    expected = deskew(wide, times, buffer, "odom", source="lidar")

    def write():
        identity = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        for number in itertools.count(1):
            if done.is_set():
                return
            buffer._set_values("odom", "lidar", motion.last + 2 * number, *identity, False, "test")
            buffer._set_values("odom", "lidar", motion.last + number, *identity, False, "test")
            buffer._set_values("odom", f"child {number}", START, *identity, False, "test")

    writer = threading.Thread(target=write)
    writer.start()
    try:
        for threads in (1, 2) * 5:
            result = deskew(wide, times, buffer, "odom", source="lidar", threads=threads)
            assert np.abs(result - expected).max() < 1e-12
    finally:
        done.set()
        writer.join()


def test_the_given_message_is_not_changed(buffer, motion, points, random):
    cloud = message_of(structured(points))
    before = copy.deepcopy(cloud)
    deskew(cloud, times_of("sorted", motion, random), buffer, "odom", at=motion.last)
    assert cloud == before


def test_the_native_function_checks_sizes(buffer):
    fields = [tuple(np.zeros((3, 3)).T)]
    with pytest.raises(ValueError, match="as many times as points"):
        _core.deskew_fields(buffer, "odom", "lidar", np.zeros(2, np.int64), [0, 0, 0, 0, 0, 0, 1], fields, False, 1)
    with pytest.raises(ValueError, match="7 numbers"):
        _core.transform_fields([1.0], fields, 1)
    with pytest.raises(ValueError, match="three coordinates"):
        _core.transform_fields([0, 0, 0, 0, 0, 0, 1], [np.zeros((2, 3))], 1)
    with pytest.raises(ValueError, match="same shape"):
        _core.transform_fields([0, 0, 0, 0, 0, 0, 1], [(np.zeros(3), np.zeros(4), np.zeros(3))], 1)
    with pytest.raises(ValueError, match="float32 or float64"):
        _core.transform_fields([0, 0, 0, 0, 0, 0, 1], [tuple(np.zeros((3, 3), int))], 1)
    with pytest.raises(ValueError, match="one or two axes"):
        _core.transform_fields([0, 0, 0, 0, 0, 0, 1], [tuple(np.zeros((3, 2, 2, 2)))], 1)
    with pytest.raises(ValueError, match="at least one field is required"):
        _core.transform_fields([0, 0, 0, 0, 0, 0, 1], [], 1)
