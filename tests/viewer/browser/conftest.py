# SPDX-License-Identifier: Apache-2.0
"""Fixtures for tests in a real browser, with the real server and the running demo."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest
from chromium import chromium

import coframe

websockets = pytest.importorskip("websockets.sync.client", reason="the viewer needs websockets")
playwright = pytest.importorskip("playwright.sync_api", reason="the page is shown by Playwright")

SETTLING_TIMEOUT = 5.0  # seconds
TIMEOUT = 20.0  # seconds; the machine may be busy
START_TIMEOUT = 60.0  # seconds; processes and pages start at the same time
SECOND = 1_000_000_000
LAB_FRAMES = 11
# The test of the page that is in every run of the suite; the others take minutes.
ALWAYS = "test_drawn_poses_equal_buffer_lookups_for_any_fixed_frame"


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Leave the tests of this folder to `make test-browser`, except one."""
    for item in items:
        if item.path.parent == Path(__file__).parent and item.name != ALWAYS:
            item.add_marker("browser")


@pytest.fixture(scope="package")
def browser():
    """Start one Chromium for all tests of this folder; it ends with the last of them, as the demo does."""
    with chromium() as started:
        yield started


class Page:
    """A browser tab that shows the viewer."""

    def __init__(self, context, url):
        self.url = url
        self.errors = []
        self.foreign_urls = []
        context.route(_is_foreign, self._refuse)
        self.raw = context.new_page()
        self.raw.on("websocket", lambda socket: _is_foreign(socket.url) and self.foreign_urls.append(socket.url))
        self.raw.set_default_timeout(TIMEOUT * 1000)
        self.raw.on("console", self._record_error)
        self.raw.on("pageerror", lambda error: self.errors.append(str(error)))
        self.raw.goto(url, timeout=START_TIMEOUT * 1000)

    def _record_error(self, message):
        if message.type == "error":
            self.errors.append(message.text)

    def _refuse(self, route):
        self.foreign_urls.append(route.request.url)
        route.abort()

    def evaluate(self, script, argument=None):
        """Return the value of a JavaScript expression, or of a function of one argument."""
        return self.raw.evaluate(script, argument)

    def until(self, script, argument=None, timeout=TIMEOUT):
        """Wait until a JavaScript expression is true, and return its value."""
        return self.wait(lambda: self._evaluate_if_started(script, argument), script, timeout)

    def _evaluate_if_started(self, script, argument):
        try:
            return self.evaluate(script, argument)
        except playwright.Error as error:
            if "coframe is not defined" in str(error):  # A busy machine has not run the page's program yet.
                return None
            raise

    def wait(self, condition, what="a condition", timeout=TIMEOUT):
        """Wait until a Python function returns a true value, and return the value."""
        deadline = time.monotonic() + timeout
        while not (found := condition()):
            if time.monotonic() > deadline:
                raise AssertionError(
                    f"timed out waiting for {what}; notifications on the page: {self.text('#toasts')!r}"
                )
            self.raw.wait_for_timeout(30)
        return found

    def drawn(self):
        """Wait until frames are drawn, and return the page."""
        self.until(
            "window.coframe && coframe.updates > 0 && Object.keys(coframe.frames).length > 0", timeout=START_TIMEOUT
        )
        return self

    def shows(self, frame):
        """Wait until a frame is visible."""
        self.until("name => window.coframe?.frames[name]?.visible", frame)

    def click(self, selector):
        self.raw.click(selector)

    def key(self, key):
        self.raw.keyboard.press(key)

    def tab(self, name):
        self.raw.click(f"#tab-{name}")

    def text(self, selector):
        return self.raw.locator(selector).first.inner_text()

    def texts(self, selector):
        return self.raw.locator(selector).all_inner_texts()

    def row(self, frame):
        """Return the locator of the row of a frame."""
        return self.raw.locator(f"#panel .row[data-frame={json.dumps(frame)}]:visible")

    def rows(self):
        """Return the names in all visible rows of the tree."""
        return self.texts("#panel .row:visible .name")

    def drawn_frames(self):
        """Return the fixed frame, the stamp in nanoseconds and the poses of the drawn frames."""
        state = self.evaluate("({time: coframe.time, fixed: coframe.fixed, frames: coframe.frames})")
        return state["fixed"], self.origin() + round(state["time"]), state["frames"]

    def assert_equals_buffer(self, buffer, tolerance=1e-5):
        """Assert that the drawn poses equal lookups in a buffer at the same stamp, once all data has arrived."""
        deadline = time.monotonic() + SETTLING_TIMEOUT
        while True:
            fixed, stamp, frames = self.drawn_frames()
            try:
                for frame, drawn in frames.items():
                    expected = buffer.lookup(fixed, frame, stamp, timeout="5s")
                    np.testing.assert_allclose(drawn["position"], expected.translation, atol=tolerance, err_msg=frame)
                    assert abs(np.dot(drawn["quaternion"], expected.quaternion)) == pytest.approx(1.0, abs=1e-6), frame
            except AssertionError:
                if time.monotonic() > deadline:
                    raise
                self.raw.wait_for_timeout(100)
            else:
                return

    def origin(self):
        """Return the origin of the times on the page, from the `hello` of the server."""
        address = urlsplit(self.url)
        with websockets.connect(f"ws://{address.netloc}/ws", max_size=None) as socket:
            return int(json.loads(socket.recv(TIMEOUT))["origin"])

    def pause(self):
        """Pause, and wait until the frame update at the playhead is drawn."""
        self.key("Space")
        self.until("!coframe.live")
        self.settle()
        return self

    def settle(self):
        """Wait until the playhead stands still and its frame update is drawn."""
        self.until("coframe.settled")

    def scrub(self, part):
        """Click the timeline at a fraction of its length."""
        box = self.raw.locator("#timeline .scrub canvas").bounding_box()
        self.raw.mouse.click(box["x"] + part * box["width"], box["y"] + box["height"] / 2)

    def save_replay(self, file, seconds):
        """Save the last seconds as a replay, and return the URL of the file."""
        self.click("#bar button[title=Export]")
        self.click("text=Replay (HTML)")
        self.raw.fill("dialog input[aria-label='Seconds']", str(seconds))
        with self.raw.expect_download() as download:
            self.click("dialog button:text('Save')")
        download.value.save_as(file)
        return file.as_uri()

    def step(self, key, seconds):
        """Press a key that moves the playhead by the given number of seconds, and wait for it."""
        expected = self.evaluate("coframe.time") + seconds * SECOND
        self.key(key)
        self.until("time => Math.abs(coframe.time - time) < 1e3", expected)

    def seconds(self):
        """Return the time of the playhead in seconds."""
        return self.evaluate("coframe.time") / SECOND


