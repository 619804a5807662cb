# SPDX-License-Identifier: Apache-2.0
"""Transforms from messages and to messages: classes of coframe, of another ROS, and of libraries for recordings."""

from dataclasses import dataclass, field, make_dataclass

import numpy as np
import pytest

from coframe import Transform
from coframe.errors import FrameMismatchException, InvalidArgumentException
from geometry_msgs.msg import (
    Point,
    Pose,
    PoseArray,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    TransformStamped,
    TwistStamped,
)
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from tf2_msgs.msg import TFMessage
from vision_msgs.msg import BoundingBox3D, Detection3D
from visualization_msgs.msg import InteractiveMarker, Marker

YAW = 0.5
POSE = Transform.from_rpy([1.0, 2.0, 3.0], yaw=YAW)
STAMP = 5_000_000_007


def set_header(header, frame="map", stamp=STAMP):
    header.frame_id = frame
    header.stamp.sec, header.stamp.nanosec = divmod(stamp, 1_000_000_000)


def pose_message():
    return POSE.to_msg(Pose)


def stamped(cls, frame="map", stamp=STAMP):
    message = POSE.to_msg(cls)
    set_header(message.header, frame, stamp)
    return message


MESSAGES = [
    (pose_message(), (None, None, None)),
    (POSE.to_msg(PoseWithCovariance), (None, None, None)),
    (stamped(PoseStamped), ("map", None, STAMP)),
    (stamped(PoseWithCovarianceStamped), ("map", None, STAMP)),
    (POSE.replace(source="base").to_msg(TransformStamped, "map", STAMP), ("map", "base", STAMP)),
    (POSE.replace(source="base").to_msg(Odometry, "map", STAMP), ("map", "base", STAMP)),
    (stamped(Marker), ("map", None, STAMP)),
    (stamped(OccupancyGrid), ("map", None, STAMP)),  # info.origin
    (stamped(InteractiveMarker), ("map", None, STAMP)),
    (POSE.to_msg(BoundingBox3D), (None, None, None)),  # center
]


@pytest.mark.parametrize(("message", "expected"), MESSAGES, ids=lambda m: type(m).__name__)
def test_every_message_with_a_pose_is_a_transform(message, expected):
    found = Transform(message)
    assert found.is_close(POSE)
    assert (found.target, found.source, found.stamp) == expected
    named = Transform(message, target="world", source="tool", stamp=3)
    assert (named.target, named.source, named.stamp) == ("world", "tool", 3)


def test_messages_round_trip():
    for message, _ in MESSAGES:
        assert Transform(message).to_msg(type(message)) == message


def test_lists_of_poses_are_batches():
    path = Path(poses=[stamped(PoseStamped, stamp=second) for second in (1, 2, 3)])
    set_header(path.header)
    found = Transform(path)
    assert (found.shape, found.target, found.stamps.tolist()) == ((3,), "map", [1, 2, 3])
    array = PoseArray(poses=[pose_message()] * 2)
    set_header(array.header, "odom")
    assert (Transform(array).shape, Transform(array).stamps.tolist()) == ((2,), [STAMP, STAMP])
    assert Transform(Path()).shape == (0,)


def test_transforms_of_one_edge_are_a_batch_and_others_are_refused():
    edge = lambda child: POSE.replace(source=child).to_msg(TransformStamped, "map", STAMP)  # noqa: E731
    assert Transform(TFMessage(transforms=[edge("a"), edge("a")])).source == "a"
    with pytest.raises(FrameMismatchException, match="contains poses of several frames: a, b"):
        Transform(TFMessage(transforms=[edge("a"), edge("b")]))


def test_batches_fill_lists():
    batch = Transform.stack([POSE, POSE.inverse()]).replace(target="map", stamp=[1, 2_000_000_003])
    path = batch.to_msg(Path)
    assert [each.header.stamp.nanosec for each in path.poses] == [1, 3]
    assert {each.header.frame_id for each in (path, *path.poses)} == {"map"}
    assert Transform(path) == batch
    assert len(batch.to_msg(PoseArray, "odom", 5).poses) == 2
    with pytest.raises(ValueError, match="PoseStamped cannot contain a batch"):
        batch.to_msg(PoseStamped)


def test_covariances_come_along():
    covariance = np.diag([1.0, 2, 3, 4, 5, 6])
    message = POSE.with_covariance(covariance).to_msg(PoseWithCovarianceStamped, "map", 1)
    assert message.pose.covariance.reshape(6, 6).tolist() == covariance.tolist()
    assert Transform(message).covariance.tolist() == covariance.tolist()
    assert Transform(PoseWithCovarianceStamped()).covariance is None  # all zeros: unknown
    message.pose.covariance[0] = -1.0
    with pytest.raises(InvalidArgumentException, match="must not have negative eigenvalues"):
        Transform(message)


