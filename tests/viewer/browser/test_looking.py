"""How one looks: measuring with two clicks, going along with a frame, and straight from above."""

import re

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
MINUS = "\N{MINUS SIGN}"


@pytest.fixture
def page(view, open_page):
    """base goes from x = 0 to x = 10 in ten seconds, with an arm; paused at the end."""
    buffer = coframe.Buffer(None)
    for tenth in range(101):
        at = coframe.Transform.from_rpy([tenth / 10, 0.0, 0.5], [0.0, 0.0, tenth / 100])
        buffer.set("map", "base", at, BEGIN + tenth * SECOND // 10)
    buffer.set("base", "arm", coframe.Transform([1.0, 2.0, 0.5]), static=True)
    page = open_page(view(buffer, fixed="map").url).drawn()
    page.buffer = buffer
    return page.pause()


def position(page, frame):
    return np.array(page.ask("frame => coframe.frames[frame].position", frame))


def click_on(page, frame):
    """Clicks where a frame is on the canvas, once the camera stands still."""
    before = None
    while before != (before := page.ask("frame => coframe.pixel(coframe.frames[frame].position)", frame)):
        page.raw.wait_for_timeout(200)
    x, y = before[:2]
    box = page.raw.locator("#canvas").bounding_box()
    page.raw.mouse.click(box["x"] + x, box["y"] + y)


def go(page, part):
    """To a part of the timeline, and waits until base is where it was then."""
    page.scrub(part)
    page.until("x => Math.abs(coframe.frames.base.position[0] - x) < 0.2", 10 * part)
    page.settle()


def test_two_clicks_measure_what_the_buffer_says(page):
    page.key("a")
    page.key("m")
    page.wait(lambda: "click the first frame" in page.text("#measured"), "the ruler")
    click_on(page, "base")
    page.wait(lambda: page.text("#measured").startswith("From base"), "the second click")
    click_on(page, "arm")
    number = rf"([{MINUS}\d.]+)"
    told = re.compile(rf"{number} m\s+Δx {number}\s+Δy {number}\s+Δz {number}")
    found = page.wait(lambda: told.fullmatch(page.text("#measured")), "a distance")
    distance, *along = (float(part.replace(MINUS, "-")) for part in found.groups())
    stamp = page.picture()[1]
    base, arm = (page.buffer.lookup("map", frame, stamp) for frame in ("base", "arm"))
    expected = arm.translation - base.translation
    np.testing.assert_allclose(along, expected, atol=0.0006)
    assert distance == pytest.approx(np.linalg.norm(expected), abs=0.0006)
    assert f"{distance:.3f} m" in page.texts("#labels .label")
    page.key("Escape")
    page.wait(lambda: not page.raw.locator("#measured").is_visible(), "its end")


def test_the_camera_keeps_its_distance_to_a_frame_that_it_follows(page):
    page.row("arm").locator(".name").click()
    page.key("f")
    page.wait(lambda: page.text("#overlay .hint:visible") == "Following arm", "a word on it")

    def away():
        camera = page.ask("coframe.camera")
        np.testing.assert_allclose(camera["target"], position(page, "arm"), atol=1e-3)
        return np.array(camera["position"]) - position(page, "arm")

    before, began = away(), position(page, "arm")
    for part in (0.5, 0.1):
        go(page, part)
        np.testing.assert_allclose(away(), before, atol=1e-3)
    assert np.linalg.norm(position(page, "arm") - began) > 5.0
    page.key("f")
    page.wait(lambda: not page.raw.locator("#overlay .hint:visible").count(), "its end")
    stays = page.ask("coframe.camera.position")
    go(page, 0.9)
    assert page.ask("coframe.camera.position") == stays


def test_from_above_y_is_up_and_height_does_not_matter(page):
    page.key("v")
    page.until("coframe.camera.mode === 'top'")
    page.key("a")
    camera = page.ask("coframe.camera")
    np.testing.assert_allclose(camera["position"][:2], camera["target"][:2], atol=1e-6)
    origin, right, up, high = np.array(page.ask("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2]].map(coframe.pixel)"))
    scale = right[0] - origin[0]
    assert scale > 10, "pixels a metre"
    np.testing.assert_allclose([right, up, high] - origin, [[scale, 0], [0, -scale], [0, 0]], atol=1e-2)
    page.row("base").locator(".name").click()
    click_on(page, "arm")
    page.until("document.querySelector('#panel .row[aria-selected=true]')?.dataset.frame === 'arm'")
    page.key("v")
    page.until("coframe.camera.mode === 'orbit'")
