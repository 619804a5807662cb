# SPDX-License-Identifier: Apache-2.0
"""The camera: measuring, following a frame, and the top-down view."""

import io
import re

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
MINUS = "\N{MINUS SIGN}"


@pytest.fixture
def page(view, open_page):
    """Open a page, paused at the end of ten seconds in which base moves from x = 0 to x = 10, with an arm."""
    buffer = coframe.Buffer(None)
    for tenth in range(101):
        at = coframe.Transform.from_rpy([tenth / 10, 0.0, 0.5], [0.0, 0.0, tenth / 100])
        buffer.set("map", "base", at, BEGIN + tenth * SECOND // 10)
    buffer.set("base", "arm", coframe.Transform([1.0, 2.0, 0.5]), static=True)
    page = open_page(view(buffer, fixed="map").url).drawn()
    page.buffer = buffer
    return page.pause()


def position(page, frame):
    return np.array(page.evaluate("frame => coframe.frames[frame].position", frame))


def click_on(page, frame):
    """Click a frame on the canvas, once the camera stands still."""
    before = None
    while before != (before := page.evaluate("frame => coframe.pixel(coframe.frames[frame].position)", frame)):
        page.raw.wait_for_timeout(200)
    x, y = before[:2]
    box = page.raw.locator("#canvas").bounding_box()
    page.raw.mouse.click(box["x"] + x, box["y"] + y)


def go(page, part):
    """Go to a fraction of the timeline, and wait until base is at its position of that time."""
    page.scrub(part)
    page.until("x => Math.abs(coframe.frames.base.position[0] - x) < 0.2", 10 * part)
    page.settle()


def test_two_clicks_measure_the_distance_of_the_buffer(page):
    page.key("a")
    page.key("m")
    page.wait(lambda: "click the first frame" in page.text("#measured"), "the first instruction")
    click_on(page, "base")
    page.wait(lambda: page.text("#measured").startswith("From base"), "the second instruction")
    click_on(page, "arm")
    number = rf"([{MINUS}\d.]+)"
    pattern = re.compile(rf"{number} m\s+Δx {number}\s+Δy {number}\s+Δz {number}")
    found = page.wait(lambda: pattern.fullmatch(page.text("#measured")), "a distance")
    distance, *along = (float(part.replace(MINUS, "-")) for part in found.groups())
    stamp = page.drawn_frames()[1]
    base, arm = (page.buffer.lookup("map", frame, stamp) for frame in ("base", "arm"))
    expected = arm.translation - base.translation
    np.testing.assert_allclose(along, expected, atol=0.0006)
    assert distance == pytest.approx(np.linalg.norm(expected), abs=0.0006)
    assert f"{distance:.3f} m" in page.texts("#labels .label")
    page.key("Escape")
    page.wait(lambda: not page.raw.locator("#measured").is_visible(), "the end of the measurement")


def test_measured_points_are_forgotten_when_the_fixed_frame_changes(page):
    page.key("a")
    page.key("m")
    page.wait(lambda: "click the first frame" in page.text("#measured"), "the first instruction")
    box = page.raw.locator("#canvas").bounding_box()
    page.raw.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] - 60)
    page.wait(lambda: page.text("#measured").startswith("From ("), "a point of the ground")
    page.raw.select_option("#fixed", "base")
    page.wait(lambda: "click the first frame" in page.text("#measured"), "a new measurement")


def test_pressing_the_timeline_of_live_data_is_not_at_a_time_of_an_earlier_zoom(page):
    box = page.raw.locator(".scrub canvas").bounding_box()
    left, middle = box["x"] + box["width"] * 0.02, box["y"] + box["height"] / 2
    page.raw.mouse.move(left, middle)
    for _ in range(8):
        page.raw.mouse.wheel(0, -100)
    page.key("l")
    page.until("coframe.frames.base.position[0] > 9.9")
    page.raw.mouse.move(box["x"] + box["width"] / 2, middle)
    page.raw.mouse.down()
    page.raw.mouse.move(box["x"] + box["width"] / 2 + 1, middle)
    page.raw.mouse.up()
    page.until("Math.abs(coframe.frames.base.position[0] - 5) < 0.5")


