# SPDX-License-Identifier: Apache-2.0
"""The doctor's advice for people without ROS: what a finding says must be possible with coframe alone."""

import ast
import json
import re
from math import cos, pi, radians, sin
from pathlib import Path

import pytest
from click.testing import CliRunner
from recordings import START
from runs import MS, SECOND, Run, stamp_message

import coframe
from coframe.analysis.missing_edges import MissingEdge
from coframe.cli.app import app
from coframe.doctor import Observation, codes, diagnose, observe_recording, page
from coframe.doctor._transforms import Transforms
from coframe.doctor.observation import ObservedEndpoint, TopicFacts
from coframe.errors import PackageError
from coframe.messages import find
from coframe.robots import Packages

SOURCES = Path(coframe.__file__).parent
ADVISING = [
    *sorted((SOURCES / "doctor").rglob("*.py")),
    *sorted((SOURCES / "analysis").rglob("*.py")),
    *sorted((SOURCES / "robots").rglob("*.py")),
    *sorted((SOURCES / "buffer" / "explanation").rglob("*.py")),
    *sorted((SOURCES / "errors").rglob("*.py")),
]
NEEDS_ROS = re.compile(
    r"\bros2 (?:bag|run|launch|topic|node|param|service|interface|doctor|pkg)\b|\bros(?:run|launch|topic|node|bag) "
    r"|\bsourc(?:e|ing) (?:the|a|your) workspace|setup\.(?:ba|z)?sh|\bcolcon\b|check_urdf|view_frames|\brqt_"
    r"|\bapt(?:-get)? install",
    re.IGNORECASE,
)


def texts(source):
    """Yield the string literals of a module that are not docstrings."""
    tree = ast.parse(source)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    docstrings = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, documented) and node.body and isinstance(node.body[0], ast.Expr)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            yield node.value


@pytest.mark.parametrize("code", codes())
def test_no_page_needs_a_ros_installation(code):
    assert not NEEDS_ROS.findall(page(code).text)


@pytest.mark.parametrize("file", ADVISING, ids=lambda file: file.relative_to(SOURCES).as_posix())
def test_no_finding_and_no_hint_needs_a_ros_installation(file):
    found = [text for text in texts(file.read_text("utf-8")) if NEEDS_ROS.search(text)]
    assert found == []


@pytest.mark.parametrize(
    "url",
    [
        "package://none/arm.stl",
        "package://parts/none.stl",
        "package://parts/../secret.stl",
        "package://../a",
        "http://a/b",
    ],
)
def test_every_problem_with_a_package_url_names_the_variable(url, tmp_path, monkeypatch):
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path))
    (tmp_path / "parts").mkdir()
    (tmp_path / "secret.stl").write_bytes(b"")
    with pytest.raises(PackageError) as caught:
        Packages().resolve(url)
    assert "COFRAME_PACKAGE_PATH" in caught.value.hint


@pytest.mark.parametrize("url", ["package://none/arm.stl", "package://parts/none.stl"])
def test_the_viewer_names_the_variable_for_a_missing_mesh(url, tmp_path, monkeypatch):
    from coframe.viewer.robots.robot_message import make_mesh_table

    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path))
    (tmp_path / "parts").mkdir()
    assert "COFRAME_PACKAGE_PATH" in make_mesh_table(None, []).url_or_problem(url)[1]


def test_all_codes_are_listed_with_their_titles():
    result = CliRunner().invoke(app, ["doctor", "--list"])
    assert result.exit_code == 0
    assert result.output.splitlines() == [f"{code}  {page(code).title}" for code in codes()]
    as_json = json.loads(CliRunner().invoke(app, ["doctor", "--list", "--json"]).output)
    assert as_json == [{"code": code, "title": page(code).title} for code in codes()]


@pytest.fixture
def findings(tmp_path):
    """Return a function that writes a run and returns its findings with their consequences."""

    def examine(run):
        (observation,) = observe_recording(run.write(tmp_path)).values()
        return diagnose(observation).every_finding()

    return examine


def odometry(run, at, frame="odom"):
    message = find("nav_msgs/msg/Odometry")(child_frame_id="base_link")
    message.header.stamp, message.header.frame_id = stamp_message(at), frame
    run.message("/odom", "nav_msgs/msg/Odometry", message, at + MS)


