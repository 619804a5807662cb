# SPDX-License-Identifier: Apache-2.0
"""The documentation site as a new user meets it: links, search, and what it loads, opened from files."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from coframe.cli.app import app
from coframe.doctor import codes, page

pytestmark = [pytest.mark.slow, pytest.mark.timeout(600)]

ROOT = Path(__file__).resolve().parents[2]
FIRST = 5  # A result list shows that many sections without scrolling.
# What a new user types into the search, and the page and section with the answer: one click on a result.
TASKS = {
    "where was the robot at time t": ("quickstart.html", "where-was-the-robot-at-time-t"),
    "why is my frame missing": ("how-to/doctor.html", "why-is-my-frame-or-transform-missing"),
    "transform a point cloud": ("quickstart.html", "transform-a-point-cloud"),
    "convert from pytransform3d": ("how-to/pytransform3d.html", ""),
    "read a URDF": ("how-to/urdf.html", "read-a-urdf-or-xacro-file"),
    "convert a bag": ("how-to/recordings.html", "commands-inspect-convert-cut-or-repair-a-bag"),
    "poses as a pandas table": ("how-to/pandas.html", ""),
    "nodes do not see each other": (
        "how-to/doctor.html",
        "nodes-do-not-discover-each-other-or-my-program-receives-nothing",
    ),
    "record and replay": ("how-to/record-and-replay.html", ""),
    "two robots one viewer": ("how-to/several-robots.html", "several-robots-in-one-viewer"),
    "extrapolation into the future": ("concepts/conventions.html", "extrapolation-into-the-future"),
    "static transform command line": ("reference/commands/static.html", ""),
    "quaternion order": ("concepts/conventions.html", "quaternion-order"),
    "check a bag in CI": ("how-to/ci.html", ""),
    "communicate with real ROS 2": ("how-to/beside-ros2.html", ""),
    "which distribution": ("reference/distributions.html", ""),
    "coming from Humble": ("how-to/coming-from-tf2.html", "coming-from-humble"),
    "tests of launched systems": ("how-to/launch.html", "tests-of-launched-systems"),
    "TF003": ("reference/doctor-codes.html", "tf003"),
}

# Tasks, and the page that does each: one of the first two pages of the results.
PAGES = {
    "camera poses at each image stamp": "how-to/camera-poses.html",
    "inverse kinematics": "how-to/pinocchio.html",
    "merge with clock offset": "how-to/merge-recordings.html",
    "project points in Python": "how-to/project-points.html",
    "odometry topic as a trajectory": "how-to/trajectories.html",
    "rename a frame in a recording": "how-to/repair.html",
    "shift stamps in a recording": "how-to/repair.html",
    "add a transform to a recording": "how-to/repair.html",
    "send a transform": "how-to/send-transforms.html",
    "publish odometry": "how-to/send-transforms.html",
    "time travel": "handbook/09_time_travel.html",
    "PoseStamped to Transform": "how-to/poses-and-messages.html",
    "polars": "how-to/datasets.html",
    "xarray": "how-to/datasets.html",
    "torch": "how-to/datasets.html",
    "JAX": "how-to/datasets.html",
    "S3": "how-to/servers.html",
    "HDF5": "how-to/datasets.html",
    "multiprocessing": "how-to/workers.html",
    "uncertainty": "how-to/uncertainty.html",
    "evo on recordings": "how-to/trajectories.html",
    "record a bag": "how-to/record-and-replay.html",
    "repair a bag": "how-to/repair.html",
    "environment variables": "reference/environment.html",
    "which thread runs my callback": "how-to/threads.html",
    "troubleshooting": "troubleshooting.html",
    "comparison with RViz": "concepts/comparison.html",
    "supported versions": "reference/supported-versions.html",
}


class Opened:
    """A page of the site, opened from its file, with all requests that it made."""

    def __init__(self, browser, site, path="index.html", **options):
        self.site, self.requests, self.errors = site, [], []
        self.context = browser.new_context(**options)
        self.tab = self.context.new_page()
        self.tab.on("request", lambda request: self.requests.append(request.url))
        self.tab.on("pageerror", lambda error: self.errors.append(str(error)))
        self.tab.goto((site / path).as_uri())

    def search(self, words):
        """Type words into the search field, and return the links of the results as (page, section)."""
        field = self.tab.locator("input.md-search__input")
        field.click()
        field.fill("")
        self.tab.keyboard.type(words)
        results = self.tab.locator(".md-search-result__link")
        results.first.wait_for(timeout=60_000)
        # The list is complete when it no longer changes.
        self.tab.wait_for_function(
            """() => {
                const text = document.querySelector(".md-search__output").innerText
                const same = text === window.__before
                window.__before = text
                return same
            }""",
            polling=400,
            timeout=60_000,
        )
        # Sections below "more on this page" need a further click.
        links = """[...document.querySelectorAll(".md-search-result__link")]
            .filter((link) => !link.closest("details:not([open])")).map((link) => link.href)"""
        return [self.place(url) for url in self.tab.evaluate(links)]

    def place(self, url):
        path, _, section = re.sub(r"\?h=[^#]*", "", url).partition("#")
        base = self.site.as_uri() + "/"
        return path.removeprefix(base), section


@pytest.fixture
def opened(browser, site):
    page = Opened(browser, site)
    yield page
    page.context.close()


def test_links_and_anchors_exist(site):
    command = [sys.executable, ROOT / "scripts" / "site" / "check_links.py", site]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout


def test_the_handbook_leads_to_its_translations(site):
    page = (site / "handbook" / "index.html").read_text("utf-8")
    assert re.search(r'<a href="de/index.html"[^>]*>Handbuch auf Deutsch</a>', page)
    assert "Statische und dynamische" in (site / "handbook" / "de" / "index.html").read_text("utf-8")


def test_link_checker_finds_what_is_broken(tmp_path):
    (tmp_path / "index.html").write_text(
        '<a href="gone.html"></a><a href="#gone"></a><a href="http://nowhere"></a><a id="here" href="#here"></a>'
        '<script src="https://cdn.example.org/x.js"></script><a href="https://example.org/page"></a>'
    )
    command = [sys.executable, ROOT / "scripts" / "site" / "check_links.py", tmp_path]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert result.stdout.splitlines() == [
        "index.html: gone.html: no such file in the site",
        "index.html: #gone: no anchor #gone in index.html",
        "index.html: http://nowhere: has no valid host",
        "index.html: https://cdn.example.org/x.js: is loaded from another host",
        "1 pages, 4 broken links",
    ]


@pytest.mark.parametrize("task", TASKS)
def test_task_is_found_by_the_search(opened, task):
    assert TASKS[task] in opened.search(task)[:FIRST]


@pytest.mark.parametrize("task", PAGES)
def test_page_of_a_task_is_first_or_second(opened, task):
    pages = list(dict.fromkeys(page for page, _ in opened.search(task)))
    assert PAGES[task] in pages[:2]


def test_result_leads_to_the_section(opened):
    opened.search("quaternion order")
    link = opened.tab.locator(".md-search-result__link[href*='concepts/conventions.html'][href$='#quaternion-order']")
    link.first.click()
    opened.tab.wait_for_url(re.compile(r"concepts/conventions\.html.*#quaternion-order"))
    assert opened.tab.locator("#quaternion-order").is_visible()


@pytest.mark.parametrize("path", ["index.html", "quickstart.html", "reference/api/buffer.html", "how-to/viewer.html"])
def test_nothing_is_loaded_from_another_host(browser, site, path):
    page = Opened(browser, site, path)
    page.search("buffer")
    assert page.requests
    assert [url for url in page.requests if not url.startswith(("file:", "data:", "about:", "blob:"))] == []
    assert page.errors == []
    page.context.close()


def test_every_code_of_the_doctor_has_a_section(site):
    text = (site / "reference" / "doctor-codes.html").read_text("utf-8")
    for code in codes():
        section = re.search(rf'<h2 id="{code.lower()}">(.*?)<h2 ', text + "<h2 ", re.DOTALL)
        assert section is not None, f"{code} has no section"
        assert page(code).title.split("`")[0] in section[1]
        for heading in ("Why it matters", "What is found", "What to do"):
            assert f">{heading}<" in section[1], f"{code} does not say: {heading}"


def test_examples_in_docstrings_are_code(site):
    text = (site / "reference" / "api" / "buffer.html").read_text("utf-8")
    assert '<span class="gp">&gt;&gt;&gt; </span>' in text
    assert '<details class="example"' not in text


def test_every_command_and_option_has_a_place(site):
    for name, command in app.commands.items():
        text = re.sub(r"<[^>]*>", "", (site / "reference" / "commands" / f"{name}.html").read_text("utf-8"))
        for each in [command, *getattr(command, "commands", {}).values()]:
            for parameter in each.params:
                for option in parameter.opts if parameter.param_type_name == "option" and not parameter.hidden else ():
                    assert option in text, f"coframe {name}: {option} is not on the page"


def test_pages_fit_on_a_phone(browser, site):
    for path in ("index.html", "quickstart.html", "reference/commands/doctor.html", "performance.html"):
        page = Opened(browser, site, path, viewport={"width": 390, "height": 844})
        width = page.tab.evaluate("document.documentElement.scrollWidth")
        assert width <= 390, f"{path} is {width} pixels wide"
        page.context.close()
