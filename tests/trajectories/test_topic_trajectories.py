# SPDX-License-Identifier: Apache-2.0
"""Trajectories from topics, in Python and wherever a command accepts a trajectory."""

import numpy as np
import pytest
from click.testing import CliRunner

import coframe
from coframe.bags import Column
from coframe.cli.app import app
from coframe.messages import serialize
from coframe.trajectories import read_trajectory, write_trajectory
from geometry_msgs.msg import Pose, PoseArray, PoseStamped, PoseWithCovarianceStamped, TransformStamped, TwistStamped
from nav_msgs.msg import Odometry, Path
from tf2_msgs.msg import TFMessage

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
COUNT = 30
STAMPS = START + np.arange(COUNT) * SECOND // 20
TRUTH = coframe.Transform.from_rpy(
    np.stack([np.arange(COUNT) / 10, np.sin(np.arange(COUNT) / 5), np.zeros(COUNT)], axis=1),
    np.stack([np.zeros(COUNT), 0.01 * np.arange(COUNT), np.arange(COUNT) / 20], axis=1),
)


def stamped(cls, i, frame="odom"):
    pose = TRUTH[i].replace(target=frame, source="base", stamp=int(STAMPS[i]))
    return pose.to_msg(cls, frame, int(STAMPS[i]))


def path_of(count, same_stamp=False):
    path = Path(poses=[stamped(PoseStamped, i) for i in range(count)])
    path.header.frame_id = "odom"
    for pose in path.poses if same_stamp else []:
        pose.header.stamp = path.poses[0].header.stamp
    return path


TOPICS = {
    "/odometry": [stamped(Odometry, i) for i in range(COUNT)],
    "/pose": [stamped(PoseStamped, i) for i in range(COUNT)],
    "/amcl": [stamped(PoseWithCovarianceStamped, i) for i in range(COUNT)],
    "/transform": [stamped(TransformStamped, i) for i in range(COUNT)],
    "/bare": [stamped(Pose, i) for i in range(COUNT)],
    "/path": [path_of(2), path_of(COUNT)],
    "/plan": [path_of(COUNT, same_stamp=True)],
    "/particles": [PoseArray(poses=[Pose(), Pose()])],
    "/moved": [stamped(PoseStamped, i, frame="odom" if i else "map") for i in range(COUNT)],
    "/invalid": [PoseStamped() if i == 3 else stamped(PoseStamped, i) for i in range(COUNT)],
    "/twist": [TwistStamped()],
    "/tree": [TFMessage(transforms=[stamped(TransformStamped, 0)])],
    "/silent": [],
}
TYPES = {"/silent": "nav_msgs/msg/Odometry"}
# coframe's classes have w = 1 by default; drivers may publish zeros.
TOPICS["/invalid"][3].pose.orientation.w = 0.0
TOPICS["/invalid"][3].header.frame_id = "odom"
TOPICS["/amcl"][0].pose.covariance[0] = 0.25


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("topics") / "run"
    with coframe.bags.Writer(path) as writer:
        for topic, messages in TOPICS.items():
            number = writer.add_topic(topic, TYPES.get(topic) or type(messages[0]).ROS_TYPE)
            for i, message in enumerate(messages):
                writer.write(number, serialize(message), received=int(STAMPS[i]))
    with coframe.open_bag(path) as recording:
        yield recording


def run(*arguments):
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout, result.stderr


@pytest.mark.parametrize("topic", ["/odometry", "/pose", "/amcl", "/transform", "/path", "pose"])
def test_poses_of_each_type_of_message(bag, topic):
    poses = bag.trajectory(topic if topic.startswith("/") else f"/{topic}.pose")
    np.testing.assert_allclose(poses.matrix, TRUTH.matrix, atol=1e-15)
    assert poses.stamps.tolist() == STAMPS.tolist()
    if topic != "pose":
        assert poses.target == "odom"
    assert poses.source == ("base" if topic in {"/odometry", "/transform"} else None)


def test_covariances_come_with_the_poses(bag):
    assert bag.trajectory("/amcl").covariance[0, 0, 0] == 0.25
    assert bag.trajectory("/odometry").covariance is None


def test_poses_without_stamps_have_their_receive_times(bag):
    with pytest.warns(coframe.CoframeWarning, match="/bare: the messages have no stamp"):
        assert bag.trajectory("/bare").stamps.tolist() == STAMPS.tolist()


def test_poses_that_are_not_valid_are_skipped(bag):
    with pytest.warns(coframe.CoframeWarning, match="/invalid: 1 pose with NaN or a zero quaternion skipped"):
        assert len(bag.trajectory("/invalid")) == COUNT - 1


def test_start_and_stop(bag):
    assert bag.trajectory("/pose", start=int(STAMPS[3]), stop=int(STAMPS[5])).stamps.tolist() == STAMPS[3:6].tolist()


