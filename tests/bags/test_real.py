# SPDX-License-Identifier: Apache-2.0
"""Real recordings with their peculiarities, compared with `rosbags`."""

import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

import coframe
from coframe.robots import parse_urdf
from coframe.robots.publishing import StatePublisher

SECOND = 1_000_000_000


@pytest.fixture(scope="module")
def folder(shared):
    folder = shared / "recordings"
    if not folder.is_dir():
        pytest.skip("no folder shared/recordings")
    return folder


def assert_close(ours, theirs, tolerance):
    """Compare poses (..., 7): a quaternion and its negative are the same rotation, and tf2 normalizes them."""
    theirs = theirs.copy()
    theirs[..., 3:] /= np.linalg.norm(theirs[..., 3:], axis=-1, keepdims=True)
    theirs[..., 3:] *= np.sign((ours[..., 3:] * theirs[..., 3:]).sum(axis=-1, keepdims=True))
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=tolerance)


def by_rosbags(path):
    """Yield (topic, received, [(parent, child, stamp, seven numbers)]) of each message with transforms."""
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        connections = [c for c in reader.connections if c.msgtype in {"tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"}]
        for connection, received, data in reader.messages(connections):
            transforms = []
            for t in reader.deserialize(data, connection.msgtype).transforms:
                stamp = t.header.stamp.sec * SECOND + t.header.stamp.nanosec
                p, q = t.transform.translation, t.transform.rotation
                values = (p.x, p.y, p.z, q.x, q.y, q.z, q.w)
                transforms.append((t.header.frame_id.lstrip("/"), t.child_frame_id.lstrip("/"), stamp, values))
            yield connection.topic, received, transforms


@pytest.mark.parametrize(
    "name",
    [
        "turtlesim_tf_demo.bag",
        "turtlesim_tf_demo_lz4.bag",
        "turtlesim_tf_demo_bz2.bag",
        "tilt_laser.bag",
        "tb3_gazebo_walker",
        "epuck_webots",
        "tb3_tf_missing_static",
        "world_talk_1hz",
    ],
)
def test_every_transform_is_in_the_buffer(folder, name):
    with coframe.open_bag(folder / name) as recording:
        statics, moving, last = {}, {}, {}
        for topic, received, transforms in by_rosbags(folder / name):
            last[topic] = received
            for parent, child, stamp, values in transforms:
                if topic == "/tf_static":
                    statics[parent, child] = values
                else:
                    moving.setdefault((parent, child), {})[stamp] = values  # the last transform with a stamp is valid
        for (parent, child), values in statics.items():
            found = recording.buffer.lookup(parent, child)
            assert_close(np.array([*found.translation, *found.quaternion]), np.array(values), 1e-12)
        for (parent, child), samples in moving.items():
            stamps = np.array(list(samples))
            found = recording.buffer.lookup_many(parent, child, stamps)
            ours = np.concatenate([found.translation, found.quaternion], axis=1)
            assert_close(ours, np.array(list(samples.values())), 1e-12)
        assert {edge.child for edge in recording.buffer.edges() if edge.parent} == {
            child for _, child in [*statics, *moving]
        }
        for topic, received in last.items():
            assert list(recording.messages(topic))[-1].received == received


def test_compressed_bags_of_ros_1_have_the_same_transforms(folder):
    plain, *packed = (coframe.open_bag(folder / f"turtlesim_tf_demo{kind}.bag") for kind in ("", "_lz4", "_bz2"))
    assert (plain.topics["/tf"].messages, plain.topics["/tf_static"].messages) == (2688, 1)
    assert plain.topics["/tf"].type == "tf/msg/tfMessage"
    assert plain.duration == pytest.approx(21.7 * SECOND, rel=0.01)
    for other in packed:
        assert other.topics == plain.topics
        stamps = plain.stamps("/turtle1/pose")
        assert (other.stamps("/turtle1/pose") == stamps).all()
        inside = np.linspace(*plain.buffer.span("turtle2", "carrot"), 50)[1:-1].astype(np.int64)
        assert other.buffer.lookup_many("turtle2", "carrot", inside) == plain.buffer.lookup_many(
            "turtle2", "carrot", inside
        )


def test_tilt_laser(folder):
    """A recording of hardware, with leading slashes, unknown types and one sensor without a transform."""
    with coframe.open_bag(folder / "tilt_laser.bag") as recording:
        assert recording.problems == ["/tf: frame names begin with '/'; the slash is removed, as in tf2"]
        counts = {name: recording.topics[name].messages for name in ("/scan", "/imu_data", "/position_gps", "/tf")}
        assert counts == {"/scan": 178, "/imu_data": 356, "/position_gps": 356, "/tf": 711}
        scan = next(recording.messages("/scan")).message
        assert type(scan).__module__ == "sensor_msgs.msg"
        assert recording.buffer.lookup("tilt_base", scan.header.frame_id.lstrip("/"), recording.span[0] + SECOND)
        (temperature, *_) = recording.messages("/temperature")
        assert type(temperature.message).__name__.endswith("Thermistor")  # defined in the bag
        assert "base_imu" not in recording.buffer


