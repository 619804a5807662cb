# SPDX-License-Identifier: Apache-2.0
"""RViz's tools in the page: poses and points that a node on the graph receives, and labels on any background."""

import math
import re

import numpy as np
import pytest

import coframe
from coframe.messages import find

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


def pixel(page, point):
    """Return the position of a point of the fixed frame in the window."""
    x, y = page.evaluate("point => coframe.pixel(point)", list(point))
    box = page.raw.locator("#canvas").bounding_box()
    return box["x"] + x, box["y"] + y


def drag(page, start, end):
    mouse = page.raw.mouse
    mouse.move(*pixel(page, start))
    mouse.down()
    mouse.move(*pixel(page, end), steps=4)
    mouse.up()


@pytest.fixture
def graph(domain_id):
    pytest.importorskip("dds_library", reason="topics need DDS")
    with coframe.connect("browser_tools", domain=domain_id) as ros:
        ros.buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), static=True)
        ros.buffer.set("base", "arm", coframe.Transform([1.0, 2.0, 0.5]), static=True)
        yield ros


def test_poses_and_points_are_published_where_the_user_has_pressed(graph, view, open_page):
    types = {"/initialpose": "PoseWithCovarianceStamped", "/my_goal": "PoseStamped", "/clicked_point": "PointStamped"}
    received = {topic: graph.subscribe(topic, find(f"geometry_msgs/msg/{name}")) for topic, name in types.items()}
    page = open_page(view(graph, fixed="map").url).drawn()
    page.key("v")
    page.key("a")
    page.raw.wait_for_timeout(300)

    page.key("p")
    page.wait(lambda: page.text("#tool").startswith("2D pose estimate: Press at"), "the instruction")
    before = page.evaluate("coframe.camera")
    drag(page, (1.5, 0.5, 0.0), (1.5, 1.5, 0.0))
    estimate = received["/initialpose"].receive("10s")
    assert page.evaluate("coframe.camera") == before, "the drag does not move the camera"
    assert not page.raw.locator("#tool").is_visible(), "the tool is used once"
    assert estimate.header.frame_id == "map"
    pose = estimate.pose.pose
    np.testing.assert_allclose([pose.position.x, pose.position.y, pose.position.z], [1.5, 0.5, 0.0], atol=0.02)
    assert 2 * math.atan2(pose.orientation.z, pose.orientation.w) == pytest.approx(math.pi / 2, abs=0.02)
    assert estimate.pose.covariance[35] == pytest.approx((math.pi / 12) ** 2)
    page.wait(lambda: "Published on /initialpose: x 1.50" in page.text("#toasts"), "the confirmation")

    page.click("[data-tool=goal]")
    page.raw.fill("#tool input", "/my_goal")
    page.raw.press("#tool input", "Enter")
    drag(page, (2.0, 1.0, 0.0), (1.0, 1.0, 0.0))
    goal = received["/my_goal"].receive("10s")
    np.testing.assert_allclose([goal.pose.position.x, goal.pose.position.y], [2.0, 1.0], atol=0.02)
    assert abs(2 * math.atan2(goal.pose.orientation.z, goal.pose.orientation.w)) == pytest.approx(math.pi, abs=0.02)

    page.key("u")
    page.raw.mouse.click(*pixel(page, (1.2, 0.6, 0.0)))
    point = received["/clicked_point"].receive("10s").point
    np.testing.assert_allclose([point.x, point.y, point.z], [1.2, 0.6, 0.0], atol=0.02)

    page.key("n")
    for end in ((1.2, 0.6, 0.0), (2.2, 0.6, 0.0)):
        page.raw.mouse.click(*pixel(page, end))
    page.wait(lambda: re.search(r"Δx (1\.0[01]|0\.99)", page.text("#measured")), "the distance of points")
    page.key("Escape")

    page.key("g")
    page.raw.mouse.move(*pixel(page, (2.0, 1.0, 0.0)))
    page.raw.mouse.down()
    page.key("Escape")
    page.raw.mouse.up()
    assert received["/my_goal"].receive("300ms") is None, "Escape cancels a drag"


