# SPDX-License-Identifier: Apache-2.0
"""Time travel by keys and mouse, at any speed, in live data and recordings."""

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


@pytest.fixture
def counted(view, open_page):
    """Open a page, paused at the end of ten seconds of a frame at x = 10 t, sampled at 10 Hz."""
    buffer = coframe.Buffer(None)
    for tenth in range(101):
        buffer.set("map", "base", coframe.Transform([tenth, 0.0, 0.0]), BEGIN + tenth * SECOND // 10)
    page = open_page(view(buffer, fixed="map").url).drawn()
    page.pause()
    page.until("coframe.frames.base.position[0] === 100")
    return page


def x_of(page):
    return page.evaluate("coframe.frames.base.position[0]")


def test_poses_of_five_seconds_ago_equal_the_buffer(lab, demo):
    lab.wait(lambda: timeline(lab)[0] > 6.5, "six seconds of data")

    def look_back():
        lab.scrub(1 - 5.0 / timeline(lab)[0])
        lab.settle()
        if not 4.0 < ago(lab) < 8.0:
            return False
        try:
            lab.assert_equals_buffer(demo.ros.buffer)
        except coframe.ExtrapolationException:  # The demo keeps ten seconds, and the machine may be busy.
            return False
        return True

    lab.wait(look_back, "poses of five seconds ago")
    then, arm = lab.seconds(), lab.evaluate("coframe.frames.end_effector.position")
    lab.key("l")
    lab.until("coframe.live")
    lab.until("time => coframe.time / 1e9 > time", then + 4.0)
    lab.wait(
        lambda: not np.allclose(lab.evaluate("coframe.frames.end_effector.position"), arm, atol=1e-3), "the arm to move"
    )
    assert lab.text("#bar .pill") == "Live"


def ago(page):
    """Return how many seconds the playhead is before the end of the timeline."""
    length, now = timeline(page)
    return length - now


def timeline(page):
    """Return the length of the timeline and the position of the playhead, in seconds."""
    slider = page.raw.locator("#timeline .scrub canvas")
    return float(slider.get_attribute("aria-valuemax") or 0), float(slider.get_attribute("aria-valuenow") or 0)


def test_the_mouse_scrubs_the_timeline(counted):
    counted.scrub(0.25)
    counted.until("Math.abs(coframe.frames.base.position[0] - 25) < 1")
    box = counted.raw.locator("#timeline .scrub canvas").bounding_box()
    counted.raw.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 5)
    counted.raw.mouse.down()
    counted.raw.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 5, steps=4)
    counted.until("Math.abs(coframe.frames.base.position[0] - 50) < 1")
    counted.raw.mouse.move(box["x"] - 500, box["y"] + 5)
    counted.until("coframe.frames.base.position[0] === 0")
    counted.raw.mouse.up()
    assert counted.text("#bar .pill") == "Paused"


def test_steps_go_from_message_to_message(counted):
    counted.scrub(0.501)
    counted.until("Math.abs(coframe.frames.base.position[0] - 50) < 1")
    counted.settle()
    start = np.floor(x_of(counted))
    for key, expected in ((".", start + 1), (".", start + 2), (",", start + 1)):
        counted.key(key)
        counted.until("x => Math.abs(coframe.frames.base.position[0] - x) < 1e-4", expected)


def test_quick_key_presses_all_have_an_effect(counted):
    for _ in range(4):
        counted.key("ArrowLeft")
    counted.until("Math.abs(coframe.frames.base.position[0] - 60) < 1e-4")
    for key in ("ArrowRight", "ArrowLeft", "ArrowLeft", "Space", "Space"):
        counted.key(key)
    counted.settle()
    assert 49.0 < x_of(counted) < 60.0, "playback continues from there"


def test_playback_has_a_speed_an_end_and_a_loop(counted):
    counted.raw.select_option("#timeline select", "0.25")
    counted.scrub(0.0)
    counted.until("coframe.frames.base.position[0] === 0")
    counted.key("Space")
    counted.until("coframe.frames.base.position[0] > 0")

    def speed():
        """Return how fast the time of the page goes on, measured for 1.5 s."""
        elapsed, played = counted.evaluate(
            """async () => {
                const begin = [performance.now(), coframe.time];
                await new Promise((done) => setTimeout(done, 1500));
                return [performance.now() - begin[0], (coframe.time - begin[1]) / 1e6];
            }"""
        )
        return played / elapsed

    # A busy machine draws some frames late.
    assert any(speed() == pytest.approx(0.25, rel=0.35) for _ in range(8))
    assert counted.text("#bar .pill") == "Playing"
    counted.raw.select_option("#timeline select", "5")
    counted.until("coframe.frames.base.position[0] === 100")
    counted.key("o")
    counted.until("coframe.frames.base.position[0] < 50")
    assert counted.raw.get_attribute("#timeline button[title^='Loop']", "aria-pressed") == "true"