def test_forward_kinematics_match_robot_state_publisher(folder):
    """The recording contains its description, its joint states and its transforms."""
    with coframe.open_bag(folder / "tb3_gazebo_walker") as recording:
        robot = parse_urdf(next(recording.messages("/robot_description")).message.data)
        states = {message.stamp: message.message for message in recording.messages("/joint_states")}
        by_child = {joint.child: joint for joint in robot.joints.values()}
        compared = 0
        for message in recording.messages("/tf"):
            for sent in message.message.transforms:
                stamp = sent.header.stamp.sec * SECOND + sent.header.stamp.nanosec
                if sent.child_frame_id not in by_child:
                    continue  # odom's
                state = states[stamp]
                ours = robot.joint_transforms(dict(zip(state.name, state.position, strict=True)))
                transform = ours[by_child[sent.child_frame_id].name]
                p, q = sent.transform.translation, sent.transform.rotation
                assert (transform.target, transform.source) == (sent.header.frame_id, sent.child_frame_id)
                assert_close(np.array(transform.values), np.array([p.x, p.y, p.z, q.x, q.y, q.z, q.w]), 1e-12)
                compared += 1
        fixed = [edge for edge in recording.buffer.edges() if edge.static]
        for edge in fixed:
            sent = np.array(recording.buffer.lookup(edge.parent, edge.child).values)
            ours = robot.joint_transforms()[by_child[edge.child].name]
            assert ours.target == edge.parent
            assert_close(np.array(ours.values), sent, 1e-12)
        assert compared + len(fixed) == 768
        # Simulated stamps, received on the system clock.
        assert recording.start < 60 * SECOND < recording.received_start
        assert recording.span == (recording.start, recording.end)
        assert recording.buffer.lookup("odom", "base_footprint", recording.start + 10 * SECOND)


def test_epuck(folder):
    """The recording has an empty message, old static transforms, duplicate stamps and an empty description."""
    with coframe.open_bag(folder / "epuck_webots") as recording:
        assert len(recording.buffer.frames()) == 64
        assert recording.span == (280_000_000, 16_160_000_000)
        assert recording.buffer.lookup("odom", "cap screw(0)", recording.span[1])
        assert any(not message.message.transforms for message in recording.messages("/tf_static"))
        empty, described = (message.message.data for message in recording.messages("/robot_description"))
        (warning,) = parse_urdf(empty).warnings
        assert warning == "line 1: the name '' of a link is empty, or begins or ends with a space"
        robot = parse_urdf(described)
        stamps = recording.stamps("/joint_states")
        assert len(stamps) - len(np.unique(stamps)) == 184
        # The same comparison for stamps that occur once: a joint state has priority over a mimicked value.
        unique, counts = np.unique(stamps, return_counts=True)
        once = set(unique[counts == 1].tolist())
        states = {m.stamp: m.message for m in recording.messages("/joint_states") if m.stamp in once}
        by_child = {joint.child: joint for joint in robot.joints.values()}
        compared = 0
        for message in recording.messages("/tf"):
            for sent in message.message.transforms:
                state = states.get(sent.header.stamp.sec * SECOND + sent.header.stamp.nanosec)
                joint = by_child.get(sent.child_frame_id)
                if state is None or joint is None or joint.name not in state.name:
                    continue
                known = {n: p for n, p in zip(state.name, state.position, strict=True) if n in robot.joints}
                p, q = sent.transform.translation, sent.transform.rotation
                ours = robot.joint_transforms(known)[joint.name].values
                assert_close(np.array(ours), np.array([p.x, p.y, p.z, q.x, q.y, q.z, q.w]), 1e-12)
                compared += 1
        assert compared > 100


def test_the_core_of_robot_state_publisher_handles_duplicate_stamps(folder):
    """For a stamp that occurs twice with different values, either of the two is accepted."""
    with coframe.open_bag(folder / "epuck_webots") as recording:
        described = list(recording.messages("/robot_description"))[-1].message.data
        publisher = StatePublisher(parse_urdf(described), ignore_stamps=True)
        sent_by_us: dict[tuple[int, str], list[np.ndarray]] = {}
        for state in recording.messages("/joint_states"):
            message = state.message
            for transform in publisher.moving(state.stamp, message.name, message.position):
                sent_by_us.setdefault((state.stamp, transform.source), []).append(np.array(transform.values))
        compared = doubled = 0
        for message in recording.messages("/tf"):
            for sent in message.message.transforms:
                stamp = sent.header.stamp.sec * SECOND + sent.header.stamp.nanosec
                candidates = sent_by_us.get((stamp, sent.child_frame_id), [])
                if not candidates:
                    continue  # of odom, or of a state that was not recorded
                p, q = sent.transform.translation, sent.transform.rotation
                values = np.array([p.x, p.y, p.z, q.x, q.y, q.z, q.w])
                opposite = values * [1, 1, 1, -1, -1, -1, -1]  # the same rotation
                apart = [np.abs(each - one).max() for each in candidates for one in (values, opposite)]
                assert min(apart) < 1e-12
                compared += 1
                doubled += len(candidates) > 1
        assert compared == 494
        assert doubled > 100