def test_a_static_transform_is_adjusted_by_hand_and_published(graph, view, open_page):
    stamped = find("geometry_msgs/msg/PoseStamped")
    publisher = graph.publisher("/detection", stamped)
    page = open_page(view(graph, fixed="map").url).drawn()
    message = stamped()
    message.header.frame_id = "arm"

    def detected():
        publisher.publish(message)
        shown = page.evaluate("coframe.displays").get("Pose", {}).get("messages")
        return shown and shown[0]["position"]

    page.wait(detected, "the message")
    page.key("v")
    page.key("a")
    page.raw.wait_for_timeout(300)
    page.row("arm").locator(".name").click()
    page.click("#adjust button:text('Adjust by hand')")
    page.raw.wait_for_timeout(300)
    x, y = pixel(page, (2.0, 2.0, 0.5))
    meter = pixel(page, (3.0, 2.0, 0.5))[0] - x
    mouse = page.raw.mouse
    mouse.move(x + 50, y)
    mouse.down()
    mouse.move(x + 90, y, steps=4)
    mouse.move(x + 50 + 0.5 * meter, y, steps=4)
    mouse.up()
    at = page.until("coframe.frames.arm.position[0] > 2.1 && coframe.frames.arm.position")
    np.testing.assert_allclose(at, [2.5, 2.0, 0.5], atol=0.03)
    np.testing.assert_allclose(page.wait(detected, "the message"), at, atol=1e-4)
    assert page.evaluate("coframe.frames.base.position") == [1, 0, 0]
    assert graph.buffer.lookup("base", "arm").translation[0] == 1.0, "only this page shows it"
    numbers = r"--x (\S+) --y 2 --z 0.5 --qx 0 --qy 0 --qz 0 --qw 1"
    command, ros, urdf = page.texts("#adjust .command")
    found = re.fullmatch(f"coframe static --frame-id base --child-frame-id arm {numbers}", command)
    assert float(found[1]) == pytest.approx(at[0] - 1.0, abs=1e-5)
    assert ros.startswith("ros2 run tf2_ros static_transform_publisher --frame-id base --child-frame-id arm --x")
    assert urdf == f'<origin xyz="{found[1]} 2 0.5" rpy="0 0 0"/>'
    page.click("#adjust button:text('Publish')")
    page.wait(lambda: "Published base → arm on /tf_static" in page.text("#toasts"), "the confirmation")
    page.wait(lambda: abs(graph.buffer.lookup("base", "arm").translation[0] - float(found[1])) < 1e-6, "the transform")
    page.click("#adjust button:text('Stop adjusting')")
    page.until("x => Math.abs(coframe.frames.arm.position[0] - x) < 1e-5", at[0])


def test_an_option_beats_the_file_and_the_last_session_and_labels_stay_readable(view, open_page, tmp_path):
    buffer = coframe.Buffer(None)
    for frame in ("odom", "base"):
        buffer.set("map", frame, coframe.Transform([1.0, 0.0, 0.0]), BEGIN)
    file = tmp_path / "dark.rviz"
    file.write_text(
        "Visualization Manager:\n  Displays: [{Class: rviz/TF, Enabled: true, Name: TF}]\n"
        "  Global Options: {Fixed Frame: odom, Background Color: 20; 20; 20}\n"
    )
    page = open_page(view(buffer, rviz=file, fixed="map").url, color_scheme="light").drawn()
    page.until("coframe.fixed === 'map'")
    light = "([r, g, b]) => (r + g + b) / 3 > 128"
    color = "getComputedStyle(document.querySelector('#labels .label')).color.match(/\\d+/g).map(Number)"
    page.until("document.querySelector('#labels .label')")
    assert page.evaluate("document.documentElement.dataset.theme") == "light"
    assert page.evaluate(f"({light})({color})"), "light labels on the dark background of the file"
    page.raw.select_option("#fixed", "base")
    page.until("coframe.fixed === 'base'")
    page.key("d")
    page.key("d")
    page.until(f"!({light})({color})")
    page.raw.reload()
    page.drawn()
    page.until("coframe.fixed === 'map'")
    page.key("p")
    page.wait(lambda: "Publishing requires a live ROS graph." in page.text("#toasts"), "the reason")
    assert not page.raw.locator("#tool").is_visible()
    assert "Publishing requires a live ROS graph." in page.raw.locator("[data-tool=goal]").get_attribute("title")
