# SPDX-License-Identifier: Apache-2.0
"""Clouds and scans of recordings: transformed points, skipped messages with reasons, and all file formats."""

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from recordings import SECOND, START

import coframe
from coframe.bags import Clouds, write_clouds
from coframe.cli.app import app
from coframe.messages import find, serialize

CLOUD, SCAN = "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/LaserScan"
DATATYPES = {"<f4": 7, "<f8": 8, "<u4": 6, "<u2": 4}
SWEEP = SECOND // 10
KINDS = ("ouster", "velodyne", "hesai", "livox")
WALL = np.array([[5.0, 0.1, 1.0], [4.0, 2.0, 1.0], [3.0, -1.0, 0.5], [2.5, 0.5, 0.2]])


def cloud_message(points, stamp, frame="lidar"):
    message = find(CLOUD)()
    message.header.frame_id = frame
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
    message.height, message.width = 1, len(points)
    for name in points.dtype.names:
        kind, offset = points.dtype.fields[name][:2]
        message.fields.append(
            find("sensor_msgs/msg/PointField")(name=name, offset=offset, datatype=DATATYPES[kind.str], count=1)
        )
    message.point_step, message.row_step = points.itemsize, points.nbytes
    message.data = points.tobytes()
    return serialize(message)


def truth():
    """Return the transforms of a robot that drives at 1 m/s and turns at the same time."""
    buffer = coframe.Buffer(None)
    for i in range(41):
        at = START + i * SECOND // 20
        buffer.set("map", "base", coframe.Transform.from_rpy([i / 20, 0, 0], [0, 0, i / 30]), at)
    buffer.set("base", "lidar", coframe.Transform.from_rpy([0.1, 0, 0.3], [0, 0, 0.5]), static=True)
    return buffer


def measured(times, walls=WALL):
    """Return the points of the wall as the lidar measures them at these times."""
    poses = truth().lookup_many("lidar", "map", times)
    return np.stack([poses[i] @ walls[i % len(walls)] for i in range(len(times))])


