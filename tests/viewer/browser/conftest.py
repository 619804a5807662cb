"""A real browser, the real server, the running demo: what a person sees, asked of the page itself."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest

import coframe

sync_api = pytest.importorskip(
    "playwright.sync_api", reason="the browser tests need playwright: pip install playwright"
)
websockets = pytest.importorskip("websockets.sync.client", reason="the viewer needs websockets")

SETTLING = 5.0  # seconds
PATIENCE = 20.0  # seconds; two cores that others use too
START_PATIENCE = 60.0  # of a process that starts beside a browser that starts
SECOND = 1_000_000_000
LAB_FRAMES = 11
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# No sandbox: tests may be run by root. Pictures are drawn in software, and the browser asks nobody for anything.
ARGUMENTS = [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
]


@pytest.fixture(scope="session")
def browser():
    """Debian's Chromium, one for all tests."""
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        pytest.skip("no browser: apt-get install chromium")
    with sync_api.sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=ARGUMENTS)
        yield chromium
        chromium.close()


class Page:
    """A tab with the viewer in it."""

    def __init__(self, context, url):
        self.url = url
        self.errors = []
        self.strangers = []
        context.route(_is_foreign, self._refuse)
        self.raw = context.new_page()
        self.raw.on("websocket", lambda socket: _is_foreign(socket.url) and self.strangers.append(socket.url))
        self.raw.set_default_timeout(PATIENCE * 1000)
        self.raw.on("console", self._hear)
        self.raw.on("pageerror", lambda error: self.errors.append(str(error)))
        self.raw.goto(url)

    def _hear(self, message):
        if message.type == "error":
            self.errors.append(message.text)

    def _refuse(self, route):
        self.strangers.append(route.request.url)
        route.abort()

    def ask(self, script, argument=None):
        """The value of a JavaScript expression, or of a function of one argument."""
        return self.raw.evaluate(script, argument)

    def until(self, script, argument=None):
        """The value once it is true."""
        return self.wait(lambda: self.ask(script, argument), script)

    def wait(self, condition, what="a condition"):
        """What a function of no arguments answers once that is true."""
        deadline = time.monotonic() + PATIENCE
        while not (found := condition()):
            if time.monotonic() > deadline:
                raise AssertionError(f"waited in vain for {what}; on the page: {self.text('#toasts')!r}")
            self.raw.wait_for_timeout(30)
        return found

    def drawn(self):
        """Waits for the first picture with frames in it."""
        self.until("window.coframe && coframe.ticks > 0 && Object.keys(coframe.frames).length > 0")
        return self

    def shows(self, frame):
        """Waits until a frame is drawn."""
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
        """A frame's row in the tree."""
        return self.raw.locator(f"#panel .row[data-frame={json.dumps(frame)}]:visible")

    def rows(self):
        """The names of all rows in the tree."""
        return self.texts("#panel .row:visible .name")

    def picture(self):
        """Frames as they are drawn, and their stamp in nanoseconds."""
        told = self.ask("({time: coframe.time, fixed: coframe.fixed, frames: coframe.frames})")
        return told["fixed"], self.origin() + round(told["time"]), told["frames"]

    def assert_like(self, buffer, tolerance=1e-5):
        """What is drawn is what a buffer answers for the same moment, once all of it has come."""
        deadline = time.monotonic() + SETTLING
        while True:
            fixed, stamp, frames = self.picture()
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
        """What times on the page are relative to, as the server tells all of its tabs."""
        address = urlsplit(self.url)
        with websockets.connect(f"ws://{address.netloc}/ws", max_size=None) as socket:
            return int(json.loads(socket.recv(PATIENCE))["origin"])

    def pause(self):
        """Stops, and waits until the last picture before that has passed."""
        self.key("Space")
        self.until("!coframe.live")
        self.settle()
        return self

    def settle(self):
        """Waits until what was asked for is drawn, and the playhead stands still."""
        self.until("coframe.settled")

    def scrub(self, part):
        """Presses the mouse on the timeline, a part of the way from its start."""
        box = self.raw.locator("#timeline .scrub canvas").bounding_box()
        self.raw.mouse.click(box["x"] + part * box["width"], box["y"] + box["height"] / 2)

    def save_replay(self, file, seconds):
        """Saves the last seconds as a file."""
        self.click("#bar button[title=Export]")
        self.click("text=Replay (HTML)")
        self.raw.fill("dialog input[aria-label='Seconds']", str(seconds))
        with self.raw.expect_download() as download:
            self.click("dialog button:text('Save')")
        download.value.save_as(file)
        return file.as_uri()

    def step(self, key, seconds):
        """Presses a key that moves the playhead by so much."""
        wanted = self.ask("coframe.time") + seconds * SECOND
        self.key(key)
        self.until("time => Math.abs(coframe.time - time) < 1e3", wanted)

    def seconds(self):
        """The playhead."""
        return self.ask("coframe.time") / SECOND


@pytest.fixture
def open_page(browser) -> Iterator[object]:
    """Opens a page in a context of its own. Fails where it asks another machine, or has something to complain of.

    What is expected to be complained of is told by a part of its text; `relay` stands between page and server.
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
    strangers = [url for page, _ in pages for url in page.strangers]
    complaints = [
        error for page, expected in pages for error in page.errors if not any(text in error for text in expected)
    ]
    for context in contexts:
        context.close()
    assert not strangers, "the page asked another machine"
    assert not complaints


def _is_foreign(url):
    return urlsplit(url).scheme not in {"data", "blob", "file"} and urlsplit(url).hostname != "127.0.0.1"


class Demo:
    """The running `coframe demo`, and a connection that hears what it says."""

    def __init__(self, process, url, domain, ros):
        self.process, self.url, self.domain, self.ros = process, url, domain, ros


@pytest.fixture(scope="session")
def demo(tmp_path_factory) -> Iterator[Demo]:
    """One demo for all tests, in a domain that no other test takes."""
    pytest.importorskip("cyclonedds", reason="the demo speaks over DDS")
    worker = os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw")
    domain = 201 + (os.getppid() + int(worker)) % 9
    output = tmp_path_factory.mktemp("demo") / "output"
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    command = [str(Path(sys.executable).with_name("coframe")), "demo", "--no-browser", "--port", "0"]
    with output.open("wb") as file:
        process = subprocess.Popen(command, stdout=file, stderr=file, env=environment)
    try:
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
            with coframe.connect("browser_test", domain=domain) as ros:
                yield Demo(process, _address(process, output), domain, ros)
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE)


def _address(process, output):
    """The line of its own with the address."""
    deadline = time.monotonic() + START_PATIENCE
    while time.monotonic() < deadline and process.poll() is None:
        lines = output.read_text(errors="replace").splitlines()
        if found := [line for line in lines if line.startswith("http://127.0.0.1:")]:
            return found[0]
        time.sleep(0.02)
    raise AssertionError(f"no address was printed: {output.read_text(errors='replace')}")


@pytest.fixture
def lab(demo, open_page):
    """The demo's page with all of the lab's frames."""
    page = open_page(demo.url)
    page.until("n => window.coframe?.ticks && Object.keys(coframe.frames).length === n", LAB_FRAMES)
    return page