def test_gaps_are_marked_in_the_rates_over_time(view, open_page):
    buffer = coframe.Buffer(None)
    for tenth in [*range(40), *range(70, 101)]:
        buffer.set("map", "base", coframe.Transform([tenth, 0.0, 0.0]), BEGIN + tenth * SECOND // 10)
    page = open_page(view(buffer).url).drawn()
    page.key("t")

    def painted(part):
        """Return the colors in a column of the canvas with the rates."""
        return page.evaluate(
            """part => {
                const canvas = document.querySelector('#timeline .sparklines canvas');
                if (!canvas.width || !canvas.height) return 0;
                const x = Math.floor(part * canvas.width);
                const pixels = canvas.getContext('2d').getImageData(x, 0, 1, canvas.height).data;
                let colors = new Set();
                for (let i = 0; i < pixels.length; i += 4)
                    if (pixels[i + 3]) colors.add(pixels.slice(i, i + 3).join());
                return [...colors].sort().join(' ');
            }""",
            part,
        )

    page.wait(lambda: painted(0.4) and painted(0.4) != painted(0.6), "a gap that differs from data")


def test_a_recording_starts_paused_and_can_be_viewed_at_any_time(shared, view, open_page):
    pytest.importorskip("rosbags", reason="recordings need rosbags")
    with coframe.open_bag(shared / "recordings" / "tb3_gazebo_walker") as recording:
        page = open_page(view(recording, fixed="odom").url).drawn()
        assert page.text("#bar .pill") == "Paused"
        assert page.raw.locator("#timeline button:text('Live')").is_hidden()
        first, last = recording.span
        page.settle()
        assert page.drawn_frames()[1] == first
        for part in (0.3, 0.8):
            page.scrub(part)
            page.until("time => Math.abs(coframe.time - time) < 1e8", first + part * (last - first) - page.origin())
            page.settle()
            page.assert_equals_buffer(recording.buffer)
        page.key("Space")
        page.until("time => coframe.time > time", page.evaluate("coframe.time"))


def test_the_timeline_zooms_goes_to_times_and_keeps_bookmarks(counted):
    page = counted
    page.click("#time")
    page.raw.fill("dialog.times input[aria-label=Time]", "4.5")
    page.raw.press("dialog.times input[aria-label=Time]", "Enter")
    page.until("Math.abs(coframe.frames.base.position[0] - 45) < 0.1")
    page.key("y")
    page.raw.fill("dialog.times input[aria-label=Time]", "soon")
    page.raw.press("dialog.times input[aria-label=Time]", "Enter")
    page.wait(lambda: "is not a time" in page.text("#toasts"), "the reason")
    page.raw.fill("dialog.times input[aria-label='Name of the bookmark']", "spike")
    page.raw.press("dialog.times input[aria-label='Name of the bookmark']", "Enter")
    page.wait(lambda: page.texts("#bookmarks button:text('spike')"), "the bookmark")
    page.key("Escape")

    # Around 4.5 s, zoomed in by 1.25 ** 10, the timeline shows a tenth of its span.
    box = page.raw.locator("#timeline .scrub canvas").bounding_box()
    page.raw.mouse.move(box["x"] + 0.45 * box["width"], box["y"] + box["height"] / 2)
    for _ in range(10):
        page.raw.mouse.wheel(0, -100)
    page.raw.wait_for_timeout(100)
    page.scrub(0.98)
    page.settle()
    assert 48 < x_of(page) < 52, "a click moves by less than a second"
    page.key("y")
    page.click("#bookmarks button:text('spike')")
    page.until("Math.abs(coframe.frames.base.position[0] - 45) < 0.1")
    page.raw.mouse.dblclick(box["x"] + 0.1 * box["width"], box["y"] + box["height"] / 2)
    page.scrub(0.98)
    page.until("coframe.frames.base.position[0] > 95")