def sweep(stamp, kind):
    """Return a cloud whose points were measured one after the other."""
    offsets = np.arange(len(WALL)) * SWEEP // len(WALL)
    times = {
        "ouster": ("t", "<u4", offsets),
        "velodyne": ("time", "<f4", offsets / SECOND),
        "hesai": ("timestamp", "<f8", (stamp + offsets) / SECOND),
        "livox": ("timestamp", "<f8", (stamp + offsets).astype(float)),
        "other": ("us", "<u4", offsets // 1000),
    }
    name, dtype, values = times.get(kind, ("ring", "<f4", np.zeros(len(WALL))))
    points = np.zeros(len(WALL) + 1, [(a, "<f4") for a in "xyz"] + [("intensity", "<u2"), (name, dtype)])
    for axis, column in zip("xyz", measured(stamp + offsets).T, strict=True):
        points[axis][:-1] = column
    points["intensity"] = np.arange(len(points))
    points[name][:-1] = values
    points[name][-1] = np.nan if kind == "velodyne" else values[0]  # a beam without an echo
    points["x"][-1] = np.nan
    return cloud_message(points, stamp)


@pytest.fixture
def path(tmp_path):
    """Return a recording with transforms for two seconds, clouds in that time, and messages that cannot be read."""
    rows, buffer = [], truth()
    for i in range(41):
        at = START + i * SECOND // 20
        rows.append(("/tf", at, recordings.cdr("map", "base", buffer.lookup("map", "base", at), at)))
    rows.append(("/tf_static", START, recordings.cdr("base", "lidar", buffer.lookup("base", "lidar"), START)))
    for i in range(2, 18):
        stamp = START + i * SWEEP
        rows += [(f"/points_{kind}", stamp, sweep(stamp, kind)) for kind in (*KINDS, "other")]
        rows += [("/points", stamp, sweep(stamp, "ring"))]
    for stamp in (START - SECOND, START + 3 * SECOND):
        rows.append(("/points_ouster", stamp, cloud_message(np.ones(3, [(a, "<f4") for a in "xyz"]), stamp)))
    rows.append(("/points_ouster", START + SECOND, cloud_message(np.ones(3, [("x", "<f4")]), START + SECOND)))
    rows.append(("/points_ouster", START + SECOND + 1, b"\0\1\0\0 no cloud"))
    rows.append(
        ("/points_ouster", START + SECOND, cloud_message(np.ones(3, [(a, "<f4") for a in "xyz"]), START, "attic"))
    )
    types = {topic: (CLOUD, "ros2msg", b"", "cdr") for topic in {row[0] for row in rows} if "points" in topic}
    return recordings.write_mcap(tmp_path / "run.mcap", rows=rows, types=types)


def xyz(points):
    return np.stack([points[axis] for axis in "xyz"], axis=1)


@pytest.mark.parametrize("kind", KINDS)
def test_points_of_a_moving_sensor_are_on_the_wall(path, kind):
    with coframe.open_bag(path) as recording:
        for cloud in Clouds(recording, f"points_{kind}", "map", start=START + 2 * SWEEP, stop=START + SECOND):
            assert cloud.deskewed
            np.testing.assert_allclose(xyz(cloud.points), WALL, rtol=0, atol=1e-6)
            assert cloud.points["intensity"].tolist() == [0, 1, 2, 3]
            assert (cloud.frame, cloud.points.dtype["x"]) == ("map", np.float64)
        smeared = next(iter(Clouds(recording, f"points_{kind}", "map", start=START + 2 * SWEEP, deskew="off")))
        assert not smeared.deskewed
        assert 0.03 < np.abs(xyz(smeared.points) - WALL).max() < 0.5


def test_the_field_with_the_times_can_be_given(path):
    """The driver uses the name `us`, which is not among the usual ones."""
    stamp = START + 5 * SWEEP
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points_other", "map", at=stamp)
        (unknown,) = clouds
        assert not unknown.deskewed
        assert clouds.not_deskewed == {"'us' may be the time of each point: select it with its unit": 1}
        clouds = Clouds(recording, "/points_other", "map", at=stamp, point_times="us:us")
        (cloud,) = clouds
        assert clouds.times_read == {"the field us, interpreted in us relative to the message's stamp": 1}
        np.testing.assert_allclose(xyz(cloud.points), WALL, rtol=0, atol=1e-6)
        (found,) = Clouds(recording, "/points_other", "map", at=stamp, point_times="us")
        np.testing.assert_allclose(xyz(found.points), WALL, rtol=0, atol=1e-6)
        clouds = Clouds(recording, "/points_other", "map", at=stamp, point_times="us:ns")
        (misread,) = clouds
        assert np.abs(xyz(misread.points) - WALL).max() > 0.03
        doubt = "the field us read in ns results in a sweep of 75 us, but there is a message every 100 ms"
        assert clouds.doubts == {doubt: 1}
        wrong = Clouds(recording, "/points_other", "map", at=stamp, point_times="us:s")
        assert list(wrong) == []
        assert list(wrong.skipped) == [
            "cannot be read: the times in field 'us', read in s, differ from the stamp by more than 10 s"
        ]
        missing = Clouds(recording, "/points_other", "map", at=stamp, point_times="time", fields=[])
        assert list(missing) == []
        assert "the points have no field 'time'" in next(iter(missing.skipped))
        with pytest.raises(
            ValueError, match=r"'us:h' is not a field with a unit. Write it as FIELD:UNIT, for example time:us"
        ):
            Clouds(recording, "/points_other", "map", point_times="us:h")


def test_the_command_reports_how_times_were_read(path, tmp_path):
    command = ["cloud", str(path), "/points_velodyne", "--frame", "map", "-o", str(tmp_path / "out.ply")]
    ended = CliRunner().invoke(app, command)
    assert ended.exit_code == 0
    assert "coframe: deskewed the points of 16 messages by their own times: the field time, " in ended.stderr
    assert "interpreted in s relative to the message's stamp" in ended.stderr
    for option in ("time:h", ":s"):
        ended = CliRunner().invoke(app, [*command, "--point-times", option])
        assert (ended.exit_code, f"'{option}' is not a field with a unit" in ended.stderr) == (2, True)


def test_unknown_formats_and_frames_are_errors(path, tmp_path):
    def cloud(*options, frame="map", output="out.ply"):
        ended = CliRunner().invoke(app, ["cloud", str(path), *options, "--frame", frame, "-o", str(tmp_path / output)])
        return ended.exit_code, ended.stderr

    code, text = cloud("/points", output="out.las")
    assert (code, "No format named 'las'" in text) == (2, True)
    code, text = cloud("/points", frame="mapp")
    assert (code, text.count("mapp"), "Did you mean 'map'?" in text) == (1, 2, True)
    assert not list(tmp_path.glob("out*"))


def test_scans_have_two_fields(shared):
    with coframe.open_bag(shared / "recordings" / "tb3_gazebo_walker") as recording:
        with pytest.raises(ValueError, match=r"Scans have no field named ring. Known fields: index, intensity"):
            Clouds(recording, "/scan", "odom", fields=["ring"])
        (cloud,) = Clouds(recording, "/scan", "odom", fields=["index"], at=recording.span[1])
        assert cloud.points.dtype.names == ("x", "y", "z", "index")


def test_a_moving_target_frame_needs_a_fixed_frame(path):
    with coframe.open_bag(path) as recording:
        stamp = START + 5 * SWEEP
        (cloud,) = Clouds(recording, "/points_ouster", "base", fixed="map", at=stamp)
        expected = recording.buffer.lookup("base", "map", stamp) @ WALL
        np.testing.assert_allclose(xyz(cloud.points), expected, rtol=0, atol=1e-6)


TIMES_IN_UNITS = {
    "seconds": ("time", "<f4", lambda offsets, _: offsets / 1e9),
    "milliseconds": ("time", "<f4", lambda offsets, _: offsets / 1e6),
    "microseconds": ("time", "<f4", lambda offsets, _: offsets / 1e3),
    "nanoseconds": ("t", "<f4", lambda offsets, _: offsets),
    "integer nanoseconds": ("t", "<u4", lambda offsets, _: offsets),
    "integer microseconds": ("time_offset", "<u4", lambda offsets, _: offsets // 1000),
    "integer milliseconds": ("t", "<u2", lambda offsets, _: offsets // 1_000_000),
    "stamps in seconds": ("timestamp", "<f8", lambda offsets, stamp: (stamp + offsets) / 1e9),
    "stamps in milliseconds": ("timestamp", "<f8", lambda offsets, stamp: (stamp + offsets) / 1e6),
    "stamps in microseconds": ("timestamp", "<f8", lambda offsets, stamp: (stamp + offsets) / 1e3),
    "seconds before the stamp": ("time", "<f4", lambda offsets, _: (offsets - SWEEP) / 1e9),
}


@pytest.mark.parametrize("unit", TIMES_IN_UNITS)
def test_the_unit_of_point_times_follows_from_the_sweep(unit, tmp_path):
    """Drivers use any unit; a wrong one would leave the points where they are or smear them by meters."""
    name, kind, values = TIMES_IN_UNITS[unit]
    before = SWEEP if "before" in unit else 0
    rows = tf_rows()
    offsets = np.arange(len(WALL)) * SWEEP // len(WALL)
    for i in range(2, 8):
        stamp = START + i * SWEEP
        points = np.zeros(len(WALL), [(a, "<f4") for a in "xyz"] + [(name, kind)])
        for axis, column in zip("xyz", measured(stamp + offsets - before).T, strict=True):
            points[axis] = column
        points[name] = values(offsets, stamp)
        rows.append(("/points", stamp, cloud_message(points, stamp)))
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/points": (CLOUD, "ros2msg", b"", "cdr")})
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", "map")
        for cloud in clouds:
            np.testing.assert_allclose(xyz(cloud.points), WALL, rtol=0, atol=1e-5)
        assert (clouds.deskewed, clouds.not_deskewed, clouds.doubts) == (6, {}, {})


def tf_rows():
    buffer = truth()
    stamps = [START + i * SECOND // 20 for i in range(41)]
    rows = [("/tf", at, recordings.cdr("map", "base", buffer.lookup("map", "base", at), at)) for at in stamps]
    rows.append(("/tf_static", START, recordings.cdr("base", "lidar", buffer.lookup("base", "lidar"), START)))
    return rows


def test_times_in_no_known_unit_are_reported(tmp_path):
    stamp = START + SECOND
    points = np.ones(4, [(a, "<f4") for a in "xyz"] + [("time", "<f8")])
    points["time"] = np.arange(4) * 1e40
    rows = [*tf_rows(), ("/points", stamp, cloud_message(points, stamp))]
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/points": (CLOUD, "ros2msg", b"", "cdr")})
    ended = CliRunner().invoke(app, ["cloud", str(path), "/points", "--frame", "map", "-o", str(tmp_path / "a.ply")])
    assert "did not deskew the points of 1 message: the field 'time' has values from 0 to 3e+40" in ended.stderr
    assert ended.stdout.endswith("a.ply: 4 points of 1 message, in frame 'map'\n")


@pytest.mark.parametrize("frame", ["base", "lidar"])
def test_a_frame_that_moves_with_the_sensor_is_deskewed_in_the_nearest_frame_that_does_not(path, tmp_path, frame):
    stamp = START + 5 * SWEEP
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points_hesai", frame, at=stamp)
        (cloud,) = clouds
        assert (cloud.deskewed, clouds.fixed_frames) == (True, {"map": 1})
        expected = recording.buffer.lookup(frame, "map", stamp) @ WALL
        np.testing.assert_allclose(xyz(cloud.points), expected, rtol=0, atol=1e-6)
    command = ["cloud", str(path), "/points_hesai", "--frame", frame, "-o", str(tmp_path / "a.ply")]
    ended = CliRunner().invoke(app, command)
    assert f"in the frame 'map', because '{frame}' moves with the sensor; as with --fixed map" in ended.stderr
    assert "64 points of 16 messages (16 deskewed), in frame" in ended.stdout


def test_messages_without_a_sweep_have_the_fields_of_the_others(tmp_path):
    rows = tf_rows()
    rows += [("/points", START + i * SWEEP, sweep(START + i * SWEEP, "livox")) for i in range(2, 8)]
    one = np.zeros(1, [(a, "<f4") for a in "xyz"] + [("intensity", "<u2"), ("timestamp", "<f8")])
    rows.append(("/points", START + 8 * SWEEP, cloud_message(one, START + 8 * SWEEP)))
    rows.append(("/points", START + 9 * SWEEP, cloud_message(one[:0], START + 9 * SWEEP)))
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/points": (CLOUD, "ros2msg", b"", "cdr")})
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", "map")
        assert write_clouds(clouds, tmp_path / "a.npy") == 25
        assert (clouds.messages, clouds.deskewed) == (8, 6)
    assert np.load(tmp_path / "a.npy").dtype.names[-1] == "deskewed_timestamp"


def test_without_any_motion_nothing_is_called_deskewed(tmp_path):
    stamp = START + SECOND
    rows = [("/tf_static", START, recordings.cdr("base", "lidar", coframe.Transform([1, 0, 0]), START))]
    rows.append(("/points", stamp, sweep(stamp, "ouster")))
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/points": (CLOUD, "ros2msg", b"", "cdr")})
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", "base")
        (cloud,) = clouds
        assert not cloud.deskewed
        (reason,) = clouds.not_deskewed
        assert reason == "no transform moves 'lidar' relative to 'base' or to a frame above it"


@pytest.mark.parametrize("kind", KINDS)
def test_written_clouds_are_not_deskewed_twice(path, tmp_path, kind):
    """Times that were used have another name, so that neither coframe nor another reader deskews by them again."""
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, f"/points_{kind}", "base", fixed="map", start=START, stop=START + 2 * SECOND)
        write_clouds(clouds, tmp_path / "points.mcap")
        expected = [cloud.points for cloud in clouds]
    with coframe.open_bag(tmp_path / "points.mcap") as written:
        again = Clouds(written, f"/points_{kind}", "base", fixed="base")
        for cloud, before in zip(again, expected, strict=True):
            np.testing.assert_allclose(xyz(cloud.points), xyz(before), rtol=0, atol=1e-6)
            (name,) = set(cloud.points.dtype.names) - {"x", "y", "z", "intensity"}
            assert name.startswith("deskewed_")
        assert (again.deskewed, again.not_deskewed) == (0, {})


@pytest.mark.parametrize("kind", ["pcd", "mcap", "ply"])
def test_float32_far_from_the_origin_is_said_once_and_avoidable(tmp_path, kind):
    """In UTM coordinates, float32 puts points into steps of half a meter."""
    stamp = START + SECOND
    far = coframe.Transform([500_000.125, 5_400_000.5, 400.0])
    rows = [("/tf_static", START, recordings.cdr("utm", "lidar", far, START))]
    points = np.zeros(4, [(a, "<f4") for a in "xyz"])
    points["y"] = np.arange(4) / 10
    rows += [("/points", stamp + i, cloud_message(points, stamp + i)) for i in range(3)]
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/points": (CLOUD, "ros2msg", b"", "cdr")})

    def written(*options):
        target = tmp_path / f"out.{kind}"
        ended = CliRunner().invoke(app, ["cloud", str(path), "/points", "--frame", "utm", "-o", str(target), *options])
        assert ended.exit_code == 0
        if kind == "mcap":
            with coframe.open_bag(target) as recording:
                cloud = next(iter(Clouds(recording, "/points", "utm")))
            return cloud.points["y"], ended.stderr
        return {"ply": read_ply, "pcd": read_pcd}[kind](target.read_bytes())["y"][:4], ended.stderr

    exact = 5_400_000.5 + points["y"].astype(float)
    rounded, text = written()
    assert text.count("float32 rounds coordinates of 5400001 m to steps of 500 mm") == (kind != "ply")
    assert (np.abs(rounded - exact).max() < 1e-9) == (kind == "ply")
    kept, text = written("--float64")
    np.testing.assert_allclose(kept, exact, rtol=0, atol=1e-9)
    assert "float32" not in text


@pytest.mark.parametrize(("frame", "fixed"), [("map", None), ("base", None), ("base", "map")])
def test_points_in_a_gap_of_the_transforms_are_reported_or_skipped(tmp_path, frame, fixed):
    """Without transforms for 0.9 s, the robot is taken to drive straight from one end to the other."""
    gap = (START + SECOND // 2, START + SECOND * 14 // 10)
    rows = [row for row in tf_rows() if row[0] == "/tf_static" or not gap[0] < row[1] < gap[1]]
    rows += [("/points", START + i * SWEEP, sweep(START + i * SWEEP, "ouster")) for i in range(2, 18)]
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/points": (CLOUD, "ros2msg", b"", "cdr")})
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", frame, fixed=fixed)
        assert len(list(clouds)) == 16
        assert clouds.gaps == {"base": 9}
        limited = Clouds(recording, "/points", frame, fixed=fixed, max_gap="200ms")
        kept = {cloud.stamp: len(cloud.points) for cloud in limited}
        assert [stamp for stamp, points in kept.items() if points] == [
            START + i * SWEEP for i in (2, 3, 4, 5, 14, 15, 16, 17)
        ]
        assert sum(limited.points_skipped.values()) > 0
        options = {"fixed": fixed, "max_gap": "200ms", "validity": True}
        filled = list(Clouds(recording, "/points", frame, on_gap="nan", **options))
        assert [len(cloud.points) for cloud in filled] == [len(WALL)] * 16
        for cloud in filled:
            in_gap = cloud.points["gap_ns"] > SECOND // 5
            assert np.array_equal(np.isnan(cloud.points["x"]), in_gap)
            assert kept[cloud.stamp] == np.count_nonzero(~in_gap)
        with pytest.raises(coframe.ExtrapolationException, match=r"lie in a gap of 9\d\d ms"):
            list(Clouds(recording, "/points", frame, on_gap="raise", **options))
        with pytest.raises(ValueError, match="on_gap"):
            Clouds(recording, "/points", frame, on_gap="clip", **options)
    words = ["cloud", str(path), "/points", "--frame", frame, "-o", str(tmp_path / "a.npz"), "--max-gap", "200ms"]
    ended = CliRunner().invoke(app, words)
    assert "they lie in a gap that is longer than max_gap" in ended.stderr
    assert CliRunner().invoke(app, [*words, "--on-gap", "raise"]).exit_code == 1
    assert CliRunner().invoke(app, [*words, "--on-gap", "skip"]).exit_code == 2
    ended = CliRunner().invoke(app, [*words, "--on-gap", "nan", "--validity"])
    with np.load(tmp_path / "a.npz") as data:
        assert np.isnan(data["x"]).any()
        assert len(data["gap_ns"]) == 16 * len(WALL)


def test_skipped_messages_are_counted_by_reason(path):
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points_ouster", "map")
        good = list(clouds)
        assert (clouds.total, len(good), clouds.messages) == (21, 16, 16)
        assert clouds.points == 16 * len(WALL) == sum(len(cloud.points) for cloud in good)
        reasons = sorted(clouds.skipped)
        assert sum(clouds.skipped.values()) == 5
        assert [reason.partition(":")[0] for reason in reasons] == [
            "ExtrapolationException",
            "LookupException",
            "cannot be read",
            "cannot be read",
        ]
        assert clouds.skipped[reasons[0]] == 2
        assert clouds.points_skipped == {"have no finite coordinates": 16}


def test_single_points_after_the_last_transform_are_skipped(tmp_path):
    stamp = START + 40 * SECOND // 20 - SWEEP // 2
    rows = [
        ("/tf", START + i, recordings.cdr("map", "lidar", coframe.Transform([i, 0, 0]), at))
        for i, at in enumerate((START, START + 2 * SECOND))
    ]
    points = np.ones(4, [(a, "<f4") for a in "xyz"] + [("t", "<u4")])
    points["t"] = np.arange(4) * SWEEP // 4
    rows.append(("/points", stamp, cloud_message(points, stamp)))
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/points": (CLOUD, "ros2msg", b"", "cdr")})
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", "map")
        (cloud,) = clouds
        assert len(cloud.points) == 3
        assert clouds.points_skipped == {"have no transform at their own time": 1}


def read_ply(data):
    head, _, body = data.partition(b"end_header\n")
    lines = head.decode().split("\n")
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    (count,) = [int(line.split()[2]) for line in lines if line.startswith("element vertex")]
    kinds = {"double": "<f8", "float": "<f4", "ushort": "<u2", "uint": "<u4", "int": "<i4"}
    dtype = [(line.split()[2], kinds[line.split()[1]]) for line in lines if line.startswith("property")]
    points = np.frombuffer(body, dtype)
    assert len(points) == count
    return points


def read_pcd(data):
    head, _, body = data.partition(b"DATA binary\n")
    facts = dict(line.split(" ", 1) for line in head.decode().splitlines() if not line.startswith("#"))
    kinds = [f"<{kind.lower()}{size}" for kind, size in zip(facts["TYPE"].split(), facts["SIZE"].split(), strict=True)]
    points = np.frombuffer(body, list(zip(facts["FIELDS"].split(), kinds, strict=True)))
    assert len(points) == int(facts["POINTS"]) == int(facts["WIDTH"]) * int(facts["HEIGHT"])
    return points


@pytest.mark.parametrize("kind", ["ply", "pcd", "npy", "npz", "mcap", "folder"])
def test_all_formats_contain_all_points(path, tmp_path, kind):
    target = tmp_path / ("out" if kind == "folder" else f"out.{kind}")
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", "map", deskew="off")
        assert write_clouds(clouds, target) == clouds.points == 16 * len(WALL)
        expected = [cloud.points for cloud in clouds]
        stamps = [cloud.stamp for cloud in clouds]
    if kind == "mcap":
        with coframe.open_bag(target) as written:
            messages = [message.message for message in written.messages("/points")]
            assert written.stamps("/points").tolist() == stamps
            assert {message.header.frame_id for message in messages} == {"map"}
            again = [next(iter(Clouds(written, "/points", "map", at=stamp))).points for stamp in stamps]
    elif kind == "folder":
        files = sorted(target.iterdir())
        assert [file.name for file in files] == [f"points_{stamp}.ply" for stamp in stamps]
        again = [read_ply(file.read_bytes()) for file in files]
    elif kind == "npz":
        columns = np.load(target)
        again = [{name: columns[name] for name in columns}]
        assert sorted(columns) == sorted(expected[0].dtype.names)
    else:
        read = {"ply": read_ply, "pcd": read_pcd, "npy": lambda _: np.load(target)}[kind]
        again = [read(target.read_bytes())]
    for name in ("x", "y", "z", "intensity"):
        ours = np.concatenate([points[name] for points in again])
        theirs = np.concatenate([points[name] for points in expected])
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-6 if kind in {"pcd", "mcap"} else 0)


def test_voxels_keep_one_point_each(path, tmp_path):
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points_ouster", "map", fields=[])
        cloud = clouds.accumulated(0.29)
        assert cloud.points.dtype.names == ("x", "y", "z")
        np.testing.assert_allclose(xyz(cloud.points), WALL, rtol=0, atol=1e-5)
        assert write_clouds(clouds, tmp_path / "a.ply", voxel=0.29) == len(WALL)
        with pytest.raises(ValueError, match="Use a larger one"):
            clouds.accumulated(1e-9)


def test_other_topics_and_unknown_fields_are_errors_with_hints(path, tmp_path):
    with coframe.open_bag(path) as recording:
        with pytest.raises(coframe.RecordingError, match="/tf has type tf2_msgs/msg/TFMessage, not Poi") as caught:
            Clouds(recording, "tf", "map")
        assert "/points_ouster" in caught.value.hint
        with pytest.raises(coframe.RecordingError, match="has no topic 'nothing'"):
            Clouds(recording, "nothing", "map")
        with pytest.raises(coframe.RecordingError, match=r"No message on /points can be tra.* attic: LookupExc"):
            write_clouds(Clouds(recording, "/points", "attic"), tmp_path / "a.ply")
        clouds = Clouds(recording, "/points", "map", fields=["color"])
        assert list(clouds) == []
        assert "the points have no field 'color'" in next(iter(clouds.skipped))
    assert not list(tmp_path.glob("*a.ply*"))


def test_scans_of_a_moving_sensor_are_deskewed(tmp_path):
    """The result is compared with a projection of each beam by hand."""
    buffer, stamp, beams = truth(), START + SECOND // 2, 60
    scan = find(SCAN)(angle_min=-1.0, angle_increment=2.0 / beams, time_increment=0.05 / beams, range_max=20.0)
    scan.header.frame_id = "/lidar"
    scan.header.stamp.sec, scan.header.stamp.nanosec = divmod(stamp, SECOND)
    scan.ranges = [float(np.float32(3 + i % 7)) if i % 10 else float("inf") for i in range(beams)]
    rows = [("/scan", stamp, serialize(scan))]
    for i in range(41):
        at = START + i * SECOND // 20
        rows.append(("/tf", at, recordings.cdr("map", "base", buffer.lookup("map", "base", at), at)))
    rows.append(("/tf_static", START, recordings.cdr("base", "lidar", buffer.lookup("base", "lidar"), START)))
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/scan": (SCAN, "ros2msg", b"", "cdr")})
    expected = []
    for i in range(beams):
        if i % 10:
            angle, at = -1.0 + i * scan.angle_increment, stamp + round(i * scan.time_increment * 1e9)
            point = scan.ranges[i] * np.array([np.cos(angle), np.sin(angle), 0])
            expected.append(buffer.lookup("map", "lidar", at) @ point)
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/scan", "map")
        (cloud,) = clouds
        np.testing.assert_allclose(xyz(cloud.points), np.array(expected), rtol=0, atol=1e-5)  # the message has float32
        assert clouds.points_skipped == {"are out of range": 6}
