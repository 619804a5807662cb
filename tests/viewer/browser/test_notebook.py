# SPDX-License-Identifier: Apache-2.0
"""`show()` in notebooks: real kernels execute them, and a real browser draws what they contain."""

import html
import io
import json
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager, suppress
from types import SimpleNamespace

import notebooks
import numpy as np
import pytest
import recordings
from PIL import Image

import coframe
from coframe.viewer import _notebook as notebook
from coframe.viewer._notebook import choose_inline

sync_api = pytest.importorskip("playwright.sync_api", reason="the browser tests need playwright")

TIMEOUT = 60.0  # seconds
HOSTILE = "<img src=x onerror=alert(1)>"
# The Content-Security-Policy of VS Code's notebooks: pages of loopback servers are refused, and so are requests.
VS_CODE_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
    "img-src https: http: data:; connect-src https:; child-src https: data:"
)


def circling():
    buffer = coframe.Buffer(None)
    for i in range(21):
        angle = i / 10
        pose = coframe.Transform.from_rpy([np.cos(angle), np.sin(angle), 0.0], yaw=angle)
        buffer.set("odom", "base", pose, (10 + i) * 1_000_000_000)
    buffer.set("base", "lidar", coframe.Transform([0.3, 0.0, 0.5]), static=True)
    return buffer


def executed(*cells, folder):
    """Return the HTML that nbconvert makes of a notebook after a kernel has executed its cells."""
    document = notebooks.new_notebook(*cells)
    notebooks.execute(document, folder)
    return notebooks.exported(document)


def drawn_in(page, number=0):
    """Wait until the viewer in a frame of a page has drawn, and return this frame."""
    page.wait(lambda: len(page.raw.query_selector_all("iframe")) > number, "a frame")
    frame = page.raw.query_selector_all("iframe")[number].content_frame()
    ready = "() => window.coframe && coframe.updates > 0 && Object.keys(coframe.frames).length > 0"
    frame.wait_for_function(ready, timeout=TIMEOUT * 1000)
    return frame


def pixels(frame):
    """Return the colors of a frame's drawing as an array, (height, width, 3)."""
    image = Image.open(io.BytesIO(frame.frame_element().screenshot()))
    return np.asarray(image.convert("RGB")).astype(int)


def axes_in(image):
    """Return how many pixels are red, green and blue."""
    red, green, blue = image[..., 0], image[..., 1], image[..., 2]
    return [
        int(((a > 140) & (a > 1.8 * b) & (a > 1.8 * c)).sum())
        for a, b, c in ((red, green, blue), (green, red, blue), (blue, red, green * 0.9))
    ]


@pytest.fixture
def open_html(open_page, tmp_path):
    """Open HTML as a file, which has no server."""

    def start(text, **options):
        file = tmp_path / "page.html"
        file.write_text(f"<!doctype html><meta charset=utf-8>{text}", encoding="utf-8")
        return open_page(file.as_uri(), **options)

    return start


@pytest.mark.slow
def test_an_executed_notebook_contains_what_show_displays(open_html, tmp_path):
    recordings.write_mcap(tmp_path / "run.mcap")
    body = executed(
        "import coframe\nbuffer = coframe.Buffer()\n"
        "buffer.set('base', 'lidar', coframe.Transform([0.3, 0.0, 0.5]), static=True)\n"
        f"buffer.set('base', {HOSTILE!r}, coframe.Transform([0.0, 0.4, 0.0]), static=True)\nbuffer.show()",
        "recording = coframe.open_bag('run.mcap')\nrecording.show()",
        "coframe.Transform.from_rpy([[k, 0, 0] for k in range(3)], target='map', source='pose').show()",
        "import tf2_ros\ncoframe.show(tf2_ros.Buffer())",
        "buffer",
        "coframe.doctor.diagnose(next(iter(coframe.doctor.observe_recording('run.mcap').values())))",
        folder=tmp_path,
    )
    assert HOSTILE not in body
    page = open_html(body)
    static = drawn_in(page, 0)
    assert static.evaluate("coframe.frames.lidar.position") == pytest.approx([0.3, 0.0, 0.5])
    assert min(axes_in(pixels(static))) > 100, "the axes are drawn in red, green and blue"
    recorded = drawn_in(page, 1)
    assert recorded.evaluate("coframe.fixed") == "odom"
    last = recordings.expected().lookup("odom", "base").translation
    assert np.abs(recorded.evaluate("coframe.frames.base.position") - last).max() > 0.1, "it begins at the start"
    recorded.click("#timeline button >> nth=1")  # play
    # At 30 Hz, the replay ends up to a thirtieth of a second before the recording.
    near = "([x, y]) => Math.hypot(coframe.frames.base.position[0] - x, coframe.frames.base.position[1] - y) < 0.05"
    recorded.wait_for_function(near, arg=last[:2].tolist(), timeout=TIMEOUT * 1000)
    assert set(drawn_in(page, 2).evaluate("Object.keys(coframe.frames)")) == {"map", "pose_0", "pose_1", "pose_2"}


