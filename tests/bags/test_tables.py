# SPDX-License-Identifier: Apache-2.0
"""Tables of fields and poses: pandas and SciPy give the expected rows, rosbags the expected values."""

import json
import pickle
import re
import sys
import warnings

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from mcap.writer import Writer as McapWriter
from recordings import SECOND, START
from scipy.spatial.transform import Rotation, Slerp

import coframe
from coframe.bags import Column, Table, TableQuery
from coframe.bags.tables._matching import pick
from coframe.cli.app import app
from coframe.messages import serialize
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import Image, Imu, JointState, LaserScan
from std_msgs.msg import Float64, String

pa = pytest.importorskip("pyarrow")
pytest.importorskip("pyarrow.parquet")
pytest.importorskip("pyarrow.feather")
pd = pytest.importorskip("pandas")
MS = SECOND // 1000


def stamped(message, stamp, frame="odom"):
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(int(stamp), SECOND)
    message.header.frame_id = frame
    return message


def odometry(stamp, pose, child="base", covariance=None):
    message = stamped(Odometry(child_frame_id=child), stamp)
    place = message.pose.pose
    place.position.x, place.position.y, place.position.z = map(float, pose.translation)
    q = place.orientation
    q.x, q.y, q.z, q.w = map(float, pose.quaternion)
    if covariance is not None:
        message.pose.covariance = np.asarray(covariance, dtype=float).reshape(-1)
    return message


def write(path, topics, transforms=()):
    """Write a recording: {topic: (type, [(receive time, message), ...])}, and (parent, child, pose, stamp)."""
    with coframe.bags.Writer(path) as writer:
        for topic, (type_, messages) in topics.items():
            number = writer.add_topic(topic, type_)
            for received, message in messages:
                writer.write(number, serialize(message), received=int(received))
        tf = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        still = writer.add_topic("/tf_static", "tf2_msgs/msg/TFMessage")
        for parent, child, pose, stamp in transforms:
            moment = coframe.Buffer(None)
            moment.set(parent, child, pose, stamp or None, static=not stamp)
            writer.write(tf if stamp else still, moment.encode(static=not stamp), received=stamp or START)
    return path


def pose_at(seconds):
    return coframe.Transform.from_rpy([seconds, np.sin(seconds), 0], [0, 0, seconds / 3])


IMAGES = START + np.arange(10) * 100 * MS + 3 * MS
ODOMETRY = START + np.arange(52) * 20 * MS
STATES = START + np.arange(20) * 50 * MS


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """A robot that drives for a second, with a camera, an odometry, joints that take turns, and a battery."""
    topics = {
        "/image": ("sensor_msgs/msg/Image", [(t, stamped(Image(data=b"\x01\x02"), t, "camera")) for t in IMAGES]),
        "/odom": (
            "nav_msgs/msg/Odometry",
            [(t + MS, odometry(t, pose_at((t - START) / SECOND), covariance=np.eye(6) * 0.04)) for t in ODOMETRY],
        ),
        "/joints": (
            "sensor_msgs/msg/JointState",
            [
                (
                    t,
                    stamped(
                        JointState(
                            name=["arm", "wrist"][:: 1 - 2 * (i % 2)] if i % 4 else ["grip"],
                            position=[float(i), -float(i)][:: 1 - 2 * (i % 2)] if i % 4 else [7.0],
                        ),
                        t,
                    ),
                )
                for i, t in enumerate(STATES)
            ],
        ),
        "/battery": ("std_msgs/msg/Float64", [(t, Float64(data=float(i))) for i, t in enumerate(STATES)]),
        "/text": ("std_msgs/msg/String", [(t, String(data=f"line {i}")) for i, t in enumerate(STATES)]),
        "/scan": (
            "sensor_msgs/msg/LaserScan",
            [(t, stamped(LaserScan(ranges=[float(i)] * (1 + i % 3)), t, "lidar")) for i, t in enumerate(STATES)],
        ),
        "/path": ("nav_msgs/msg/Path", [(START, stamped(Path(poses=[stamped(PoseStamped(), START)]), START))]),
        "/silent": ("std_msgs/msg/String", []),
    }
    transforms = [
        ("odom", "base", pose_at((t - START) / SECOND), int(t))
        for t in ODOMETRY
        if not START + 400 * MS < t < START + 700 * MS  # a gap
    ]
    transforms.append(("base", "camera", coframe.Transform([0.5, 0, 1.0]), 0))
    path = write(tmp_path_factory.mktemp("tables") / "run", topics, transforms)
    with coframe.open_bag(path) as recording:
        yield recording


