"""Back and forth in time: by keys, by the mouse, at any speed, live and in recordings."""

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


@pytest.fixture
def counted(view, open_page):
    """A frame that is at x = 10 t for ten seconds, sampled ten times a second; seen at the start, paused."""
    buffer = coframe.Buffer(None)
    for tenth in range(101):
        buffer.set("map", "base", coframe.Transform([tenth, 0.0, 0.0]), BEGIN + tenth * SECOND // 10)
    page = open_page(view(buffer, fixed="map").url).drawn()
    page.pause()
    page.until("coframe.frames.base.position[0] === 100")
    return page


def x_of(page):
    return page.ask("coframe.frames.base.position[0]")


def test_five_seconds_ago_the_demo_was_where_the_buffer_says(lab, demo):
    lab.wait(lambda: timeline(lab)[0] > 6.5, "six seconds of data")

    def look_back():
        lab.scrub(1 - 5.0 / timeline(lab)[0])
        lab.settle()
        return 4.0 < ago(lab) < 8.0  # the demo remembers ten seconds, and a busy machine takes its time

    lab.wait(look_back, "five seconds ago")
    lab.assert_like(demo.ros.buffer)
    then, arm = lab.seconds(), lab.ask("coframe.frames.end_effector.position")
    lab.key("l")
    lab.until("coframe.live")
    lab.until("time => coframe.time / 1e9 > time", then + 4.0)
    lab.wait(lambda: not np.allclose(lab.ask("coframe.frames.end_effector.position"), arm, atol=1e-3), "the arm")
    assert lab.text("#bar .pill") == "Live"


def ago(page):
    """How long before the timeline's end the playhead stands, in seconds."""
    length, now = timeline(page)
    return length - now


def timeline(page):
    """How long it is, and where the playhead stands, in seconds."""
    slider = page.raw.locator("#timeline .scrub canvas")
    return float(slider.get_attribute("aria-valuemax") or 0), float(slider.get_attribute("aria-valuenow") or 0)


def test_the_mouse_scrubs(counted):
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


def test_keys_that_are_pressed_quickly_all_count(counted):
    for _ in range(4):
        counted.key("ArrowLeft")
    counted.until("Math.abs(coframe.frames.base.position[0] - 60) < 1e-4")
    for key in ("ArrowRight", "ArrowLeft", "ArrowLeft", "Space", "Space"):
        counted.key(key)
    counted.settle()
    assert 49.0 < x_of(counted) < 60.0, "playing goes on from there"


def test_playing_has_a_speed_an_end_and_a_loop(counted):
    counted.raw.select_option("#timeline select", "0.25")
    counted.scrub(0.0)
    counted.until("coframe.frames.base.position[0] === 0")
    counted.key("Space")
    took, went = counted.ask(
        """async () => {
            const begin = [performance.now(), coframe.time];
            await new Promise((done) => setTimeout(done, 1500));
            return [performance.now() - begin[0], (coframe.time - begin[1]) / 1e6];
        }"""
    )
    assert went / took == pytest.approx(0.25, rel=0.35)
    assert counted.text("#bar .pill") == "Playing"
    counted.raw.select_option("#timeline select", "5")
    counted.until("coframe.frames.base.position[0] === 100")
    counted.key("o")
    counted.until("coframe.frames.base.position[0] < 50")
    assert counted.raw.get_attribute("#timeline button[title^='Loop']", "aria-pressed") == "true"


def test_gaps_and_rates_are_told_over_the_timeline(view, open_page):
    buffer = coframe.Buffer(None)
    for tenth in [*range(40), *range(70, 101)]:
        buffer.set("map", "base", coframe.Transform([tenth, 0.0, 0.0]), BEGIN + tenth * SECOND // 10)
    page = open_page(view(buffer).url).drawn()
    page.key("t")

    def painted(part):
        """Which share of a column of the rows' canvas has something in it."""
        return page.ask(
            """part => {
                const canvas = document.querySelector('#timeline .sparks canvas');
                if (!canvas.width || !canvas.height) return 0;
                const x = Math.floor(part * canvas.width);
                const pixels = canvas.getContext('2d').getImageData(x, 0, 1, canvas.height).data;
                let colours = new Set();
                for (let i = 0; i < pixels.length; i += 4)
                    if (pixels[i + 3]) colours.add(pixels.slice(i, i + 3).join());
                return [...colours].sort().join(' ');
            }""",
            part,
        )

    page.wait(lambda: painted(0.4) and painted(0.4) != painted(0.6), "a gap that looks other than data")


def test_a_recording_is_seen_from_its_start_and_at_any_time(shared, view, open_page):
    pytest.importorskip("rosbags", reason="recordings need rosbags")
    with coframe.open_bag(shared / "recordings" / "tb3_gazebo_walker") as recording:
        page = open_page(view(recording, fixed="odom").url).drawn()
        assert page.text("#bar .pill") == "Paused"
        assert page.raw.locator("#timeline button:text('Live')").is_hidden()
        first, last = recording.span
        page.settle()
        assert page.picture()[1] == first
        for part in (0.3, 0.8):
            page.scrub(part)
            page.until("time => Math.abs(coframe.time - time) < 1e8", first + part * (last - first) - page.origin())
            page.settle()
            page.assert_like(recording.buffer)
        page.key("Space")
        page.until("time => coframe.time > time", page.ask("coframe.time"))
