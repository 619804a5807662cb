# SPDX-License-Identifier: Apache-2.0
"""Frames in the tree and in the scene, compared with a buffer that receives the same transforms."""

import shlex

import numpy as np
import pytest

import coframe
from coframe.cli.static_arguments import parse

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND

LAB = {
    "world": None,
    "map": "world",
    "odom": "map",
    "base_link": "odom",
    "link1": "base_link",
    "link2": "link1",
    "end_effector": "link2",
    "imu_link": "base_link",
    "lidar_link": "base_link",
    "camera_link": "end_effector",
    "gripper_link": "end_effector",
}


def test_the_tree_shows_rates_ages_and_publishers(lab):
    lab.wait(lambda: set(lab.rows()) == set(LAB), "all frames")
    lab.wait(lambda: lab.row("camera_link").get_attribute("aria-level") == "8", "a complete tree")
    assert lab.row("world").get_attribute("aria-level") == "1"
    lab.wait(lambda: lab.row("link1").locator(".rate").inner_text().endswith("Hz"), "rates")
    rows = {name: lab.row(name) for name in LAB}
    publishers = {name: row.locator(".publisher").inner_text() for name, row in rows.items()}
    assert publishers["link1"] == "/dynamic_tf_broadcaster"
    assert publishers["odom"] == publishers["lidar_link"] == "/complete_tf_tree"
    assert rows["lidar_link"].locator(".rate").inner_text() == "static"
    rate = float(rows["link1"].locator(".rate").inner_text().removesuffix(" Hz"))
    assert 5.0 < rate < 100.0
    assert rows["link1"].locator(".age").inner_text().endswith((" ms", " s"))
    assert rows["lidar_link"].get_attribute("data-state") == "static"
    # On a busy machine the publisher may pause for so long that the frame becomes stale.
    lab.wait(lambda: rows["link1"].get_attribute("data-state") == "fresh", "a fresh frame")
    # A label that would overlap another is omitted until the arm has moved.
    lab.wait(lambda: {"base_link", "end_effector", "world"} <= set(lab.texts("#labels .label")), "labels")


def test_drawn_poses_equal_buffer_lookups_for_any_fixed_frame(lab, demo):
    for fixed in ("world", "camera_link", "odom"):
        lab.key("l")  # the buffer of the demo keeps ten seconds
        lab.raw.select_option("#fixed", fixed)
        lab.until("fixed => coframe.fixed === fixed && coframe.frames[fixed].position.every((x) => x === 0)", fixed)
        lab.pause()
        lab.assert_equals_buffer(demo.ros.buffer)


@pytest.fixture
def paused_lab(demo, view, open_page):
    """The page with the last transforms of the demo, and their buffer.

    The demo itself keeps ten seconds of data, which is too short for all clicks on a busy machine.
    """
    demo.ros.buffer.wait("lidar_link", "camera_link", timeout="60s")
    buffer = demo.ros.buffer.snapshot()
    page = open_page(view(buffer, fixed="world").url).drawn().pause()
    page.step("ArrowLeft", -1)  # not all frames have data up to the end
    return page, buffer


LABELS = """() => [...document.querySelectorAll('#labels .label')]
    .filter((label) => coframe.frames[label.textContent])
    .map((label) => {
        const [box, canvas] = [label, document.querySelector('#canvas')].map((one) => one.getBoundingClientRect());
        const pixel = coframe.pixel(coframe.frames[label.textContent].position);
        return [box.x - canvas.x, box.y + box.height / 2 - canvas.y, ...pixel];
    })"""


def test_labels_are_drawn_at_their_frames(paused_lab):
    lab, _ = paused_lab
    lab.raw.select_option("#fixed", "base_link")
    lab.until("coframe.frames.base_link.position.every((x) => x === 0)")
    lab.raw.click("#overlay button:text-is('Top')")
    lab.key("a")

    def labels_match():
        shown = np.array(lab.evaluate(LABELS))
        # Labels far from the right edge of the view are only moved vertically to avoid overlaps.
        return len(shown) >= 4 and np.abs(shown[:, 0] - shown[:, 2]).max() < 20.0 and np.ptp(shown[:, 2:]) > 60.0

    lab.wait(labels_match, "labels at their frames")


def test_hide_solo_and_search(lab):
    lab.row("base_link").locator("input").uncheck()
    lab.until("!coframe.frames.base_link.visible")
    assert lab.evaluate("coframe.frames.lidar_link.visible"), "its children stay visible"
    lab.raw.click("text=Show all")
    lab.shows("base_link")
    lab.row("link2").hover()
    lab.row("link2").locator(".solo").click()
    lab.until("!coframe.frames.base_link.visible")
    shown = lab.evaluate("Object.entries(coframe.frames).filter(([, f]) => f.visible).map(([name]) => name)")
    assert set(shown) == {"link2", "end_effector", "camera_link", "gripper_link"}
    lab.raw.click("text=Show all")
    lab.shows("base_link")
    lab.key("/")
    lab.raw.keyboard.type("LIDAR")
    lab.wait(lambda: lab.rows() == ["world", "map", "odom", "base_link", "lidar_link"], "the lidar and its ancestors")
    lab.raw.fill("#search", "missing")
    assert "No frame name contains “missing”" in lab.text("#panel .empty")