# Which message belongs to a row: pandas.merge_asof decides.


@pytest.mark.parametrize("seed", range(60))
def test_messages_of_rows_equal_those_of_merge_asof(seed):
    rng = np.random.default_rng(seed)
    for _ in range(5):
        samples = np.sort(rng.integers(0, 60, rng.integers(1, 25)))
        times = rng.integers(-10, 70, 30)
        tolerance = [None, 0, 3, 10][rng.integers(4)]
        order = np.argsort(times, kind="stable")
        left = pd.DataFrame({"t": times[order]})
        right = pd.DataFrame({"t": samples, "row": np.arange(len(samples)), "stamp": samples})
        for method, direction in (("previous", "backward"), ("nearest", "nearest"), ("match", "nearest")):
            limit = 0 if method == "match" and tolerance is None else tolerance
            merged = pd.merge_asof(left, right, on="t", direction=direction, tolerance=limit)
            found = pick(samples, times[order], method, tolerance, None)
            assert found.valid.tolist() == merged["row"].notna().tolist()
            known = found.valid
            assert samples[found.first[known]].tolist() == merged["stamp"][known].astype(int).tolist()
            assert (found.age == times[order] - samples[found.first])[known].all()
            if direction == "backward":
                assert found.first[known].tolist() == merged["row"][known].astype(int).tolist()


@pytest.mark.parametrize("seed", range(40))
def test_interpolated_numbers_and_rotations_equal_those_of_scipy(tmp_path, seed):
    rng = np.random.default_rng(seed)
    stamps = START + np.cumsum([5, *rng.integers(1, 60, 11)]) * MS
    numbers = rng.normal(size=(12, 3))
    turns = Rotation.random(12, random_state=seed)
    messages = []
    for stamp, number, turn in zip(stamps, numbers, turns.as_quat(), strict=True):
        message = stamped(Imu(), stamp)
        message.linear_acceleration.x, message.linear_acceleration.y, message.linear_acceleration.z = number
        q = message.orientation
        q.x, q.y, q.z, q.w = turn
        message.orientation_covariance[:] = number[0]
        messages.append((stamp, message))
    shuffled = [messages[i] for i in rng.permutation(12)]
    times = rng.integers(stamps[0] - 20 * MS, stamps[-1] + 20 * MS, 30)
    columns = ["/imu.linear_acceleration", "/imu.orientation", "cov=/imu.orientation_covariance"]
    with coframe.open_bag(
        write(tmp_path / "imu", {"/imu": ("sensor_msgs/msg/Imu", sorted(shuffled, key=lambda _: rng.random()))})
    ) as run:
        table = run.table(columns, at=times, method="interpolate")
        gaps = run.table([*columns, "x=/imu.orientation.x@nearest"], at=times, method="interpolate", max_gap="45ms")
    times = np.sort(times)
    assert table.stamps.tolist() == times.tolist()
    inside = (times >= stamps[0]) & (times <= stamps[-1])
    elapsed, known = (times - START) / SECOND, (stamps - START) / SECOND
    for column, axis in enumerate("xyz"):
        expected = np.where(inside, np.interp(elapsed, known, numbers[:, column]), np.nan)
        np.testing.assert_allclose(table[f"/imu.linear_acceleration.{axis}"], expected, atol=1e-9)
    np.testing.assert_allclose(table["cov"][:, 4][inside], np.interp(elapsed, known, numbers[:, 0])[inside], atol=1e-9)
    found = np.stack([table[f"/imu.orientation.{axis}"] for axis in "xyzw"], axis=1)[inside]
    angles = (Rotation.from_quat(found).inv() * Slerp(known, turns)(elapsed[inside])).magnitude()
    assert angles.max(initial=0) < 1e-6
    assert table["/imu.orientation.valid"].tolist() == inside.tolist()
    after = np.searchsorted(stamps, times)
    around = np.where(inside & ~np.isin(times, stamps), np.diff(stamps, prepend=0, append=0)[np.minimum(after, 12)], 0)
    assert table["cov.gap_ns"].tolist() == around.tolist()
    assert gaps["cov.valid"].tolist() == (inside & (around <= 45 * MS)).tolist()
    assert np.isnan(gaps["cov"][~gaps["cov.valid"]]).all()