@pytest.mark.parametrize("surroundings", ["VS Code", pytest.param("sandbox", marks=pytest.mark.slow)])
def test_a_replay_is_drawn_where_loopback_and_storage_are_refused(view, open_html, surroundings):
    replay = view(circling(), inline="replay")._repr_html_()
    head = f'<meta http-equiv="Content-Security-Policy" content="{VS_CODE_POLICY}">'
    if surroundings == "sandbox":  # as in Colab, whose outputs have an origin of their own
        escaped = replay.replace("&", "&amp;").replace('"', "&quot;")
        page = open_html(f'<iframe sandbox="allow-scripts" width=1000 height=700 srcdoc="{escaped}"></iframe>')
        outer = page.raw.query_selector("iframe").content_frame()
        frame = outer.wait_for_selector("iframe").content_frame()
    else:
        page = open_html(head + replay)
        frame = page.raw.query_selector("iframe").content_frame()
    ready = "() => window.coframe && coframe.updates > 0 && coframe.frames.base"
    frame.wait_for_function(ready, timeout=TIMEOUT * 1000)
    assert frame.evaluate("coframe.frames.base.position") == pytest.approx([1.0, 0.0, 0.0])


@pytest.mark.slow
def test_jupyterlab_shows_the_running_viewer(open_page, tmp_path):
    """A real JupyterLab in a real browser: the frame is the running viewer, and it follows the buffer."""
    pytest.importorskip("jupyterlab", reason="this test runs JupyterLab")
    cells = [
        """
import coframe
buffer = coframe.Buffer()
buffer.set('map', 'base', coframe.Transform([1.0, 0.0, 0.0]), 1_000_000_000)
buffer.show(inline='viewer')""",
        "buffer.set('map', 'base', coframe.Transform([2.0, 0.0, 0.0]), 2_000_000_000)",
    ]
    live = notebooks.new_notebook(*cells)
    live.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebooks.package("nbformat").write(live, tmp_path / "live.ipynb")
    with jupyterlab(tmp_path) as url:
        page = open_page(url, expected_errors=("",))  # JupyterLab's own
        page.raw.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]", timeout=TIMEOUT * 1000)
        frame = run_first_cell(page).content_frame()
        frame.wait_for_function("() => window.coframe?.frames.base", timeout=TIMEOUT * 1000)
        assert frame.evaluate("coframe.frames.base.position") == pytest.approx([1.0, 0.0, 0.0])
        page.raw.click(".jp-Notebook .cm-content >> nth=1")
        page.key("Shift+Enter")
        frame.wait_for_function("() => coframe.frames.base.position[0] === 2", timeout=TIMEOUT * 1000)


def run_first_cell(page):
    """Run the first cell until its output is there: JupyterLab ignores keys while it is being drawn."""
    deadline = time.monotonic() + TIMEOUT
    while True:
        page.raw.click(".jp-Notebook .cm-content >> nth=0")
        page.key("Shift+Enter")
        with suppress(sync_api.TimeoutError):
            return page.raw.wait_for_selector("iframe[title='coframe viewer']", timeout=10_000)
        assert time.monotonic() < deadline, page.text(".jp-Notebook")


