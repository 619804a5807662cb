# SPDX-License-Identifier: Apache-2.0
"""The page: exports, layout, shortcuts, and its behavior without a server."""

import base64
import struct
from urllib.parse import urlsplit

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


def counted_buffer():
    """Return a buffer with ten seconds of a frame at x = 10 t."""
    buffer = coframe.Buffer(None)
    for tenth in range(101):
        buffer.set("map", "base", coframe.Transform([tenth, 0.0, 0.0]), BEGIN + tenth * SECOND // 10)
    buffer.set("base", "lidar", coframe.Transform([0.0, 0.0, 1.0]), static=True)
    return buffer


@pytest.mark.slow
def test_a_replay_plays_from_disk_without_a_network(view, open_page, tmp_path):
    page = open_page(view(counted_buffer(), fixed="map").url).drawn()
    replay = open_page(page.save_replay(tmp_path / "replay.html", 8), offline=True).drawn()
    assert replay.text("#bar .pill") == "Replay"
    assert set(replay.rows()) == {"map", "base", "lidar"}
    x = "coframe.frames.base.position[0]"
    assert replay.evaluate(x) == pytest.approx(20.0)
    replay.key("Space")
    replay.until(f"{x} > 21")
    replay.key("Space")
    for part, expected in ((0.5, 60.0), (0.01, 20.8), (0.99, 99.2)):
        replay.scrub(part)
        replay.until(f"x => Math.abs({x} - x) < 1.5", expected)
    assert replay.evaluate("coframe.frames.lidar.position[2]") == pytest.approx(1.0)
    replay.row("lidar").locator(".name").click()
    replay.raw.select_option("#inspector select", "base")
    replay.wait(lambda: replay.text("#distance") == "1.000 m", "relative poses without a server")


def test_a_saved_image_contains_axes_and_labels(view, open_page):
    buffer = coframe.Buffer(None)
    buffer.set("map", "lidar", coframe.Transform([0.3, 0.0, 0.0]), BEGIN)
    page = open_page(view(buffer, fixed="map").url).drawn()
    page.wait(lambda: "lidar" in page.texts("#labels .label"), "labels")
    with page.raw.expect_download() as download:
        page.key("s")
    data = download.value.path().read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", data[16:24])
    box = page.raw.locator("#canvas").bounding_box()
    assert (width, height) == (round(box["width"]), round(box["height"]))
    colors = page.evaluate(
        """async data => {
            const image = new Image();
            image.src = 'data:image/png;base64,' + data;
            await image.decode();
            const canvas = document.createElement('canvas');
            [canvas.width, canvas.height] = [image.width, image.height];
            const context = canvas.getContext('2d');
            context.drawImage(image, 0, 0);
            const pixels = context.getImageData(0, 0, image.width, image.height).data;
            const counts = {red: 0, green: 0, blue: 0};
            for (let i = 0; i < pixels.length; i += 4) {
                const [r, g, b] = pixels.slice(i, i + 3);
                if (r > 150 && g < 110 && b < 110) counts.red++;
                if (g > 120 && r < 110 && b < 140) counts.green++;
                if (b > 150 && r < 120) counts.blue++;
            }
            return counts;
        }""",
        base64.b64encode(data).decode(),
    )
    assert min(colors.values()) > 20, f"axes in red, green and blue: {colors}"
    assert download.value.suggested_filename.endswith(".png")


def test_the_page_fits_a_phone(view, open_page):
    page = open_page(view(counted_buffer()).url, width=390, height=760, has_touch=True, is_mobile=True).drawn()
    assert page.evaluate(
        "document.documentElement.scrollWidth <= innerWidth && document.body.scrollHeight <= innerHeight"
    )
    canvas = page.raw.locator("#canvas").bounding_box()
    assert canvas["width"] == 390
    assert canvas["height"] > 380
    assert not page.raw.locator("#panel .row").first.is_visible()
    page.raw.tap("#bar button[title^='Show or hide the panel']")
    page.wait(lambda: page.row("lidar").is_visible(), "the panel")
    page.row("lidar").locator(".name").tap()
    page.wait(lambda: page.raw.locator("#distance").is_visible(), "the inspector")
    for selector in ("#timeline button[aria-label=Pause]", "#fixed", "#bar .pill"):
        box = page.raw.locator(selector).bounding_box()
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390


def test_a_phone_shows_names_completely(view, open_page):
    buffer = coframe.Buffer(None)
    for number in range(8):
        pose = coframe.Transform([0.3 * np.cos(number), 0.3 * np.sin(number), 0.1 * number])
        buffer.set("base", f"camera_{number}_optical_frame", pose, static=True)
    page = open_page(view(buffer, fixed="base").url, width=390, height=760, has_touch=True, is_mobile=True).drawn()
    right_ends = "[...document.querySelectorAll('#labels .label')].map((label) => label.getBoundingClientRect().right)"
    page.until(f"{right_ends}.length > 3")
    assert max(page.evaluate(right_ends)) <= 390


def test_dark_light_and_layout_are_remembered(view, open_page):
    page = open_page(view(counted_buffer()).url, color_scheme="dark").drawn()
    background = "getComputedStyle(document.body).backgroundColor"
    theme = "document.documentElement.dataset.theme"
    assert page.evaluate(theme) == "dark"
    dark = page.evaluate(background)
    page.key("d")
    page.until(f"{theme} === 'light' && {background} !== '{dark}'")
    page.tab("displays")
    page.raw.reload()
    page.drawn()
    assert page.evaluate(theme) == "light"
    assert page.raw.locator("#body-displays").is_visible()


def test_the_help_dialog_lists_the_keys_and_they_work(view, open_page):
    page = open_page(view(counted_buffer()).url).drawn()
    page.key("?")
    page.wait(lambda: page.raw.locator("dialog[open]").is_visible(), "the help dialog")
    listed = set(page.texts("dialog[open] .key"))
    assert {"Space", "l", ",", ".", "v", "f", "m", "/", "d", "s", "?", "Esc"} <= listed
    page.key("Escape")
    page.wait(lambda: not page.raw.locator("dialog[open]").is_visible(), "the closed dialog")
    page.click("#bar button[title=Export]")
    page.click("text=Replay (HTML)")
    page.key("Escape")
    page.wait(lambda: not page.raw.locator("dialog[open]").is_visible(), "the closed replay dialog")
    page.key("m")
    page.wait(lambda: "click the first frame" in page.text("#measured"), "the instruction to measure")
    page.key("v")
    assert page.raw.get_attribute("#overlay button:text('Top')", "aria-pressed") == "true"


def test_without_transforms_the_page_shows_instructions(view, open_page):
    buffer = coframe.Buffer(None)
    page = open_page(view(buffer).url)
    page.wait(lambda: page.raw.locator("#overlay .empty-scene").is_visible(), "the instructions")
    assert "No transforms yet" in page.text("#overlay .empty-scene")
    assert "coframe demo" in page.text("#overlay .empty-scene")
    page.raw.locator("#overlay .empty-scene").get_by_role("button", name="Close").click()
    assert page.raw.locator("#overlay .empty-scene").is_hidden(), "they can cover an image"
    page.raw.reload()
    page.wait(lambda: page.raw.locator("#overlay .empty-scene").is_visible(), "the instructions of a new session")
    buffer.set("map", "base", coframe.Transform(), BEGIN)
    page.shows("base")
    page.wait(lambda: not page.raw.locator("#overlay .empty-scene").is_visible(), "the hidden instructions")
    check_lost_graphics(page)


def check_lost_graphics(page):
    """The browser takes the graphics card away, for example after a crash of its driver, and gives it back."""
    context = "document.querySelector('#canvas').getContext('webgl2')"
    page.evaluate(f"window.graphics = {context}.getExtension('WEBGL_lose_context'), graphics.loseContext()")
    page.wait(lambda: "graphics card" in page.text("#notice"), "the notice")
    page.evaluate("graphics.restoreContext()")
    page.wait(lambda: page.raw.locator("#notice").is_hidden(), "the end of the notice")
    before = page.evaluate("coframe.updates")
    page.key("a")
    page.until("before => coframe.updates > before", before)


def test_the_page_reconnects_after_a_server_restart(open_page):
    viewer = coframe.show(counted_buffer(), port=0)
    port = urlsplit(viewer.url).port
    page = open_page(viewer.url, expected_errors=["WebSocket connection to", "ERR_CONNECTION_REFUSED"]).drawn()
    viewer.close()
    page.wait(lambda: page.text("#bar .pill") == "Not connected", "the state")
    page.wait(lambda: "connection to the server is lost" in page.text("#notice"), "the notice")
    buffer = counted_buffer()
    buffer.set("map", "dock", coframe.Transform([0.0, 3.0, 0.0]), static=True)
    with coframe.show(buffer, port=port):
        page.shows("dock")
        assert page.text("#bar .pill") == "Live"
        assert not page.raw.locator("#notice").is_visible()


def test_the_page_requests_only_its_own_files(view, open_page):
    page = open_page(view(counted_buffer()).url).drawn()
    requested = page.evaluate("performance.getEntriesByType('resource').map((one) => new URL(one.name).pathname)")
    assert set(requested) <= {"/assets/viewer.js", "/assets/page.js", "/assets/viewer.css"}
    assert page.evaluate("fetch('http://192.0.2.1/').then(() => 'reached', () => 'blocked')") == "blocked"
    page.errors.clear()  # caused by this request