def test_the_row_of_a_message_has_its_own_values_even_if_stamps_are_equal(tmp_path):
    messages = [(START + i, stamped(LaserScan(angle_min=float(i)), START + i // 2)) for i in range(6)]
    with coframe.open_bag(write(tmp_path / "run", {"/scan": ("sensor_msgs/msg/LaserScan", messages)})) as run:
        assert run.table("/scan.angle_min", at="/scan")["/scan.angle_min"].tolist() == [0, 1, 2, 3, 4, 5]


# Poses and covariances.


def test_poses_equal_lookups_and_gaps_are_marked(bag):
    table = bag.table([("odom", "camera"), "yaw=odom:camera.yaw"], at="/image", max_gap="100ms")
    expected = bag.buffer.lookup_many("odom", "camera", IMAGES)
    in_gap = (IMAGES > START + 400 * MS) & (IMAGES < START + 700 * MS)
    assert table["odom:camera.valid"].tolist() == (~in_gap).tolist()
    found = np.stack([table[f"odom:camera.{name}"] for name in ("x", "y", "z", "qx", "qy", "qz", "qw")], axis=1)
    np.testing.assert_array_equal(found[~in_gap], np.asarray(expected)[~in_gap])
    assert np.isnan(found[in_gap]).all()
    np.testing.assert_array_equal(table["yaw"][~in_gap], expected.yaw[~in_gap])
    assert table["odom:camera.gap_ns"].tolist() == bag.buffer.validity("odom", "camera", IMAGES).gaps.tolist()


def test_rows_with_gaps_can_be_omitted_or_raise(bag):
    kept = bag.table([("odom", "camera")], at="/image", max_gap="100ms", on_gap="omit")
    assert (len(kept), kept.omitted, kept["odom:camera.valid"].all()) == (7, 3, True)
    with pytest.raises(coframe.ExtrapolationException, match=r"odom:camera has no value at .*\(3 such rows"):
        bag.table([("odom", "camera")], at="/image", max_gap="100ms", on_gap="raise")


def test_an_unusual_gap_is_reported_once(tmp_path):
    stamps = START + np.array([*range(20), *range(120, 140)]) * 20 * MS
    messages = [(t, stamped(LaserScan(), t)) for t in stamps]
    transforms = [("odom", "base", pose_at(0), int(t)) for t in stamps]
    with coframe.open_bag(
        write(tmp_path / "run", {"/scan": ("sensor_msgs/msg/LaserScan", messages)}, transforms)
    ) as run:
        with pytest.warns(coframe.CoframeWarning) as caught:
            run.table([("odom", "base"), "/scan.angle_min", "b=/scan.angle_max@interpolate"], rate=10)
        texts = sorted(str(each.message) for each in caught)
        assert len(texts) == 3
        assert "values of /scan.angle_min come from messages up to" in texts[0]
        assert "poses of 'base' in 'odom' are interpolated over gaps of up to 2.02 s" in texts[1]
        assert "values of b are interpolated over gaps of up to 2.02 s" in texts[2]
        assert len(run.table([("odom", "base")], rate=10, max_gap="100ms", on_gap="omit")) < 20


def test_covariances_of_odometry_are_those_of_lookups(bag):
    table = bag.table([("odom", "camera")], at="/image", covariance=True)
    expected = bag.buffer.lookup_many("odom", "camera", IMAGES, covariance=True).covariance
    np.testing.assert_allclose(table["odom:camera.covariance"].reshape(-1, 6, 6), expected, atol=1e-15)
    assert expected[0, 0, 0] > 0.04
    arrow = table.to_arrow()
    assert arrow["odom:camera"].type.field("covariance").type == pa.list_(pa.float64(), 36)


def test_two_sources_of_covariances_are_an_error(tmp_path):
    messages = [(t, odometry(t, pose_at(0), covariance=np.eye(6))) for t in ODOMETRY]
    topics = dict.fromkeys(("/ekf", "/wheels"), ("nav_msgs/msg/Odometry", messages))
    with coframe.open_bag(
        write(tmp_path / "run", topics, [("odom", "base", pose_at(0), int(t)) for t in ODOMETRY])
    ) as run:
        with pytest.raises(coframe.RecordingError, match="/ekf and /wheels both have covariances of odom -> base"):
            run.table([("odom", "base")], rate=10, covariance=True)
        for message in run.messages("/ekf"):
            run.buffer.set_covariance("odom", "base", message)
        assert run.table([("odom", "base")], rate=10, covariance=True)["odom:base.covariance"][0, 0] == 1


def test_without_covariances_they_are_zero_and_this_is_said(tmp_path):
    run = write(tmp_path / "run", {}, [("odom", "base", pose_at(0), int(t)) for t in ODOMETRY])
    with (
        coframe.open_bag(run) as bag,
        pytest.warns(coframe.CoframeWarning, match="no pose of odom:base has a covariance"),
    ):
        assert not bag.table([("odom", "base")], rate=10, covariance=True)["odom:base.covariance"].any()


# Fields.


def test_elements_are_found_by_their_names(bag):
    table = bag.table(
        ["/joints.position[arm]@previous", "/joints.position[grip]", "all=/joints.position@match"], at="/joints"
    )
    numbers = np.arange(20)
    has_arm = numbers % 4 != 0
    arm = np.where(has_arm, numbers, np.maximum(numbers - 1, 0)).astype(float)
    assert table["/joints.position[arm]"][1:].tolist() == arm[1:].tolist()
    assert not table["/joints.position[arm].valid"][0]
    assert (table["/joints.position[grip]"] == 7).all()
    np.testing.assert_array_equal(table["all[wrist]"], np.where(has_arm, -numbers, np.nan))
    assert [each.name for each in table.to_arrow()["all"].type] == ["[grip]", "[wrist]", "[arm]"]


def test_whole_messages_are_structs_in_arrow_and_flat_in_data_frames(bag):
    table = bag.table(["/odom", "/scan@previous"], at="/image", tolerance="60ms")
    arrow = table.to_arrow()
    assert arrow["/odom"][3].as_py()["pose"]["pose"]["position"]["x"] == table["/odom.pose.pose.position.x"][3]
    assert arrow["/odom"][0].as_py()["header"] == {"stamp_ns": START, "frame_id": "odom"}
    assert arrow["/scan"].type.field("ranges").type == pa.list_(pa.float32())
    frame = table.to_pandas()
    assert frame["/odom.child_frame_id"].tolist() == ["base"] * 10
    assert frame["/odom.pose.covariance[7]"].tolist() == [0.04] * 10
    assert frame["/scan.ranges"][1].tolist() == [2.0] * 3
    assert arrow.num_rows == len(table) == len(frame) == 10
    assert table.to_arrow(flat=True).column_names[:2] == ["stamp_ns", "/odom.header.stamp_ns"]
    assert pa.table(table).num_columns == len(table.names) + 1
    nested = bag.table("/path").to_arrow()["/path"][0].as_py()["poses"]
    assert nested[0]["header"]["stamp"]["sec"] == START // SECOND


@pytest.mark.filterwarnings("ignore:.*the messages have no stamp:coframe.CoframeWarning")
def test_types_of_columns_are_those_of_the_fields(bag):
    table = bag.table(["/image", "/battery.data", "/text"], at="/image")
    frame = table.to_pandas()
    assert frame["/image.height"].dtype == np.uint32
    assert table.to_arrow()["/image"].type.field("data").type == pa.binary()
    assert frame["/image.data"][0] == b"\x01\x02"
    assert frame["/text.data"][0] == "line 0"
    late = bag.table(["/image.height@match:4ms", "/battery.data@match"], at="/odom")
    nullable = late.to_pandas()["/image.height"]
    assert str(nullable.dtype) == "UInt32"
    assert nullable.isna().sum() == 42
    assert late.to_numpy()["/image.height"].mask.sum() == 42
    assert late.to_arrow()["/image.height"].null_count == 42


def test_messages_without_stamps_use_their_receive_times_and_say_so(bag):
    with pytest.warns(coframe.CoframeWarning, match="/battery: the messages have no stamp") as caught:
        assert bag.table("/battery.data", at="/battery")["/battery.data"].tolist() == list(range(20))
    assert len(caught) == 1


def test_a_quaternion_without_a_rotation_is_not_interpolated(tmp_path):
    messages = []
    for i in range(4):
        message = stamped(Imu(), START + i * 10 * MS)
        message.orientation.w = float(i > 1)
        messages.append((START, message))
    with coframe.open_bag(write(tmp_path / "run", {"/imu": ("sensor_msgs/msg/Imu", messages)})) as run:
        table = run.table("/imu.orientation@interpolate", at=START + np.array([0, 5, 15, 25]) * MS)
    # Drivers without an orientation publish zeros.
    np.testing.assert_array_equal(table["/imu.orientation.w"], [0, 0, np.nan, 1])
    assert table["/imu.orientation.valid"].tolist() == [True, True, False, True]


def test_values_of_json_and_protobuf_messages(tmp_path):
    path = tmp_path / "a.mcap"
    with path.open("wb") as stream:
        writer = McapWriter(stream)
        writer.start()
        schema = writer.register_schema("Thing", "jsonschema", b'{"type": "object"}')
        channel = writer.register_channel("/thing", "json", schema)
        for i in range(5):
            value = {"at": {"sec": 3, "nsec": i}, "speed": i / 2, "name": f"n{i}", "parts": [1, 2], "on": i % 2 == 0}
            writer.add_message(channel, START + i, json.dumps(value).encode(), START + i)
        writer.add_message(channel, START + 5, b'{"speed": "fast"}', START + 5)
        writer.finish()
    with coframe.open_bag(path) as run, warnings.catch_warnings():
        warnings.simplefilter("ignore", coframe.CoframeWarning)
        table = run.table("/thing")
        assert table["/thing.at_ns"].tolist()[:2] == [3 * SECOND, 3 * SECOND + 1]
        np.testing.assert_array_equal(table["/thing.speed"], [0, 0.5, 1, 1.5, 2, np.nan])
        assert table["/thing.parts"].tolist()[0] == "[1, 2]"
        assert table.to_pandas()["/thing.on"].isna().tolist() == [False] * 5 + [True]
        assert run.table("/thing.parts[1]")["/thing.parts[1]"].tolist()[0] == 2


def test_every_field_of_real_messages_equals_that_of_rosbags(shared):
    from rosbags.highlevel import AnyReader

    folder = shared / "recordings" / "tb3_gazebo_walker"
    with coframe.open_bag(folder) as ours, AnyReader([folder], default_typestore=recordings.humble) as theirs:
        for topic in ("/odom", "/imu", "/joint_states", "/scan"):
            connections = [each for each in theirs.connections if each.topic == topic]
            messages = [theirs.deserialize(data, each.msgtype) for each, _, data in theirs.messages(connections)]
            table = ours.table(topic, validity=False)
            assert len(table) == len(messages)
            for name in table.names:
                path = name.removeprefix(f"{topic}.").partition("[")[0]
                value = [_at(each, path.removesuffix("_ns")) for each in messages]
                if path.endswith("_ns"):
                    expected = [each.sec * SECOND + each.nanosec for each in value]
                elif "[" in name:
                    index = messages[0].name.index(name.partition("[")[2].removesuffix("]"))
                    expected = [each[index] if len(each) else np.nan for each in value]
                else:
                    expected = value
                for one, other in zip(table[name], expected, strict=True):
                    np.testing.assert_array_equal(one, other)


def _at(value, path):
    for name in path.split("."):
        value = getattr(value, name)
    return value


# Rows.


def test_rows_at_a_rate_lie_where_all_columns_have_values(bag):
    table = bag.table(["/odom.twist.twist.linear.x", ("odom", "camera"), "/scan.angle_min"], rate=50)
    assert (table.stamps[0], table.stamps[-1]) == (START, START + 940 * MS)
    assert set(np.diff(table.stamps)) == {20 * MS}
    part = bag.table(["/odom"], rate=50, start="100ms", stop=START + 300 * MS)
    assert (part.stamps[0], part.stamps[-1]) == (START + 100 * MS, START + 300 * MS)


def test_start_and_stop_choose_rows(bag):
    table = bag.table(["/odom.pose"], at="/image", start=int(IMAGES[2]), stop=int(IMAGES[4]))
    assert table.stamps.tolist() == IMAGES[2:5].tolist()


def test_a_long_table_comes_in_parts_that_are_equal_to_the_whole(bag, monkeypatch):
    query = TableQuery(["/odom.pose", "/joints.position@previous", ("odom", "camera")], at="/odom", covariance=True)
    whole = query.run(bag)
    monkeypatch.setattr("coframe.bags.tables.query.MAX_BATCH_ROWS", 7)
    parts = list(query.batches(bag))
    assert [len(part) for part in parts] == [7] * 7 + [3]
    joined = Table.joined(parts)
    assert joined.names == whole.names
    for name in whole.names:
        np.testing.assert_array_equal(joined[name], whole[name])
    assert {part.to_arrow().schema for part in parts} == {whole.to_arrow().schema}


def test_large_messages_make_parts_with_few_rows(bag, monkeypatch):
    monkeypatch.setattr("coframe.bags.tables.query.MAX_BATCH_BYTES", 200)
    query = TableQuery(["/image.data"], at="/image")
    assert max(len(part) for part in query.batches(bag)) < 5


def test_a_query_can_be_pickled(bag):
    query = TableQuery(
        ["/odom.pose", ("odom", "camera"), Column("/joints.name", "previous", name="names")], at="/image"
    )
    again = pickle.loads(pickle.dumps(query))
    assert again == query
    assert again.run(bag).names == query.run(bag).names


def test_data_frame_of_a_topic(bag):
    frame = bag.dataframe("/odom")
    assert frame.index[1] == pd.Timestamp(int(ODOMETRY[1]))
    assert frame["stamp_ns"].tolist() == ODOMETRY.tolist()
    assert frame["pose.pose.position.x"].tolist() == ((ODOMETRY - START) / SECOND).tolist()
    assert bag.dataframe("odom.twist.twist.linear", start=int(ODOMETRY[50])).columns.tolist() == [
        "stamp_ns",
        "x",
        "y",
        "z",
    ]


def test_polars_and_xarray(bag):
    table = bag.table(["/odom", ("odom", "camera")], at="/image", covariance=True)
    polars = pytest.importorskip("polars")
    assert table.to_polars()["odom:camera.x"].to_list() == table["odom:camera.x"].tolist()
    assert polars.DataFrame(table)["stamp_ns"].to_list() == IMAGES.tolist()
    pytest.importorskip("xarray")
    data = table.to_xarray()
    assert data["odom:camera.covariance"].shape == (10, 36)
    assert data["stamp"].values[0] == IMAGES[0].astype("datetime64[ns]")


def test_missing_packages_are_named(bag, monkeypatch):
    table = bag.table("/odom.child_frame_id")
    for package, convert in (("pyarrow", table.to_arrow), ("pandas", table.to_pandas), ("polars", table.to_polars)):
        with monkeypatch.context() as patch:
            patch.setitem(sys.modules, package, None)
            with pytest.raises(coframe.RecordingError, match=f"needs the package {package}") as caught:
                convert()
        assert caught.value.hint.startswith("pip install ")


# Files and the command.


def test_files_contain_the_values_of_the_table(bag, tmp_path):
    columns = ["/odom", ("odom", "camera"), "/image.data", "/scan.ranges@previous:60ms", "/path.poses"]
    table = bag.table(columns, at="/image", max_gap="100ms")
    frame = table.to_pandas()
    table.save(tmp_path / "a.parquet")
    assert pa.parquet.read_table(tmp_path / "a.parquet").equals(table.to_arrow(flat=True))
    table.save(tmp_path / "a.feather")
    assert pa.feather.read_table(tmp_path / "a.feather").equals(table.to_arrow(flat=True))
    table.save(tmp_path / "a.csv")
    again = pd.read_csv(tmp_path / "a.csv")
    assert again.columns.tolist() == frame.columns.tolist()
    for name in (
        "odom:camera.x",
        "/odom.pose.covariance[0]",
        "odom:camera.valid",
        "/odom.age_ns",
        "/odom.child_frame_id",
    ):
        pd.testing.assert_series_equal(again[name], frame[name], check_dtype=False)
    assert json.loads(again["/scan.ranges"][1]) == [2.0] * 3
    assert again["/image.data"][0] == 102  # the hexadecimal digits 0102
    numbers = bag.table(["/odom", ("odom", "camera")], at="/image")
    numbers.save(tmp_path / "a.npz")
    with np.load(tmp_path / "a.npz") as data:
        assert set(data) == {"stamp_ns", *numbers.names}
        np.testing.assert_array_equal(data["odom:camera.x"], numbers["odom:camera.x"])
        assert data["/odom.child_frame_id"].tolist() == ["base"] * 10
    with pytest.raises(coframe.RecordingError, match=r"npz cannot store /image\.data"):
        table.save(tmp_path / "b.npz")
    with pytest.raises(coframe.RecordingError, match=r"unknown suffix of .*a\.parket") as caught:
        table.save(tmp_path / "a.parket")
    assert "'.parquet'" in caught.value.hint
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a.csv", "a.feather", "a.npz", "a.parquet"]


def test_the_command_writes_the_same_table(bag, tmp_path, monkeypatch):
    monkeypatch.setattr("coframe.bags.tables.query.MAX_BATCH_ROWS", 4)
    columns = ["speed=/odom.twist@interpolate", "odom:camera"]
    options = ["--at", "/image", "--max-gap", "100ms", "--on-gap", "omit", "--covariance"]
    words = ["table", str(bag.path), *columns, *options, "-o", str(tmp_path / "a.parquet")]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    assert result.stderr == "coframe: 3 rows without a value omitted\n"
    assert "a.parquet: 7 rows" in result.stdout
    expected = bag.table(columns, at="/image", max_gap="100ms", on_gap="omit", covariance=True)
    assert pa.parquet.read_table(tmp_path / "a.parquet").equals(expected.to_arrow(flat=True))
    printed = CliRunner().invoke(app, ["table", str(bag.path), "odom:camera.yaw", "--rate", "10", "--no-validity"])
    assert printed.stdout.splitlines()[0] == "stamp_ns,odom:camera.yaw"
    assert len(printed.stdout.splitlines()) == 12


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (["/odm"], 1, "Did you mean '/odom'?"),
        (["/odom.pse"], 1, "Did you mean 'pose'?"),
        (["/odom@nerest"], 2, "Did you mean 'nearest'?"),
        (["odom:camra", "--rate", "1"], 1, "Did you mean 'camera'?"),
        (["/odom", "-o", "a.parket"], 2, "unknown suffix"),
        (["/odom", "-f", "parquet"], 2, "cannot be printed"),
        (["/silent"], 1, "/silent has no messages"),
        (["/odom", "--start", "soon"], 2, "--start: 'soon' is not a point in time"),
        (["odom:camera", "--at", "/image", "--max-gap", "100ms", "--on-gap", "raise"], 1, "has no value at"),
    ],
)
def test_the_command_ends_with_a_sentence(bag, words, code, text):
    result = CliRunner().invoke(app, ["table", str(bag.path), *words])
    assert (result.exit_code, text in result.stderr) == (code, True), result.stderr
    assert "Traceback" not in result.stderr


def test_nothing_is_left_of_a_table_that_fails(bag, tmp_path):
    target = tmp_path / "a.csv"
    target.write_text("before")
    result = CliRunner().invoke(app, ["table", str(bag.path), "/scan@match:1ms", "--at", "/image", "-o", str(target)])
    assert result.exit_code == 1
    assert target.read_text() == "before"
    assert list(tmp_path.iterdir()) == [target]


# Requests that cannot be answered.

WRONG = {
    "topic": (["/odm.pose"], {}, "no topic '/odm'", "'/odom'"),
    "field": (["/odom.pse"], {}, "/odom has no field 'pse'", "'pose'"),
    "field in a field": (["/odom.pose.pose.positon.x"], {}, "/odom.pose.pose has no field 'positon'", "'position'"),
    "field of a number": (["/odom.pose.pose.position.x.y"], {}, "has no field 'y'", "It has no fields"),
    "field of a sequence": (["/path.poses.pose"], {}, "/path.poses is a sequence", r"/path.poses\[0\].pose"),
    "element of a number": (["/battery.data[0]"], {}, "/battery.data is not a sequence", ""),
    "element that never exists": (["/scan.ranges[99]"], {}, "no message has this element", ""),
    "name of an element": (["/joints.position[arn]"], {}, "no message has this element", "'arm'"),
    "name without names": (["/scan.ranges[front]"], {}, "the elements of /scan.ranges have no names", "an index"),
    "frame": ([("odom", "camra")], {"at": "/image"}, "camra", "'camera'"),
    "frame in text": (["odom:camra.yaw"], {"at": "/image"}, "camra", "'camera'"),
    "string to interpolate": (
        ["/odom.child_frame_id@interpolate"],
        {},
        "is a string, which cannot be interp",
        "@nearest",
    ),
    "message with a string": (
        ["/odom"],
        {"method": "interpolate"},
        "/odom.header.frame_id is a string",
        "Choose a field",
    ),
    "bytes to interpolate": (["/image.data@interpolate"], {}, "is a block of bytes", ""),
    "messages to interpolate": (["/path.poses@interpolate"], {}, "is a sequence of messages", ""),
    "topic without messages": (["/silent"], {}, "/silent has no messages", ""),
    "rows at a topic without messages": (["/odom"], {"at": "/silent"}, "/silent has no messages", ""),
    "rows at an unknown topic": (["/odom"], {"at": "/imag"}, "no topic '/imag'", "'/image'"),
    "no rows": (["/odom", "/scan"], {}, "the columns come from /odom, /scan", "at="),
    "poses without rows": ([("odom", "camera")], {}, "poses have no stamps", "rate="),
    "method": (["/odom@nerest"], {}, "no method named 'nerest'", "'nearest'"),
    "method of the table": (["/odom"], {"method": "nerest"}, "no method named 'nerest'", "'nearest'"),
    "tolerance": (["/odom@nearest:-5ms"], {}, "/odom@nearest:-5ms", "@nearest:20ms"),
    "tolerance of a pose": ([Column("odom:camera", name="p")], {"at": "/image", "tolerance": -1}, "tolerance", ""),
    "neither topic nor frames": (["odom.pose"], {}, "neither two frames nor a topic", "Examples"),
    "no columns": ([], {}, "at least one column", ""),
    "not a column": ([3], {}, "3 is not a column", "Examples"),
    "two times": (["/odom"], {"at": "/odom", "rate": 5}, "mutually exclusive", ""),
    "rate": (["/odom"], {"rate": -1}, "rate must be above 0", ""),
    "same name": (["/odom.pose", "/odom.pose"], {}, "two columns of the table are named '/odom.pose", "name="),
    "no value": (["/scan@match:1ms"], {"at": "/image"}, "/scan has no value at any row", "tolerance"),
    "other clock": (["/odom.pose@previous"], {"at": np.array([5, 6])}, "/odom.pose has no value at any row", "clocks"),
    "no rows in the interval": (["/odom"], {"start": "1h"}, "no rows between start and stop", "are from"),
    "not a time": (["/odom"], {"start": "soon"}, "'soon' is not a point in time", ""),
    "gap": ([("odom", "camera")], {"at": "/image", "max_gap": "-1ms"}, "-1ms", ""),
    "brackets": (["/scan.ranges[0"], {}, "not valid at", "Examples"),
    "dot": (["/scan."], {}, "ends with a dot", ""),
}


@pytest.mark.parametrize("case", WRONG)
@pytest.mark.filterwarnings("ignore::coframe.CoframeWarning")
def test_what_cannot_be_answered_is_one_sentence_with_what_exists(bag, case):
    columns, options, text, hint = WRONG[case]
    with pytest.raises((coframe.RecordingError, coframe.TransformException, ValueError), match=text) as caught:
        bag.table(columns, **options)
    assert "\n" not in str(caught.value)
    if hint:
        assert re.search(hint, caught.value.hint)


def test_a_type_without_definition_is_an_error(tmp_path):
    path = recordings.write_mcap(
        tmp_path / "a.mcap",
        rows=[("/x", START, b"\0\1\0\0abcd")],
        types={"/x": ("their_msgs/msg/X", "ros2msg", b"", "cdr")},
    )
    with coframe.open_bag(path) as run, pytest.raises(coframe.RecordingError, match="definition of the messages on /x"):
        run.table("/x.field")


def test_damaged_messages_are_counted_and_their_values_are_missing(tmp_path):
    good = serialize(stamped(LaserScan(angle_min=1.0), START + 1))
    rows = [("/scan", START + i, good if i != 2 else good[:30]) for i in range(5)]
    path = recordings.write_mcap(
        tmp_path / "a.mcap", rows=rows, types={"/scan": ("sensor_msgs/msg/LaserScan", "ros2msg", b"", "cdr")}
    )
    with coframe.open_bag(path) as run, pytest.warns(coframe.CoframeWarning, match="1 message cannot be decoded"):
        values = run.table("/scan.angle_min")["/scan.angle_min"]
    assert np.isnan(values).sum() == 1
