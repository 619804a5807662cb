# SPDX-License-Identifier: Apache-2.0
"""What the page shows when time jumps, the server stops, the network is cut, or a file has bad names."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import coframe
from coframe.messages import find

SECOND = 1_000_000_000
RVIZ = """
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/LaserScan, Name: Relative, Topic: {Value: scan}}
    - {Class: rviz_default_plugins/LaserScan, Name: Invalid, Topic: {Value: bad name}}
    - Class: rviz_common/Group
      Name: Cameras
      Enabled: false
      Displays:
        - {Class: rviz_default_plugins/LaserScan, Name: Hidden, Enabled: true, Topic: {Value: /scan}}
  Global Options: {Fixed Frame: odom}
"""
ROBOT = (
    "<robot name='box'><link name='base_link'><visual><geometry><box size='1 1 1'/></geometry></visual></link></robot>"
)


class Robot:
    """Publishes odom -> base_link at x = the stamp in seconds, and a scan."""

    def __init__(self, domain):
        self.ros = coframe.connect("robot", domain=domain)
        self.tf = self.ros.publisher("/tf", find("tf2_msgs/msg/TFMessage"))
        self.scans = self.ros.publisher("/scan", find("sensor_msgs/msg/LaserScan"))
        self.silent = False
        self._offset = 0
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self.start(1000)
        self._thread.start()

    def start(self, seconds):
        """Continue at another time."""
        self._offset = seconds * SECOND - time.monotonic_ns()

    def _run(self):
        while not self._ended.wait(0.04):
            if self.silent:
                continue
            now = self._offset + time.monotonic_ns()
            transform = find("geometry_msgs/msg/TransformStamped")(child_frame_id="base_link")
            scan = find("sensor_msgs/msg/LaserScan")(ranges=[1.0, 2.0], range_max=10.0)
            transform.header.frame_id, scan.header.frame_id = "odom", "base_link"
            for header in (transform.header, scan.header):
                header.stamp.sec, header.stamp.nanosec = divmod(now, SECOND)
            transform.transform.translation.x = now / SECOND
            self.tf.publish(find("tf2_msgs/msg/TFMessage")(transforms=[transform]))
            self.scans.publish(scan)

    def close(self):
        self._ended.set()
        self._thread.join()
        self.ros.close()


@pytest.fixture(scope="module")
def robot(claim_domain):
    pytest.importorskip("dds_library", reason="live sources need DDS")
    with pytest.MonkeyPatch.context() as patch, claim_domain() as domain:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        made = Robot(domain)
        made.domain = domain
        yield made
        made.close()


@pytest.fixture(scope="module")
def server(robot, tmp_path_factory):
    """Start `coframe view` with the configuration and the robot."""
    folder = tmp_path_factory.mktemp("view")
    (folder / "names.rviz").write_text(RVIZ)
    (folder / "box.urdf").write_text(ROBOT)
    command = [str(Path(sys.executable).with_name("coframe")), "view", "--no-browser", "--port", "0"]
    command += ["-d", str(folder / "names.rviz"), "--robot", str(folder / "box.urdf")]
    environment = {**os.environ, "ROS_DOMAIN_ID": str(robot.domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    with (folder / "errors").open("wb") as errors:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=errors, env=environment, text=True)
    try:
        process.url = process.stdout.readline().strip()
        process.errors = folder / "errors"
        yield process
    finally:
        process.send_signal(signal.SIGCONT)
        process.send_signal(signal.SIGINT)
        process.wait(20)
        process.stdout.close()


X = "coframe.frames.base_link?.position[0]"
PILL = "document.querySelector('#bar .pill').innerText.trim()"
CUT = ("WebSocket",)


def test_names_jumps_and_silence_are_shown(server, robot, open_page):
    page = open_page(server.url).drawn()
    page.until(f"{PILL} === 'Live'")
    page.until("coframe.displays.Relative.state === 'ok' && coframe.displays.Relative.messages.length > 0")
    page.until("coframe.displays.Invalid.state === 'error'")
    assert "'bad name' is not a valid topic name" in page.evaluate("coframe.displays.Invalid.text")
    assert page.evaluate("coframe.displays.Hidden.enabled") is False
    page.tab("displays")
    page.raw.get_by_label("Show the group Cameras").check()
    page.until("coframe.displays.Hidden.messages.length > 0")
    page.raw.get_by_label("Show the group Cameras").uncheck()
    page.until("!coframe.displays.Hidden.enabled")

    robot.start(500)
    page.until(f"{X} > 500 && {X} < 600")
    assert "jumped back by" in page.text("#toasts")
    page.until("coframe.displays.Relative.messages.length > 0")
    page.raw.click("#toasts .toast button")
    page.wait(lambda: page.raw.locator("#toasts .toast").count() == 0, "the dismissed notification")
    page.key("Shift+R")
    page.wait(lambda: "Reset." in page.text("#toasts"), "the notification of the reset")
    updates = page.evaluate("coframe.updates")
    page.until(f"{X} > 500 && coframe.updates > {updates} + 20")
    page.until("coframe.displays.Relative.state === 'ok' && coframe.displays.Relative.messages.length > 0")

    robot.silent = True
    page.until(f"{PILL}.startsWith('No data for')")
    page.until("coframe.displays.RobotModel.stale.includes('base_link')")
    assert "No transform received" in page.evaluate("coframe.displays.RobotModel.text")
    page.until("coframe.displays.Relative.text.startsWith('no message for')")
    page.tab("frames")
    page.wait(lambda: "0.0 Hz" in page.row("base_link").inner_text(), "the rate of a silent publisher")
    robot.silent = False
    page.until(f"{PILL} === 'Live'")
    page.until("coframe.displays.RobotModel.stale.length === 0 && coframe.displays.RobotModel.state === 'ok'")
    assert "Traceback" not in server.errors.read_text()


def test_a_stopped_server_is_noticed_within_three_seconds(server, open_page):
    page = open_page(server.url, expected_errors=CUT).drawn()
    page.until(f"{PILL} === 'Live'")
    server.send_signal(signal.SIGSTOP)
    stopped = time.monotonic()
    try:
        page.until(f"{PILL} === 'No response'")
        assert time.monotonic() - stopped < 3.5, "with half a second for a busy machine"
        assert "stopped responding" in page.text("#notice")
    finally:
        server.send_signal(signal.SIGCONT)
    page.until(f"{PILL} === 'Live'")
    page.until("coframe.displays.Relative.messages.length > 0")
    assert not page.raw.locator("#notice").is_visible()


@pytest.mark.slow
def test_a_cut_connection_is_replaced(server, open_page):
    """Nothing arrives in either direction, and nothing is closed, as with a cut cable."""
    cut = threading.Event()

    def relay(route):
        upstream = route.connect_to_server()
        route.on_message(lambda message: None if cut.is_set() else upstream.send(message))
        upstream.on_message(lambda message: None if cut.is_set() else route.send(message))

    page = open_page(server.url, expected_errors=CUT, relay=relay).drawn()
    page.until(f"{PILL} === 'Live'")
    cut.set()
    page.until(f"{PILL} === 'No response'")
    page.until(f"{PILL} === 'Not connected'")
    cut.clear()
    page.until(f"{PILL} === 'Live'")
    before = page.evaluate(X)
    page.until(f"{X} > {before}")
    page.until("coframe.displays.Relative.messages.length > 0")
