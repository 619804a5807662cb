# SPDX-License-Identifier: Apache-2.0
"""The examples that draw in the viewer's scene do what they promise to a user who clicks and moves sliders."""

import queue
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[3] / "examples"
TIMEOUT = 60.0  # seconds


class Program:
    """A running example."""

    def __init__(self, name):
        command = [sys.executable, EXAMPLES / name]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self._lines = queue.Queue()
        threading.Thread(target=lambda: [self._lines.put(line) for line in self.process.stdout], daemon=True).start()
        self.url = re.search(r"http://\S+", self.line())[0]

    def line(self):
        """Return the next line of the output."""
        return self._lines.get(timeout=TIMEOUT).strip()


@pytest.fixture
def start():
    """Start examples, and check that Ctrl-C ends them."""
    started = []

    def run(name):
        started.append(Program(name))
        return started[-1]

    yield run
    for program in started:
        program.process.send_signal(signal.SIGINT)
        assert program.process.wait(TIMEOUT) == 0, program.process.stderr.read()
        program.process.stdout.close()
        program.process.stderr.close()


def click_at(page, point):
    x, y = page.evaluate("(point) => coframe.pixel(point)", point)
    page.raw.locator("#canvas").click(position={"x": x, "y": y})


def test_two_clicks_on_the_cloud_give_their_distance(start, open_page):
    program = start("10_click_to_measure.py")
    page = open_page(program.url).drawn()
    page.until("coframe.nodes.cloud?.visible")
    page.key("a")
    # The wall ahead is at x = 3 in the map; the points have a distance of 0.05 m.
    click_at(page, [3.0, 0.0, 1.5])
    page.until("coframe.nodes['measure/1']?.visible")
    click_at(page, [3.0, -1.0, 1.5])
    assert program.line() == "1.00 m"
    page.until("coframe.nodes['measure/line']?.visible && coframe.nodes['measure/distance']?.visible")
    click_at(page, [3.0, 1.0, 1.5])
    page.until("!coframe.nodes['measure/line'] && coframe.nodes['measure/1']?.center[1] > 0.9")


def test_the_cloud_follows_the_sliders_of_the_mount(start, open_page):
    program = start("11_calibration_sliders.py")
    page = open_page(program.url).drawn()
    page.until("coframe.nodes.cloud?.visible && coframe.nodes.cloud.size[2] > 0.5")  # tilted
    page.raw.locator("[data-label='Pitch (rad)'] input[type=range]").fill("0.35")
    page.until("coframe.nodes.cloud.size[2] < 0.01 && Math.abs(coframe.nodes.cloud.center[2]) < 0.01")
    page.until("document.querySelector('[data-kind=text] input').value === '0.000 m'")
    page.click("[data-kind=button] button")
    assert program.line() == "camera_link: height 0.80 m, pitch 0.35 rad, 0.000 m"


def test_clicks_on_the_floor_make_a_route(start, open_page):
    program = start("12_record_a_route.py")
    page = open_page(program.url).drawn()
    page.until("coframe.nodes.floor?.visible")
    page.key("v")
    page.key("a")
    for point, count in (([1.0, 1.0, 0.0], 1), ([-1.0, 1.0, 0.0], 2), ([-1.0, -1.0, 0.0], 3)):
        page.raw.wait_for_timeout(350)  # two clicks within this time would be a double-click
        click_at(page, point)
        page.until(f"coframe.nodes['route/{count}']?.visible")
    page.until("document.querySelector('[data-label=Length] input').value.startsWith('4.0')")
    page.click("[data-kind=button] button:text('Undo')")
    page.until("!coframe.nodes['route/3']")
    page.click("[data-kind=button] button:text('Print the route')")
    assert program.line().startswith("(1.0, 1.0) -> (-1.0, 1.0): ")


def test_the_plot_and_the_robot_follow_the_gain(start, open_page):
    program = start("13_tune_a_controller.py")
    page = open_page(program.url).drawn()
    curve = "document.querySelector('[data-kind=plot] path[data-curve=robot]')?.getAttribute('d')"
    before = page.until(curve)
    page.until("document.querySelector('[data-label=Overshoot] input').value > '1'")
    page.raw.locator("[data-label=Damping] input[type=range]").fill("20")
    page.until("document.querySelector('[data-label=Overshoot] input').value === '0 %'")
    page.until(f"before => {curve} !== before", before)
    page.until("Math.abs(coframe.frames.robot.position[0] - 1) < 0.2")


def test_a_click_on_a_detection_shows_its_image_and_label(start, open_page):
    program = start("14_label_detections.py")
    page = open_page(program.url).drawn()
    picture = "document.querySelector('[data-kind=image] img')"
    page.until("coframe.nodes['detection/2']?.visible")
    page.until(f"{picture}?.naturalWidth === 64 && {picture}.naturalHeight === 48")
    before = page.evaluate(f"{picture}.src")
    page.key("a")
    click_at(page, page.evaluate("coframe.nodes['detection/2'].center"))
    page.until(f"before => {picture}.src !== before", before)
    page.raw.select_option("[data-label=Label] select", "person")
    assert program.line() == "unknown, unknown, person"