def test_a_transform_moves_messages():
    turn = Transform.from_rpy([0, 0, 1.0], yaw=np.pi / 2, target="map", source="base")
    goal = Transform([1.0, 0, 0]).to_msg(PoseStamped, "base", STAMP)
    moved = turn @ goal
    assert type(moved) is PoseStamped
    assert moved.header.frame_id == "map"
    assert (moved.header.stamp.sec, moved.header.stamp.nanosec) == divmod(STAMP, 1_000_000_000)
    assert Transform(moved).is_close(turn @ Transform([1.0, 0, 0]))
    assert Transform(goal).translation.tolist() == [1.0, 0.0, 0.0]  # the given message did not change
    path = Transform(np.eye(3)).to_msg(Path, "base", 1)
    assert {pose.header.frame_id for pose in (turn @ path).poses} == {"map"}
    with pytest.raises(FrameMismatchException, match=r"cannot transform geometry_msgs/PoseStamped in 'odom' with map"):
        turn @ Transform().to_msg(PoseStamped, "odom")
    with pytest.raises(ValueError, match="batch @ PoseStamped"):
        Transform(np.zeros((2, 3))) @ goal


def test_a_transform_turns_covariances_of_messages():
    turn = Transform.from_rpy(yaw=np.pi / 2, target="map", source="base")
    given = Transform([1.0, 0, 0], covariance=np.diag([1.0, 2, 3, 4, 5, 6])).to_msg(PoseWithCovarianceStamped, "base")
    moved = turn @ given
    np.testing.assert_allclose(np.diag(moved.pose.covariance.reshape(6, 6)), [2, 1, 3, 5, 4, 6], atol=1e-12)


def test_messages_without_one_pose_are_refused():
    with pytest.raises(ValueError, match="geometry_msgs/TwistStamped contains no pose"):
        Transform(TwistStamped())
    with pytest.raises(ValueError, match="geometry_msgs/Quaternion contains no pose"):
        Transform(Quaternion())
    with pytest.raises(TypeError, match=r"to_msg\(\) takes a message class, such as geometry_msgs.msg.PoseStamped"):
        POSE.to_msg("geometry_msgs/msg/PoseStamped")
    assert Transform(Detection3D()).is_close(Transform())  # bbox.center is nearer than results[].pose.pose


def test_several_poses_at_one_level_are_named():
    @dataclass
    class Pair:
        first: object = field(default_factory=pose_message)
        second: object = field(default_factory=pose_message)

    with pytest.raises(ValueError, match=r"contains several poses: first, second. Pass one of them: message.first"):
        Transform(Pair())


def test_classes_of_other_libraries_are_read_by_their_fields():
    numbers = lambda name, axes: make_dataclass(name, [(axis, float) for axis in axes])  # noqa: E731
    point, quaternion = numbers("Point", "xyz"), numbers("Quaternion", "xyzw")
    pose = make_dataclass("Pose", ["position", "orientation"])
    message = pose(point(1.0, 2.0, 3.0), quaternion(*POSE.quaternion))
    assert Transform(message).is_close(POSE)
    assert Transform(make_dataclass("Stamped", ["pose"])(message)).is_close(POSE)


def test_points_are_not_poses():
    assert Transform([1.0, 0, 0]).transform_point(Point(x=1.0)).tolist() == [2.0, 0.0, 0.0]


def test_messages_of_recordings_are_read(tmp_path):
    import coframe
    from coframe.messages.codec import serialize

    covariance = np.eye(6)
    path = tmp_path / "drive.mcap"
    with coframe.bags.Writer(path) as writer:
        odometry = writer.add_topic("/odom", "nav_msgs/msg/Odometry")
        moving = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for second in (1, 2):
            pose = Transform([float(second), 0, 0], target="odom", source="base", stamp=second * 1_000_000_000)
            writer.write(odometry, serialize(pose.with_covariance(covariance).to_msg(Odometry)), second * 1_000_000_000)
            edge = TFMessage(transforms=[pose.to_msg(TransformStamped)])
            writer.write(moving, serialize(edge), second * 1_000_000_000)
    bag = coframe.open_bag(path)
    for message in bag.messages("/odom"):
        assert Transform(message).x == message.message.pose.pose.position.x
        bag.buffer.set_covariance("odom", "base", message)
    found = bag.buffer.lookup("odom", "base", 1_500_000_000, covariance=True)
    assert (found.x, found.covariance[0, 0]) == (1.5, 1.0)
