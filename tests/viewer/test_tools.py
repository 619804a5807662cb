# SPDX-License-Identifier: Apache-2.0
"""The tools that publish: points, poses and static transforms, received by a node on the graph."""

import math
import time

import numpy as np
import pytest

import coframe
from coframe.messages import find
from coframe.viewer.rviz.config import RvizConfig

SECOND = 1_000_000_000
POINT = {"topic": "/clicked_point", "frame": "map", "point": [1.0, 2.0, 0.5]}
GOAL = {"topic": "/goal_pose", "frame": "map", "position": [1.0, 2.0, 0.0], "yaw": math.pi / 2}
ESTIMATE = {**GOAL, "topic": "/initialpose", "covariance": [0.25, 0.25, 0.0685]}
STATIC = {"parent": "base", "child": "lidar", "translation": [0.1, 0.0, 0.3], "quaternion": [0.0, 0.0, 0.6, 0.8]}


@pytest.fixture
def graph(domain_id):
    """A node on the graph, and the connection that the viewer shows, with a static mount."""
    pytest.importorskip("dds_library", reason="topics need DDS")
    with (
        coframe.connect("navigation", domain=domain_id) as node,
        coframe.connect("viewer", domain=domain_id) as shown,
    ):
        shown.buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), 100 * SECOND)
        shown.buffer.set("base", "lidar", coframe.Transform([0.0, 0.0, 0.3]), static=True)
        yield node, shown


def test_tools_publish_in_the_fixed_frame_with_the_current_time(graph, view, open_tab):
    node, shown = graph
    types = {"publish_point": "PointStamped", "publish_pose": "PoseStamped"}
    tab = open_tab(view(shown, fixed="map"))
    tab.has("tree")
    received = {}
    for kind, request in (("publish_point", POINT), ("publish_pose", GOAL), ("publish_pose", ESTIMATE)):
        name = "PoseWithCovarianceStamped" if "covariance" in request else types[kind]
        subscription = node.subscribe(request["topic"], find(f"geometry_msgs/msg/{name}"))
        # The server waits for subscriptions that its node has discovered.
        deadline = time.monotonic() + 10.0
        while not shown.participant.subscribers(request["topic"]) and time.monotonic() < deadline:
            time.sleep(0.01)
        answer = tab.ask("published", kind, **request)
        assert (answer["topic"], answer["subscribers"]) == (request["topic"], 1)
        message = received[request["topic"]] = subscription.receive("10s")
        assert message.header.frame_id == "map"
        assert abs(message.header.stamp.sec - time.time()) < 10
    point = received["/clicked_point"].point
    assert [point.x, point.y, point.z] == POINT["point"]
    goal, estimate = received["/goal_pose"].pose, received["/initialpose"].pose
    for pose in (goal, estimate.pose):
        assert [pose.position.x, pose.position.y, pose.position.z] == GOAL["position"]
        assert pose.orientation.z == pytest.approx(math.sqrt(0.5))
        assert pose.orientation.w == pytest.approx(math.sqrt(0.5))
    covariance = np.array(estimate.covariance).reshape(6, 6)
    np.testing.assert_array_equal(np.nonzero(covariance), [[0, 1, 5], [0, 1, 5]])
    assert [covariance[0, 0], covariance[1, 1], covariance[5, 5]] == ESTIMATE["covariance"]

    clock = find("rosgraph_msgs/msg/Clock")
    simulator = node.publisher("/clock", clock)
    message = clock()
    message.clock.sec, message.clock.nanosec = 42, 500
    goals = node.subscribe("/goal_pose", find("geometry_msgs/msg/PoseStamped"))

    def stamp():
        simulator.publish(message)
        tab.ask("published", "publish_pose", **GOAL)
        stamp = goals.receive("10s").header.stamp
        return stamp.sec, stamp.nanosec

    deadline = time.monotonic() + 20.0
    while stamp() != (42, 500):
        assert time.monotonic() < deadline, "simulation time is used while a node publishes /clock"


def test_a_static_transform_is_replaced_for_everyone(graph, view, open_tab):
    node, shown = graph
    tab = open_tab(view(shown, fixed="map"))
    tab.wait("tree", lambda tree: len(tree["frames"]) == 3)
    assert tab.ask("published", "publish_static", **STATIC)["topic"] == "/tf_static"
    for buffer in (node.buffer, shown.buffer):
        deadline = time.monotonic() + 10.0
        while True:
            try:
                found = buffer.lookup("base", "lidar", timeout="10s")
                np.testing.assert_allclose(found.values, [*STATIC["translation"], *STATIC["quaternion"]], atol=1e-12)
            except AssertionError:
                assert time.monotonic() < deadline
                time.sleep(0.02)
            else:
                break
    with coframe.connect("late", domain=shown.participant.domain_id) as late:
        assert late.buffer.lookup("base", "lidar", timeout="10s").translation[0] == 0.1