# A stamp of 0


@pytest.mark.parametrize("every", [1, 3])
def test_transform_without_a_stamp_is_not_on_another_clock(findings, every):
    run = Run.healthy(skip={"odom"})
    for i in range(600):
        at = START + i * SECOND // 50
        run.drive(at, stamp=0 if i % every == 0 else at)
    (finding,) = findings(run)
    assert finding.code == "TF008"
    assert f"the stamp was never set: {600 // every} of 600 transforms have the stamp 0" in finding.text
    assert "t.header.stamp = self.get_clock().now().to_msg()" in finding.fix


def test_sensor_without_a_stamp_is_not_on_another_clock(findings):
    run = Run.healthy(skip={"scan"})
    for i in range(100):
        run.scan(0, arrived=START + i * SECOND // 10)
    (finding,) = findings(run)
    assert finding.code == "TF008"
    assert "the stamp was never set: 100 of 100 messages have the stamp 0" in finding.text
    assert "msg.header.stamp = self.get_clock().now().to_msg()" in finding.fix


def test_simulation_that_begins_at_0_has_set_its_stamps(findings):
    run = Run()
    clock = find("rosgraph_msgs/msg/Clock")
    for i in range(600):
        at, simulated = START + i * SECOND // 50, max(0, i - 60) * SECOND // 50
        run.message("/clock", "rosgraph_msgs/msg/Clock", clock(clock=stamp_message(simulated)), at)
        run.drive(at, stamp=simulated)
    assert not any("never set" in finding.text for finding in findings(run))


# Frames that odometry and localization estimate


def test_missing_odom_is_answered_by_the_odometry_publisher(findings):
    run = Run.healthy(skip={"odom", "scan"})
    for i in range(100):
        odometry(run, START + i * SECOND // 10)
    (finding,) = findings(run)
    assert finding.code == "TF014"
    assert finding.fix.startswith(
        "Your odometry publisher does not broadcast odom -> base_link (often an option such as publish_tf)"
    )
    assert "coframe static" not in finding.fix


def test_missing_map_is_answered_by_the_localization(findings):
    run = Run.healthy()
    for i in range(100):
        run.scan(START + i * SECOND // 10, "map", topic="/detections")
    (finding,) = findings(run)
    assert "Your localization or SLAM node does not broadcast map -> odom" in finding.fix
    assert "coframe static" not in finding.fix


@pytest.mark.parametrize(
    ("frame", "static"),
    [
        ("front_laser", True),
        ("imu_link", True),
        ("robot1/camera_optical_frame", True),
        ("shelf", False),
        ("goal", False),
    ],
)
def test_only_sensors_get_the_suggestion_of_a_static_mount(findings, frame, static):
    run = Run.healthy()
    for i in range(100):
        run.scan(START + i * SECOND // 10, frame, topic="/front")
    (finding,) = findings(run)
    assert (f"coframe static --frame-id base_link --child-frame-id {frame} " in finding.fix) is static
    assert ("coframe static" in finding.fix) is static


@pytest.mark.parametrize(
    ("parent", "child", "node"),
    [
        ("odom", "base_link", "odometry publisher"),
        ("r1/odom", "r1/base_footprint", "odometry publisher"),
        ("map", "odom", "localization or SLAM node"),
        ("map", "base_link", "localization or SLAM node"),
    ],
)
def test_two_trees_are_not_connected_by_a_static_transform_that_must_move(parent, child, node):
    edge = MissingEdge(parent, child, misspelled=False)
    for advice in (edge.fix, edge.hint):
        assert f"Your {node} does not broadcast {parent} -> {child} (often an option such as publish_tf" in advice
        assert "static" not in advice.lower()


def test_mount_between_two_trees_can_be_static():
    edge = MissingEdge("base_link", "lidar", misspelled=False)
    assert "coframe static --frame-id base_link --child-frame-id lidar" in edge.fix
    assert "StaticTransformBroadcaster" in edge.hint


# Quaternions


@pytest.mark.parametrize(
    ("turn", "mistake", "values"),
    [
        (
            lambda a: (0, 0, sin(a / 2), cos(a)),
            "w is cos(yaw) instead of cos(yaw / 2)",
            "z = 0.479426 and .*w = 0.877583",
        ),
        (
            lambda a: (0, sin(a), 0, cos(a / 2)),
            "y is sin(pitch) instead of sin(pitch / 2)",
            "y = 0.479426 and .*w = 0.877583",
        ),
        (lambda a: (sin(a) / 2, 0, 0, cos(a / 2)), r"x is sin(roll) / 2 instead of sin(roll / 2)", "x = 0.479426 and"),
        (
            lambda a: (0, 0, sin(a) / 2, cos(a) / 2),
            "z and w are sin(yaw) / 2 and cos(yaw) / 2 instead of",
            "z = 0.479426",
        ),
        (
            lambda a: (0, 0, sin(-a / 2), cos(a)),
            "w is cos(yaw) instead of cos(yaw / 2)",
            "yaw = -57.3 degrees .*z = -0.479426",
        ),
    ],
)
@pytest.mark.parametrize("moving", [False, True])
def test_missing_half_angle_is_named_with_the_right_values(findings, turn, mistake, values, moving):
    run = Run.healthy()
    for i in range(600 if moving else 1):
        run.tf("base_link", "arm", START + i * SECOND // 50, (0.1, 0, 0), turn(1.0 + i / 1000), static=not moving)
    (finding,) = findings(run)
    assert finding.code == "TF019"
    assert f"; the half angle is missing: {mistake}" in finding.text
    assert re.search(values, finding.fix), finding.fix


def test_rotation_with_the_full_angle_at_more_than_120_degrees_is_named(findings):
    run = Run.healthy()
    run.tf("base_link", "arm", START, (0.1, 0, 0), (0, 0, sin(2.5), cos(1.25)), static=True)
    (finding,) = findings(run)
    assert "z is sin(yaw) instead of sin(yaw / 2)" in finding.text
    assert "yaw = 143 degrees" in finding.fix


@pytest.mark.parametrize(
    ("turn", "text", "fix"),
    [
        ((0, 0, 90, 1), "the angles yaw = 90 degrees in degrees", "x = 0, y = 0, z = 0.707107, w = 0.707107"),
        ((0, 0, pi / 2, 0), "the angles yaw = 90 degrees in radians", "z = 0.707107, w = 0.707107"),
        ((-90, 0, -90, 0), "roll = -90 degrees, yaw = -90 degrees in degrees", "x = -0.5, y = 0.5, z = -0.5, w = 0.5"),
        (
            (0, 0, sin(radians(30)), 1),
            "w is 1, as if only z had been set",
            "z = 0.5 and t.transform.rotation.w = 0.866025",
        ),
    ],
)
def test_angles_in_place_of_components_are_named(findings, turn, text, fix):
    run = Run.healthy()
    run.tf("base_link", "arm", START, (0.1, 0, 0), turn, static=True)
    (finding,) = findings(run)
    assert text in finding.text
    assert fix in finding.fix


@pytest.mark.parametrize("turn", [(0, 0, 0.5, 0.5), (0.1, 0.2, 0.3, 0.4), (0, 0, 2, 3), (0.7, 0.1, 0, 0.8)])
def test_other_quaternions_get_no_false_cause(findings, turn):
    run = Run.healthy()
    run.tf("base_link", "arm", START, (0.1, 0, 0), turn, static=True)
    (finding,) = findings(run)
    assert finding.fix.startswith("Check the order x, y, z, w, and normalize it")


# Mounts and rates

URDF = """<robot name="r"><link name="base_link"/><link name="plate"/><link name="lidar"/>
<joint name="stand" type="fixed"><parent link="base_link"/><child link="plate"/><origin xyz="0 0 0.2"/></joint>
<joint name="mount" type="fixed"><parent link="plate"/><child link="lidar"/>
<origin xyz="0.1 0 0.15" rpy="0 0 1.5708"/></joint>
</robot>"""


def describe(run, text):
    message = find("std_msgs/msg/String")(data=text)
    run.message("/robot_description", "std_msgs/msg/String", message, START)


def test_static_mount_that_differs_from_the_description_shows_both_poses(findings):
    run = Run.healthy(skip={"static"})
    describe(run, URDF)
    run.tf("base_link", "plate", START, (0, 0, 0.2), static=True)
    run.tf("plate", "lidar", START, (0.1, 0, 0.1), static=True)
    (finding,) = findings(run)
    assert (finding.code, finding.edge) == ("TF023", ("plate", "lidar"))
    assert "differs from fixed joint 'mount' of the robot description by 0.05 m and 90 degrees" in finding.text
    assert "published x 0.1, y 0, z 0.1 m, roll 0, pitch 0, yaw 0 degrees" in finding.text
    assert "described x 0.1, y 0, z 0.15 m, roll 0, pitch 0, yaw 90 degrees" in finding.text
    assert 'xyz="0.1 0 0.1" rpy="0 0 0"' in finding.fix


def test_static_mount_across_several_fixed_joints_is_compared(findings):
    run = Run.healthy()  # with base_link -> lidar at z = 0.3 m, without rotation
    describe(run, URDF)
    (finding,) = findings(run)
    assert (finding.code, finding.edge) == ("TF023", ("base_link", "lidar"))
    assert "described x 0.1, y 0, z 0.35 m, roll 0, pitch 0, yaw 90 degrees" in finding.text


def test_static_mount_that_agrees_with_several_fixed_joints_is_no_finding(findings):
    run = Run.healthy()
    describe(run, URDF.replace("0.15", "0.1").replace("1.5708", "0"))
    assert findings(run) == []


@pytest.mark.parametrize(
    ("rate", "scans", "child", "found"),
    [
        (8, 10, "base_link", True),
        (5, 20, "base_link", True),
        (10, 40, "base_link", False),
        (8, 8, "base_link", False),
        (8, 20, "turret", True),
        (8, 10, "turret", False),
        (5, 20, "odom", False),
    ],
)
def test_rate_below_that_of_the_scans_that_need_it(findings, rate, scans, child, found):
    run = Run.healthy(skip={"odom", "scan", "static"})
    run.tf("base_link", "lidar", START, (0.1, 0.0, 0.3), static=True)
    parents = {"base_link": "odom", "turret": "base_link", "odom": "map"}
    if child != "base_link":
        for i in range(600):
            run.drive(START + i * SECOND // 50)
    frame = "turret" if child == "turret" else "lidar"
    for i in range(12 * rate):
        run.drive(START + i * SECOND // rate, parents[child], child)
    for i in range(12 * scans):
        run.scan(START + i * SECOND // scans, frame)
    slow = [finding for finding in findings(run) if finding.code == "TF013"]
    assert bool(slow) is found
    if found:
        assert slow[0].edge == (parents[child], child)
        assert f"({rate} Hz), but /scan, which needs it, every" in slow[0].text
        assert "create_timer(0.05, self.broadcast)" in slow[0].fix


# Topics without messages


@pytest.mark.parametrize(
    ("topic", "kind", "messages", "seconds", "latched", "found"),
    [
        ("/scan", "sensor_msgs/msg/LaserScan", 0, 8, False, True),
        ("/imu", "sensor_msgs/msg/Imu", 0, 8, False, True),
        ("/joint_states", "sensor_msgs/msg/JointState", 0, 8, False, True),
        ("/tf", "tf2_msgs/msg/TFMessage", 0, 8, False, True),
        ("/scan", "sensor_msgs/msg/LaserScan", 1, 8, False, False),
        ("/scan", "sensor_msgs/msg/LaserScan", 0, 3, False, False),
        ("/cloud", "sensor_msgs/msg/PointCloud2", 0, 8, True, False),
        ("/joint_command", "sensor_msgs/msg/JointState", 0, 8, False, False),
        ("/goal_pose", "geometry_msgs/msg/PoseStamped", 0, 8, False, False),
        ("/tf_static", "tf2_msgs/msg/TFMessage", 0, 8, True, False),
    ],
)
def test_topic_that_never_publishes(topic, kind, messages, seconds, latched, found):
    publishers = (ObservedEndpoint("/driver", transient_local=latched),)
    facts = TopicFacts(topic, kind, messages, publishers, observed=seconds * SECOND)
    empty = Transforms.join_batches([], ())
    report = diagnose(Observation(True, START, START + 10 * SECOND, empty, topics={topic: facts}))
    assert [finding.code for finding in report.findings] == ["TF026"] * found
    if found:
        (finding,) = report.findings
        assert (finding.topic, finding.publishers) == (topic, ("/driver",))
        assert "no message was received in 8 s" in finding.text
