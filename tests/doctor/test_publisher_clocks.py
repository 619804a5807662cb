# SPDX-License-Identifier: Apache-2.0
"""`coframe doctor --clocks`: a clock that is off and one that drifts, as numbers, JSON and a plot."""

import json

import pytest
from click.testing import CliRunner
from runs import MS, SECOND, START, Run

from coframe.cli.app import app


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """A robot whose lidar is 2 s ahead and whose camera drifts by 200 ppm."""
    run = Run.healthy(seconds=20, skip={"scan"})
    for i in range(200):
        at = START + i * SECOND // 10
        run.scan(at + 2 * SECOND, arrived=at + MS)
        run.scan(at - (at - START) // 5000, "lidar", arrived=at + MS, topic="/camera/scan")
    return run.write(tmp_path_factory.mktemp("clocks"))


def clocks(*words, code=0):
    ended = CliRunner().invoke(app, ["doctor", *map(str, words), "--clocks"])
    assert ended.exit_code == code, ended.output
    return ended.output


def test_offset_and_drift_are_numbers(recording):
    rows = {row["stamps_of"]: row for row in json.loads(clocks(recording, "--json"))}
    assert next(iter(rows)) == "/scan"
    assert rows["/scan"]["offset_ns"] == pytest.approx(-2 * SECOND, abs=5 * MS)
    assert rows["/scan"]["drift_ppm"] is None
    assert rows["/camera/scan"]["drift_ppm"] == pytest.approx(200, rel=0.02)
    assert rows["odom -> base_link"]["offset_ns"] == pytest.approx(MS, abs=MS)
    table = clocks(recording)
    assert "2 s ahead" in next(line for line in table.splitlines() if line.startswith("/scan"))
    assert "200 ppm" in next(line for line in table.splitlines() if line.startswith("/camera/scan"))


def test_the_plot_has_a_curve_for_each_clock(recording, tmp_path):
    clocks(recording, "--output", tmp_path / "clocks.html")
    page = (tmp_path / "clocks.html").read_text()
    assert all(name in page for name in ("/scan", "/camera/scan", "base_link"))


def test_wrong_combinations(recording, tmp_path):
    assert (
        "--output is the plot of --clocks"
        in CliRunner().invoke(app, ["doctor", str(recording), "-o", str(tmp_path / "a.svg")]).output
    )
    assert "--clocks cannot be combined with --sarif" in clocks(recording, "--sarif", code=2)