@pytest.mark.parametrize(
    ("source", "text", "hint"),
    [
        ("/pos", "no topic '/pos'", "'/pose'"),
        ("/pose.pos", "/pose has no field 'pos'", "'pose'"),
        ("/twist", "the messages on /twist contain no pose", "position and orientation"),
        ("/particles", "have no separate stamps", "Odometry"),
        ("/plan", "have the same stamp", ""),
        ("/tree", "transforms of a tree", "two frames"),
        ("/moved", "poses in several frames: map, odom", ""),
        ("/silent", "/silent has no messages", ""),
        ("truth.tum", "truth.tum is a file", "read_trajectory"),
        ("pose", "neither two frames nor a topic", ""),
    ],
)
def test_what_is_no_trajectory_is_one_sentence(bag, source, text, hint):
    with pytest.raises(coframe.RecordingError, match=text) as caught:
        bag.trajectory(source)
    assert hint in caught.value.hint


def test_compare_accepts_topics(bag, tmp_path):
    write_trajectory(bag.trajectory("/pose"), tmp_path / "truth.tum")
    code, out, error = run("compare", tmp_path / "truth.tum", f"{bag.path}:/odometry", f"{bag.path}:/path")
    assert (code, error) == (0, "")
    rows = [line.split() for line in out.splitlines()[-2:]]
    assert [(row[0], row[1]) for row in rows] == [(f"{bag.path}:{name}", "30") for name in ("/odometry", "/path")]
    assert all(float(number) < 1e-6 for row in rows for number in row[3:])
    code, _, error = run("compare", tmp_path / "truth.tum", f"{bag.path}:/odometri")
    assert (code, "Did you mean '/odometry'?" in error) == (1, True)


def test_a_topic_is_written_as_a_trajectory_file(bag, tmp_path):
    code, out, error = run("trajectory", bag.path, "/path", "-o", tmp_path / "a.tum")
    assert (code, error) == (0, "")
    assert out.endswith(": 30 poses from 1700000000.000000000 to 1700000001.450000000\n")
    np.testing.assert_allclose(read_trajectory(tmp_path / "a.tum").matrix, TRUTH.matrix, atol=1e-14)
    code, out, _ = run("trajectory", bag.path, "/pose", "--start", "1700000001.35")
    assert (code, len(out.splitlines())) == (0, 3)


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["odom"], "'odom' is one frame"),
        (["/pose", "--rate", "5"], "--rate: the poses on a topic are written as they are"),
        (["/pose", "--validity", "-f", "csv"], "--validity: the poses"),
    ],
)
def test_arguments_for_frames_are_refused_for_topics(bag, words, text):
    code, _, error = run("trajectory", bag.path, *words)
    assert (code, text in error) == (2, True)


def test_quantities_of_poses_on_a_topic_and_in_a_file_are_plotted(bag, tmp_path):
    from coframe.plotting import PlotError, evaluate, trajectory_curves

    curves = evaluate(["/odometry.yaw", "/pose.x", "/odometry.pose.pose.position.x"], bag)
    np.testing.assert_allclose(curves[0].values, TRUTH.yaw, atol=1e-12)
    np.testing.assert_allclose(curves[1].values, curves[2].values, atol=1e-15)
    assert curves[0].panel == "angle [rad]"
    write_trajectory(bag.trajectory("/pose"), tmp_path / "a.tum")
    np.testing.assert_allclose(trajectory_curves(["yaw"], read_trajectory(tmp_path / "a.tum"))[0].values, TRUTH.yaw)
    code, out, error = run("plot", tmp_path / "a.tum", "x", "yaw", "-o", tmp_path / "a.html")
    assert (code, "2 curves, 60 values" in out, error) == (0, True, "")
    with pytest.raises(PlotError, match="has no field 'yw'"):
        evaluate(["/odometry.yw"], bag)
    code, _, error = run("plot", tmp_path / "a.tum", "yw", "-o", tmp_path / "a.html")
    assert (code, "Did you mean 'yaw'?" in error) == (1, True)


def test_a_trajectory_is_a_column_of_a_table(bag, tmp_path):
    truth = bag.trajectory("/pose")
    write_trajectory(truth, tmp_path / "truth.csv")
    table = bag.table(["/pose.pose", Column(truth, name="own"), str(tmp_path / "truth.csv")], at="/odometry")
    np.testing.assert_allclose(table["own.x"], TRUTH.translation[:, 0], atol=1e-15)
    np.testing.assert_allclose(table["truth.qz"], TRUTH.quaternion[:, 2], atol=1e-15)
    between = bag.table(Column(truth, name="own"), at=STAMPS + SECOND // 40)
    np.testing.assert_allclose(between["own.x"][:-1], TRUTH.translation[:-1, 0] + 0.05, atol=1e-12)
    assert between["own.valid"].tolist() == [True] * (COUNT - 1) + [False]
    with pytest.raises(coframe.RecordingError, match="own has no stamps"):
        bag.table(Column(TRUTH, name="own"), at="/pose")
    with pytest.raises(coframe.TrajectoryError, match=r"lost\.tum cannot be read"):
        bag.table("lost.tum", at="/pose")
    code, out, _ = run("table", bag.path, f"truth={tmp_path / 'truth.csv'}", "--at", "/pose", "--no-validity")
    assert (code, out.splitlines()[0]) == (0, "stamp_ns,truth.x,truth.y,truth.z,truth.qx,truth.qy,truth.qz,truth.qw")