INVALID = [
    ("publish_point", POINT, {"frame": "base"}, "the fixed frame is 'map', no longer 'base'"),
    ("publish_point", POINT, {"topic": "no slash"}, "'no slash' is not a valid topic name"),
    ("publish_point", POINT, {"topic": "/a//b"}, "'/a//b' is not a valid topic name"),
    ("publish_point", POINT, {"topic": "/" + "a" * 300}, "is not a valid topic name"),
    ("publish_point", POINT, {"point": [1.0, 2.0]}, "must be an array of 3 values"),
    ("publish_point", POINT, {"point": [1.0, 2.0, 1e300]}, "must be a number from -1e+09"),
    ("publish_point", POINT, {"point": [1.0, 2.0, float("nan")]}, "not valid JSON"),
    ("publish_pose", GOAL, {"yaw": "north"}, "yaw of a message 'publish_pose' must be a number"),
    ("publish_pose", GOAL, {"yaw": 1e9}, "yaw of a message 'publish_pose' must be a number from -100"),
    ("publish_pose", ESTIMATE, {"covariance": [-1.0, 0.0, 0.0]}, "covariance[0]"),
    ("publish_static", STATIC, {"child": "base"}, "there is no static transform from 'base' to 'base'"),
    ("publish_static", STATIC, {"parent": "map"}, "there is no static transform from 'map' to 'lidar'"),
    ("publish_static", {**STATIC, "parent": "map", "child": "base"}, {}, "there is no static transform"),
    ("publish_static", STATIC, {"quaternion": [0.0, 0.0, 0.0, 0.5]}, "the quaternion has the norm 0.5"),
    ("publish_static", STATIC, {"quaternion": [0.0, 0.0, 0.0]}, "must be an array of 4 values"),
]


def test_invalid_requests_publish_nothing(graph, view, open_tab):
    node, shown = graph
    points = node.subscribe("/clicked_point", find("geometry_msgs/msg/PointStamped"))
    tab = open_tab(view(shown, fixed="map"))
    tab.wait("tree", lambda tree: len(tree["frames"]) == 3)
    for kind, request, change, text in INVALID:
        assert text in tab.ask("problem", kind, **{**request, **change})["text"], (kind, change)
    assert points.receive("200ms") is None
    assert node.buffer.frame_names() == []


def test_recordings_refuse_to_publish(view, open_tab):
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), 100 * SECOND)
    tab = open_tab(view(buffer, fixed="map"))
    assert not tab.has("hello")["can_publish"]
    tab.has("tree")
    assert tab.ask("problem", "publish_pose", **GOAL) == {
        "type": "problem",
        "text": "nothing was published: publishing requires a live ROS graph",
        "hint": "Start the viewer with `coframe view live`.",
    }


RVIZ = """
Visualization Manager:
  Displays: [{Class: rviz_default_plugins/Grid, Name: Grid, Enabled: true}]
  Global Options: {Fixed Frame: map}
  Tools:
    - Class: rviz_default_plugins/MoveCamera
    - Class: rviz_default_plugins/SetInitialPose
      Covariance x: 0.5
      Topic: {Depth: 5, Durability Policy: Volatile, Value: /robot1/initialpose}
    - Class: rviz_default_plugins/SetGoal
      Topic: /move_base_simple/goal
    - 7
"""


def test_topics_of_tools_are_read_from_and_written_to_rviz_files():
    config = RvizConfig.parse(RVIZ)
    estimate, goal = config.description()["tools"]
    assert estimate == {
        "class": "SetInitialPose",
        "topic": "/robot1/initialpose",
        "options": {"Covariance x": 0.5},
    }
    assert goal == {"class": "SetGoal", "topic": "/move_base_simple/goal", "options": {}}
    unchanged = config.merged([], {}, {}, [estimate, goal])
    assert unchanged._manager["Tools"] == config._manager["Tools"]
    changed = config.merged(
        [],
        {},
        {},
        [
            {**estimate, "topic": "/robot2/initialpose"},
            {"class": "PublishPoint", "topic": "/point", "options": {}},
            {"class": "Select", "topic": "/unknown", "options": {}},
        ],
    )
    tools = RvizConfig.parse(changed.text())._manager["Tools"]
    assert tools[0] == {"Class": "rviz_default_plugins/MoveCamera"}
    assert tools[1]["Topic"] == {"Depth": 5, "Durability Policy": "Volatile", "Value": "/robot2/initialpose"}
    assert tools[2]["Topic"] == "/move_base_simple/goal"
    assert tools[-1]["Class"] == "rviz_default_plugins/PublishPoint"
    assert tools[-1]["Topic"]["Value"] == "/point"
    assert len(tools) == 5