def test_the_camera_keeps_its_distance_to_the_followed_frame(page):
    page.row("arm").locator(".name").click()
    page.key("f")
    page.wait(lambda: page.text("#overlay .hint:visible") == "Following arm", "the name of the followed frame")

    def offset():
        camera = page.evaluate("coframe.camera")
        np.testing.assert_allclose(camera["target"], position(page, "arm"), atol=1e-3)
        return np.array(camera["position"]) - position(page, "arm")

    before, start = offset(), position(page, "arm")
    for part in (0.5, 0.1):
        go(page, part)
        np.testing.assert_allclose(offset(), before, atol=1e-3)
    assert np.linalg.norm(position(page, "arm") - start) > 5.0
    page.key("f")
    page.wait(lambda: not page.raw.locator("#overlay .hint:visible").count(), "the end of following")
    stopped = page.evaluate("coframe.camera.position")
    go(page, 0.9)
    assert page.evaluate("coframe.camera.position") == stopped


def test_in_the_top_view_y_is_up_and_z_has_no_effect(page):
    page.key("v")
    page.until("coframe.camera.mode === 'top'")
    page.key("a")
    camera = page.evaluate("coframe.camera")
    np.testing.assert_allclose(camera["position"][:2], camera["target"][:2], atol=1e-6)
    origin, right, up, high = np.array(page.evaluate("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2]].map(coframe.pixel)"))
    scale = right[0] - origin[0]
    assert scale > 10, "pixels per meter"
    np.testing.assert_allclose([right, up, high] - origin, [[scale, 0], [0, -scale], [0, 0]], atol=1e-2)
    page.row("base").locator(".name").click()
    page.until("document.querySelector('#panel .row[aria-selected=true]')?.dataset.frame === 'base'")
    click_on(page, "arm")
    page.until("document.querySelector('#panel .row[aria-selected=true]')?.dataset.frame === 'arm'")
    page.key("v")
    page.until("coframe.camera.mode === 'orbit'")


def test_additional_views_follow_frames_and_look_out_of_them(page):
    page.click("[title^='Add a view']")
    page.row("arm").locator(".name").click()
    page.click("[title^='Add a view']")
    page.raw.locator(".pane").nth(1).locator("select").first.select_option("first")
    top, first = page.until("coframe.panes.length === 2 && coframe.panes[1].kind === 'first' && coframe.panes")
    assert (top["kind"], top["frame"], first["frame"]) == ("top", None, "arm")
    np.testing.assert_allclose([top["forward"], top["up"]], [[0, 0, -1], [0, 1, 0]], atol=1e-6)
    for part in (0.9, 0.2):
        go(page, part)
        fixed, stamp, _ = page.drawn_frames()
        arm = page.buffer.lookup(fixed, "arm", stamp)
        first = page.evaluate("coframe.panes[1]")
        np.testing.assert_allclose(first["position"], arm.translation, atol=1e-4)
        np.testing.assert_allclose([first["forward"], first["up"]], arm.matrix[:3, [0, 2]].T, atol=1e-4)
    assert "base" in page.texts(".pane .label"), "the view from above has labels"
    box = page.raw.locator(".pane-area").first.bounding_box()
    picture = page.raw.screenshot(clip=box)
    assert number_of_colors(picture) > 20, "the view from above is drawn"
    page.until("coframe.pixel([0, 0, 0])[0] < 1200")
    for _ in range(2):
        page.raw.locator(".pane [title='Close this view']").first.click()
    page.until("coframe.panes.length === 0")


def number_of_colors(png):
    image = pytest.importorskip("PIL.Image")
    return len(image.open(io.BytesIO(png)).convert("RGB").getcolors(1 << 20))