def test_missing_statics_are_two_trees(folder):
    with coframe.open_bag(folder / "tb3_tf_missing_static") as recording:
        with pytest.raises(coframe.ConnectivityException) as caught:
            recording.buffer.lookup("odom", "base_link")
        assert "'odom' with base_footprint" in caught.value.hint
        assert "wheel_left_link" in caught.value.hint


def test_renamed_files_are_read_and_reported(folder):
    with coframe.open_bag(folder / "broken" / "db3_renamed_metadata_stale") as recording:
        assert recording.problems == [
            "metadata.yaml lists rosbag2_2023_11_29-19_52_49_0.db3, which does not exist",
            "metadata.yaml does not list rosbag2.db3; it was read as well",
        ]
        assert recording.topics["/tf"].messages == 60
        whole = coframe.open_bag(folder / "world_talk_1hz")
        assert recording.buffer.lookup("world", "talk") == whole.buffer.lookup("world", "talk")


def test_a_constant_transform_on_tf(folder):
    """It has samples, a span and a rate, and the same value at all times."""
    with coframe.open_bag(folder / "world_talk_1hz") as recording:
        (edge,) = [edge for edge in recording.buffer.edges() if edge.parent]
        assert (edge.parent, edge.child, edge.static, edge.samples) == ("world", "talk", False, 60)
        assert edge.rate == pytest.approx(1.0, abs=0.01)
        poses = recording.buffer.trajectory("world", "talk")
        assert len({tuple(row) for row in poses.matrix.reshape(-1, 16)}) == 1
        with pytest.raises(coframe.ExtrapolationException):
            recording.buffer.lookup("world", "talk", edge.newest + 1)


def test_static_transforms_with_old_or_zero_stamps_are_valid_at_all_times(folder):
    with coframe.open_bag(folder / "epuck_webots") as recording:
        statics = [transform for m in recording.messages("/tf_static") for transform in m.message.transforms]
        footprints = [s for s in statics if (s.header.frame_id, s.child_frame_id) == ("base_link", "base_footprint")]
        assert len(footprints) == 3
        assert any((s.header.stamp.sec, s.header.stamp.nanosec) == (0, 0) for s in statics)
        for stamp in recording.span:
            assert recording.buffer.lookup("base_link", "base_footprint", stamp)
        moving = [
            (transform.child_frame_id, transform.header.stamp.sec, transform.header.stamp.nanosec)
            for message in recording.messages("/tf")
            for transform in message.message.transforms
        ]
        assert len(moving) - len(set(moving)) == sum(edge.repeated for edge in recording.buffer.edges()) + sum(
            edge.samples - len(np.unique(recording.buffer.trajectory(edge.parent, edge.child).stamps))
            for edge in recording.buffer.edges()
            if edge.parent and not edge.static
        )


@pytest.mark.parametrize(
    ("name", "topic", "frame", "messages", "reason"),
    [
        ("tb3_gazebo_walker", "/scan", "odom", 99, None),
        ("tilt_laser.bag", "/scan", "tilt_base", 177, "ExtrapolationException"),
        ("epuck_webots", "/scan", "odom", None, None),
    ],
)
def test_scans_in_a_fixed_frame(folder, name, topic, frame, messages, reason):
    """Each scan is either among the clouds or counted as skipped."""
    with coframe.open_bag(folder / name) as recording:
        clouds = coframe.bags.Clouds(recording, topic, frame)
        given = sum(1 for _ in clouds)
        assert given + sum(clouds.skipped.values()) == recording.topics[topic].messages
        assert messages in {None, given}
        assert reason is None or next(iter(clouds.skipped)).startswith(reason)
        assert clouds.points > 100


@pytest.mark.parametrize("name", ["turtlesim_tf_demo.bag", "tilt_laser.bag", "tb3_gazebo_walker", "epuck_webots"])
def test_a_frozen_buffer_gives_the_same_lookups(folder, tmp_path, name):
    with coframe.open_bag(folder / name) as recording:
        recording.buffer.save(tmp_path / "run.cfz")
        frozen = coframe.load(tmp_path / "run.cfz", verify=True)
        assert frozen.edges(now=0) == recording.buffer.edges(now=0)
        for edge in frozen.edges():
            if edge.parent:
                expected = recording.buffer.trajectory(edge.parent, edge.child)
                assert frozen.trajectory(edge.parent, edge.child) == expected