@contextmanager
def jupyterlab(folder):
    """Start JupyterLab, and return the address of the notebook `live.ipynb`."""
    environment = {
        **os.environ,
        "JUPYTER_RUNTIME_DIR": str(folder / "runtime"),
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTERLAB_SETTINGS_DIR": str(folder / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(folder / "workspaces"),
    }
    options = ["--no-browser", "--allow-root", "--ip=127.0.0.1", "--ServerApp.port=0", "--LabApp.news_url="]
    options += ["--IdentityProvider.token=test", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"]
    with (folder / "log").open("wb") as log:
        command = [sys.executable, "-m", "jupyterlab", *options]
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=log)
    try:
        deadline = time.monotonic() + TIMEOUT
        while not (files := list((folder / "runtime").glob("jpserver-*.json"))):
            assert process.poll() is None, (folder / "log").read_text()
            assert time.monotonic() < deadline, (folder / "log").read_text()
            time.sleep(0.1)
        yield f"{json.loads(files[0].read_text())['url']}lab/tree/live.ipynb?token=test"
    finally:
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGTERM)
        process.wait(TIMEOUT)


class Kernel:
    """What coframe asks IPython's kernel."""

    def __init__(self, *, allow_stdin):
        self.content = {"content": {"allow_stdin": allow_stdin}}

    def get_parent(self, _channel):
        return self.content


@pytest.mark.parametrize(
    ("variables", "allow_stdin", "container", "expected"),
    [
        ({}, True, False, "viewer"),
        ({}, False, False, "replay"),  # nbconvert
        ({}, True, True, "replay"),
        ({"COLAB_RELEASE_TAG": "1"}, True, False, "replay"),
        ({"VSCODE_PID": "1"}, True, False, "replay"),
        ({"SSH_CONNECTION": "1"}, True, False, "replay"),
        ({"JUPYTERHUB_SERVICE_PREFIX": "/"}, True, False, "replay"),
    ],
)
def test_what_is_displayed_depends_on_the_surroundings(
    monkeypatch, tmp_path, variables, allow_stdin, container, expected
):
    ipython = SimpleNamespace(get_ipython=lambda: SimpleNamespace(kernel=Kernel(allow_stdin=allow_stdin)))
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setattr(notebook, "_CONTAINER_FILES", [tmp_path] if container else [])
    assert choose_inline(variables) == expected


def test_options_and_limits(view, monkeypatch):
    buffer = circling()
    with pytest.raises(ValueError, match="not 'html'"):
        buffer.show(inline="html")
    with pytest.raises(coframe.ViewerError, match="1001 are more than 1000"):
        coframe.show(coframe.Transform(np.zeros((1001, 3))))
    viewer = view(buffer, inline="replay")
    monkeypatch.setattr(notebook, "MAX_INLINE_BYTES", 1000)
    assert "a notebook's output at most" in html.unescape(viewer._repr_html_())


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_a_replay_of_the_live_graph_contains_its_frames_and_messages(open_html):
    """The replay waits for the first message of each topic that it subscribes to."""
    pytest.importorskip("cyclonedds", reason="a live graph needs DDS")
    from geometry_msgs.msg import PoseStamped

    with coframe.connect("notebook_test") as ros:
        ros.buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), static=True)
        message = PoseStamped()
        message.header.frame_id = "map"
        goal = ros.publisher("/goal", PoseStamped)
        with ros.show(port=0, inline="replay") as viewer, publishing(goal, message):
            page = open_html(viewer._repr_html_())
        frame = drawn_in(page)
        assert frame.evaluate("coframe.frames.base.position") == pytest.approx([1.0, 0.0, 0.0])
        assert frame.evaluate("Object.keys(coframe.displays)")


@contextmanager
def publishing(publisher, message):
    """Publish a message repeatedly."""
    end = threading.Event()

    def publish():
        while not end.wait(0.05):
            publisher.publish(message)

    thread = threading.Thread(target=publish)
    thread.start()
    try:
        yield
    finally:
        end.set()
        thread.join()