@pytest.fixture(scope="package")
def shared_page(browser):
    """Return a function that opens a page for several tests, as a context manager; it must log no errors."""

    @contextlib.contextmanager
    def start(url):
        context = browser.new_context(viewport={"width": 1200, "height": 760})
        page = Page(context, url)
        yield page
        context.close()
        assert not page.foreign_urls
        assert not page.errors

    return start


@pytest.fixture
def open_page(browser) -> Iterator[object]:
    """Open pages, each in its own browser context, and check their requests and errors at the end of the test.

    A test fails if a page sends a request to another host, or logs an error that contains none of `expected_errors`.
    `relay` forwards the messages between page and server.
    """
    contexts, pages = [], []

    def start(url, *, expected_errors=(), width=1200, height=760, relay=None, **options):
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        contexts.append(context)
        if relay is not None:
            context.route_web_socket("**/ws", relay)
        pages.append((Page(context, url), expected_errors))
        return pages[-1][0]

    yield start
    foreign_urls = [url for page, _ in pages for url in page.foreign_urls]
    unexpected_errors = [
        error for page, expected in pages for error in page.errors if not any(text in error for text in expected)
    ]
    for context in contexts:
        context.close()
    assert not foreign_urls, "the page sent requests to another host"
    assert not unexpected_errors


def _is_foreign(url):
    return urlsplit(url).scheme not in {"data", "blob", "file"} and urlsplit(url).hostname != "127.0.0.1"


class Demo:
    """The running `coframe demo`, and a connection that receives its transforms."""

    def __init__(self, process, url, domain, ros):
        self.process, self.url, self.domain, self.ros = process, url, domain, ros


@pytest.fixture(scope="package")
def demo(tmp_path_factory, claim_domain) -> Iterator[Demo]:
    """Start one demo for all tests of this folder, in a domain that no other test uses."""
    pytest.importorskip("dds_library", reason="the demo uses DDS")
    with claim_domain() as domain:
        yield from _run_demo(tmp_path_factory, domain)


def _run_demo(tmp_path_factory, domain) -> Iterator[Demo]:
    output = tmp_path_factory.mktemp("demo") / "output"
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    command = [str(Path(sys.executable).with_name("coframe")), "demo", "--no-browser", "--port", "0"]
    with output.open("wb") as file:
        process = subprocess.Popen(command, stdout=file, stderr=file, env=environment)
    try:
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
            with coframe.connect("browser_test", domain=domain, cache="60s") as ros:
                yield Demo(process, _address(process, output), domain, ros)
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(TIMEOUT)


def _address(process, output):
    """Return the address, which the demo prints on its own line."""
    deadline = time.monotonic() + START_TIMEOUT
    while time.monotonic() < deadline and process.poll() is None:
        lines = output.read_text(errors="replace").splitlines()
        if found := [line for line in lines if line.startswith("http://127.0.0.1:")]:
            return found[0]
        time.sleep(0.02)
    raise AssertionError(f"the demo printed no address: {output.read_text(errors='replace')}")


@pytest.fixture
def lab(demo, open_page):
    """Open the page of the demo, and wait for all frames of the lab."""
    page = open_page(demo.url)
    page.until("n => window.coframe?.updates && Object.keys(coframe.frames).length === n", LAB_FRAMES)
    return page