def test_the_inspector_shows_the_pose_in_every_notation(paused_lab):
    lab, buffer = paused_lab
    lab.raw.context.grant_permissions(["clipboard-read", "clipboard-write"])
    _, stamp, _ = lab.drawn_frames()
    lab.row("camera_link").locator(".name").click()
    lab.raw.select_option("#inspector select", "lidar_link")
    expected = buffer.lookup("lidar_link", "camera_link", stamp)
    distance = np.linalg.norm(expected.translation)
    shown = f"{distance:.3f} m" if distance >= 1 else f"{distance * 1000:.1f} mm"
    lab.wait(lambda: lab.text("#distance") == shown, shown)

    def copied(title):
        lab.raw.click(f"#inspector button[title='Copy: {title}']")
        lab.wait(lambda: f"Copied: {title.lower()}" in lab.texts("#toasts .toast div"), title)
        return lab.evaluate("navigator.clipboard.readText()")

    np.testing.assert_allclose(np.fromstring(copied("Translation, m"), sep=" "), expected.translation, atol=1e-9)
    np.testing.assert_allclose(np.fromstring(copied("Quaternion"), sep=" "), expected.quaternion, atol=1e-9)
    np.testing.assert_allclose(
        np.fromstring(copied("Roll, pitch, yaw, degrees"), sep=" "), np.degrees(expected.rpy), atol=1e-7
    )
    np.testing.assert_allclose(
        np.fromstring(copied("Matrix").replace("\n", " "), sep=" ").reshape(4, 4), expected.matrix, atol=1e-9
    )
    command = shlex.split(copied("Command"))
    assert command[:2] == ["coframe", "static"]
    arguments = parse(command[2:])
    assert (arguments.frame_id, arguments.child_frame_id) == ("lidar_link", "camera_link")
    np.testing.assert_allclose(arguments.transform.matrix, expected.matrix, atol=1e-7)
    chain = ["camera_link", "end_effector", "link2", "link1", "base_link", "lidar_link"]
    assert lab.texts("#inspector .chain button") == chain


def test_separate_trees_are_labeled_and_a_broken_chain_is_explained(view, open_page):
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), BEGIN)
    buffer.set("map", "other", coframe.Transform([0.0, 1.0, 0.0]), BEGIN)
    buffer.set("dock", "charger", coframe.Transform([0.0, 0.0, 1.0]), BEGIN)
    page = open_page(view(buffer).url).drawn()
    assert page.texts("#panel .row .tag:visible")[:1] != [""]
    tags = {name: page.row(name).locator(".tag").inner_text() for name in ("map", "dock", "base")}
    assert tags == {"map": "fixed · separate tree · 3 frames", "dock": "separate tree · 2 frames", "base": ""}
    page.wait(lambda: "dock: separate tree" in page.texts("#labels .label"), "a caption in the scene")
    page.row("charger").locator(".name").click()
    page.wait(lambda: "charger" in page.text("#inspector .problem"), "the reason why there is no transform")
    assert "map" in page.text("#inspector .problem")
    broken = page.text("#inspector .chain .broken")
    assert broken.startswith("dock")
    assert broken.endswith("the chain ends here")


def test_utm_coordinates_are_drawn_exactly(view, open_page):
    buffer = coframe.Buffer(None)
    base = [500_123.456_7, 5_812_345.678_9, 123.456_7]
    buffer.set("utm", "base", coframe.Transform.from_rpy(base, [0.1, 0.2, 0.3]), BEGIN)
    buffer.set("base", "lidar", coframe.Transform([0.123_45, 0.0, 0.3]), static=True)
    page = open_page(view(buffer, fixed="utm").url).drawn()
    page.assert_equals_buffer(buffer)
    page.raw.select_option("#fixed", "lidar")
    page.until("coframe.frames.lidar.position.every((x) => x === 0)")
    _, stamp, frames = page.drawn_frames()
    np.testing.assert_allclose(frames["base"]["position"], buffer.lookup("lidar", "base", stamp).translation, atol=1e-5)


def test_stale_frames_fade_and_disappear(view, open_page):
    buffer = coframe.Buffer(None)
    for second in range(31):
        buffer.set("map", "base", coframe.Transform([second, 0.0, 0.0]), BEGIN + second * SECOND)
    buffer.set("base", "arm", coframe.Transform(), BEGIN + 10 * SECOND)
    buffer.set("base", "arm", coframe.Transform(), BEGIN)
    page = open_page(view(buffer, fixed="map").url).drawn()
    page.pause()
    page.until("!coframe.frames.arm.visible && coframe.frames.base.visible")
    for _ in range(12):
        page.step("ArrowLeft", -1)
    page.shows("arm")
    assert page.evaluate("coframe.frames.arm.state") == 1
