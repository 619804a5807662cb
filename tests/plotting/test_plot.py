# SPDX-License-Identifier: Apache-2.0
"""``coframe plot``: curves have the right values, files the right contents, and mistakes a hint."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from chromium import chromium
from click.testing import CliRunner
from runs import MS, SECOND, START, Run

import coframe
from coframe.cli.app import app
from coframe.plotting import Figure, PlotError, Series, evaluate
from coframe.plotting._figure import COLORS, MAX_DRAWN_VALUE
from coframe.plotting._html_page import MAX_POINTS, as_html
from coframe.transform.quantities import coordinate

LATENCY = 20 * MS


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return Run.healthy(seconds=4, latency=LATENCY).write(tmp_path_factory.mktemp("plot"))


@pytest.fixture(scope="module")
def recording(bag):
    with coframe.open_bag(bag) as recording:
        yield recording


def run(*arguments):
    result = CliRunner().invoke(app, ["plot", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout, result.stderr


def curve(expression, recording, *limits):
    (found,) = evaluate([expression], recording, *limits)
    return found


@pytest.mark.parametrize(
    ("quantity", "expected", "panel"),
    [
        ("x", np.cos, "position [m]"),
        ("y", np.sin, "position [m]"),
        ("distance", np.ones_like, "position [m]"),
        ("yaw", lambda angle: angle, "angle [rad]"),
        ("roll", np.zeros_like, "angle [rad]"),
    ],
)
def test_poses(recording, quantity, expected, panel):
    found = curve(f"odom->base_link.{quantity}", recording)
    angles = (found.stamps - START) / SECOND / 3
    assert len(found.stamps) == 200
    np.testing.assert_allclose(found.values, expected(angles), atol=1e-12)
    assert found.panel == panel


def test_a_static_transform_is_a_line_over_the_whole_recording(recording):
    found = curve("base_link:lidar.z", recording)
    assert found.values.tolist() == [0.3, 0.3]
    assert tuple(found.stamps.tolist()) == recording.span


def test_fields_of_messages(recording):
    found = curve("/scan.header.stamp.nanosec", recording)
    assert len(found.values) == recording.topics["/scan"].messages
    np.testing.assert_array_equal(found.values, found.stamps % SECOND)
    assert curve("/tf.transforms[0].transform.translation.x", recording).panel == "translation"


def test_rates(recording):
    for expression in ("/tf.rate", "odom->base_link.rate"):
        values = curve(expression, recording).values
        assert np.isnan(values[:50]).all()  # The mean is over a second.
        np.testing.assert_allclose(values[50:], 50, rtol=1e-6)


def test_a_burst_after_a_pause_has_no_high_rate(tmp_path):
    run = Run()
    for at in (0, 1, 2, 8, 8.001, 9):
        run.drive(START + int(at * SECOND))
    with coframe.open_bag(run.write(tmp_path)) as recording:
        assert np.nanmax(curve("/tf.rate", recording).values) <= 2


def test_delays(recording):
    np.testing.assert_allclose(curve("odom->base_link.delay", recording).values, LATENCY / SECOND)
    np.testing.assert_allclose(curve("/tf.delay", recording).values, LATENCY / SECOND)


def test_delays_in_a_simulation_are_on_its_clock(shared):
    with coframe.open_bag(shared / "recordings" / "tb3_gazebo_walker") as recording:
        assert abs(np.median(curve("odom->base_footprint.delay", recording).values)) < 0.1
        with pytest.raises(PlotError, match="have no stamp and therefore no delay"):
            curve("/clock.delay", recording)


def test_start_and_stop(recording):
    found = curve("odom->base_link.x", recording, START + SECOND, START + 2 * SECOND)
    assert (found.stamps[0], found.stamps[-1]) == (START + SECOND, START + 2 * SECOND)
    with pytest.raises(PlotError, match="has no values between the start and the stop"):
        curve("odom->base_link.x", recording, 0, 1)


@pytest.mark.parametrize(
    ("expression", "reason", "hint"),
    [
        ("/scn.rate", "has no topic '/scn'", "Did you mean '/scan'? Topics: "),
        ("/scan.rangs[0]", "/scan has no field 'rangs'", "Did you mean 'ranges'?"),
        ("/scan.header", "is a message, not a number", "/scan.header.stamp"),
        ("/scan.header.frame_id", "is a string, not a number", ""),
        ("/scan.ranges", "is a sequence, not a number", "/scan.ranges[0]"),
        ("/scan.ranges.x", "is a sequence, which has no field 'x'", "/scan.ranges[0].x"),
        ("/scan.angle_min[0]", "/scan.angle_min is not a sequence", ""),
        ("/scan.ranges[99999]", "no message on /scan has an element with this index", ""),
        ("odom->lidar.rate", "'odom' is not the parent of 'lidar'", "The parent of 'lidar' is 'base_link'."),
        ("base_link->odom.rate", "is not the parent", "The parent comes first: odom->base_link.rate."),
        ("base_link->lidar.rate", "is static, so it has no rate", ""),
        ("odom->base_lnk.x", "does not exist", "Did you mean 'base_link'?"),
    ],
)
def test_what_cannot_be_plotted_is_reported_with_a_hint(bag, tmp_path, expression, reason, hint):
    code, out, error = run(bag, expression, "-o", tmp_path / "a.html")
    assert (code, out) == (1, "")
    assert reason in error
    assert hint in error
    assert list(tmp_path.iterdir()) == []


def test_wrong_arguments_end_the_command_with_2(bag, tmp_path):
    assert run(bag, "odom.x", "-o", tmp_path / "a.html")[0] == 2
    code, _, error = run(bag, "/tf.rate", "-o", tmp_path / "a.pdf")
    assert (code, "Known suffixes of plots: .svg, .png, .html." in error) == (2, True)
    assert run(bag, "/tf.rate", "-o", tmp_path / "a.html", "--start", "soon")[0] == 2
    code, _, error = run(bag, "/tf.rate", "-o", tmp_path / "missing" / "a.html")
    assert (code, "cannot be written: No such file" in error) == (1, True)


EXPRESSIONS = ["odom:base_link.x", "odom:base_link.y", "odom:base_link.yaw", "/tf.rate"]


@pytest.mark.parametrize("kind", ["svg", "png"])
def test_images(bag, tmp_path, kind):
    pytest.importorskip("matplotlib", reason="the extra `plot` is not installed")
    code, out, _ = run(bag, *EXPRESSIONS, "-o", tmp_path / f"a.{kind}", "--title", "costs $5 and $6 <b>")
    content = (tmp_path / f"a.{kind}").read_bytes()
    assert (code, "4 curves, 800 values" in out) == (0, True)
    if kind == "svg":
        text = content.decode()
        assert all(label in text for label in (*EXPRESSIONS, "position [m]", "angle [rad]", "rate [Hz]"))
        assert "costs $5 and $6 &lt;b&gt;" in text
    else:
        assert content.startswith(b"\x89PNG")


def test_the_page_contains_everything(bag, tmp_path):
    assert run(bag, *EXPRESSIONS, "-o", tmp_path / "a.html", "--title", "</title><script>@@DATA@@")[0] == 0
    page = (tmp_path / "a.html").read_text()
    assert "The MIT License" in page
    assert "&lt;/title&gt;&lt;script&gt;@@DATA@@" in page
    assert not re.search(r"(src|href)=", page.replace("src=null", ""))
    data = json.loads(re.search(r"^const data = (.*);$", page, re.MULTILINE)[1])
    assert [panel["title"] for panel in data["panels"]] == ["position [m]", "angle [rad]", "rate [Hz]"]
    assert data["panels"][2]["curves"][0]["y"][0] is None
    assert data["x"] == "time since 2023-11-14 22:13:20.000 UTC [s]"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("kind", ["svg", "png", "html"])
def test_values_too_large_to_draw_are_gaps(tmp_path, kind):
    values = np.array([1e308, 1.0, -1e308, 2.0, np.inf, np.nan, 3.0, 1e299])
    series = Series("far", START + np.arange(len(values)) * SECOND, values, "position [m]")
    Figure("far", [series]).save(tmp_path / f"a.{kind}")
    if kind == "html":
        drawn = re.search(r'"y": (\[[^]]*\])', (tmp_path / "a.html").read_text())
        assert json.loads(drawn[1]) == [None, 1.0, None, 2.0, None, None, 3.0, 1e299]
    assert (tmp_path / f"a.{kind}").stat().st_size > 1000


@pytest.mark.filterwarnings("error")
def test_the_distance_of_a_frame_far_away():
    far = coframe.Transform([[3e200, 4e200, 0.0], [1.7e308, 1.7e308, 0.0]], [[0.0, 0, 0, 1]] * 2)
    np.testing.assert_allclose(coordinate(far, "distance"), [5e200, np.inf])


def test_long_curves_keep_their_peaks():
    values = np.zeros(1_000_000)
    values[123_456] = 7
    page = as_html(Figure("long", [Series("a", np.arange(1_000_000), values, "b")]))
    data = json.loads(re.search(r"^const data = (.*);$", page, re.MULTILINE)[1])["panels"][0]["curves"][0]
    assert max(data["y"]) == 7
    assert (len(data["y"]) <= MAX_POINTS + 2, data["of"]) == (True, 1_000_000)


def luminance(color):
    channels = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    return np.dot([0.2126, 0.7152, 0.0722], [c / 12.92 if c < 0.04 else ((c + 0.055) / 1.055) ** 2.4 for c in channels])


@pytest.mark.parametrize("background", ["#ffffff", "#15181d"])
def test_colors_are_readable_in_light_and_dark(background):
    for color in COLORS:
        darker, brighter = sorted((luminance(color), luminance(background)))
        assert (brighter + 0.05) / (darker + 0.05) > 3.5


def test_a_browser_shows_the_page_without_a_network(bag, tmp_path):
    run(bag, *EXPRESSIONS, "-o", tmp_path / "a.html")
    with chromium() as browser:
        page = browser.new_context(offline=True, color_scheme="dark").new_page()
        errors = []
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda message: errors.append(message.text))
        page.goto((tmp_path / "a.html").as_uri())
        page.wait_for_selector(".uplot canvas")
        assert page.locator(".uplot").count() == 3
        over = page.locator(".u-over").first
        box = over.bounding_box()
        page.mouse.move(box["x"] + 100, box["y"] + 50)
        page.mouse.down()
        page.mouse.move(box["x"] + 300, box["y"] + 50)
        page.mouse.up()
        page.wait_for_function("plots.every(plot => plot.scales.x.max - plot.scales.x.min < 3)")  # All panels zoom.
        over.dblclick()
        page.wait_for_function("plots.every(plot => plot.scales.x.max - plot.scales.x.min > 3.9)")
        assert errors == []
        browser.close()


def test_the_page_draws_the_same_values():
    page = (Path(__file__).parents[2] / "viewer" / "src" / "plots" / "curve.ts").read_text(encoding="utf-8")
    assert float(re.search(r"const MAX_DRAWN_VALUE = (\S+);", page)[1]) == MAX_DRAWN_VALUE
