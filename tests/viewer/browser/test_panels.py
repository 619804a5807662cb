# SPDX-License-Identifier: Apache-2.0
"""Plots, the message inspector, the log and the graph of nodes and topics in a browser."""

import csv
import io
import re

import pytest
from recordings import START
from runs import MS, SECOND, Run

import coframe
from coframe.messages import find
from coframe.plotting import evaluate
from coframe.wire.qos import QoS

EVIL = "<img src=x onerror=window.hacked=1>"
NONE = "\N{EN DASH}"  # shown instead of a missing value
# The number of pixels of a plot that have the color of its first curve, #2f7de1.
BLUE = """() => {
    const canvas = document.querySelector("#charts canvas");
    if (!canvas) return 0;
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let found = 0;
    for (let i = 0; i < data.length; i += 4)
        if (data[i] === 0x2f && data[i + 1] === 0x7d && data[i + 2] === 0xe1) found++;
    return found;
}"""


def add_curve(page, text):
    page.raw.fill("#pane-plots input", text)
    page.key("Enter")


def curves(page):
    """Return the shown values by expression."""
    rows = page.raw.locator("#curves .curve").all()
    return {row.get_attribute("data-expression"): row.locator(".curve-value").inner_text() for row in rows}


def number(text):
    return 0.0 if text == NONE else float(text.replace("\N{MINUS SIGN}", "-"))


def test_the_panels_of_a_running_robot(demo, lab):
    page = lab
    page.key("c")
    page.raw.locator("#pane-plots input").press_sequentially("odom:ba")
    page.until("document.querySelector('#completion-expression li')?.textContent === 'odom:base_link.'")
    page.key("ArrowDown")
    page.key("Enter")
    page.until("document.querySelectorAll('#completion-expression li').length > 5")
    page.raw.locator("#pane-plots input").press_sequentially("x")
    page.key("Enter")
    page.until("document.querySelector('#curves .curve[data-state=ok]') !== null")
    page.wait(lambda: page.evaluate(BLUE) > 30, "a drawn curve")
    add_curve(page, "/scan.header")
    page.until("document.querySelector('#curves .curve[data-state=error]')?.textContent.includes('Choose a field')")
    page.raw.get_by_label("Remove /scan.header").click()
    assert [*curves(page)] == ["odom:base_link.x"]

    page.key("Escape")  # leaves the input
    page.key("r")
    topic = page.raw.locator(".graph-box.is-topic[data-name='/scan']")
    page.wait(topic.count, "the topic in the graph")
    names = {box.get_attribute("data-name") for box in page.raw.locator(".graph-box").all()}
    assert {"/simulated_lidar", "/tf", "/scan_base_frame"} <= names
    assert not names & {"/rosout", "/parameter_events", "/coframe_view"}
    topic.focus()
    page.key("Enter")
    facts = page.raw.locator("#message-facts")
    page.wait(lambda: "published by /simulated_lidar" in facts.inner_text(), "a message")
    page.wait(
        lambda: re.search(r"sensor_msgs/msg/LaserScan · (9|1[01])(\.\d)? Hz", facts.inner_text()), "a rate of 10 Hz"
    )
    page.raw.get_by_label("Plot /scan.header.stamp.sec").click()
    page.wait(lambda: number(curves(page).get("/scan.header.stamp.sec", "0")) > 1e9, "a plotted field")

    page.raw.locator("#pane-graph").get_by_label("Close: Nodes and topics").click()
    page.key("e")
    log = find("rcl_interfaces/msg/Log")
    rosout = demo.ros.publisher("/rosout", log, QoS(1000, transient_local=True))
    for i in range(3):
        rosout.publish(log(level=30, name="browser_test", msg=f"a warning with the number {i}"))
    page.raw.get_by_label("Text in the log").fill("number 1")
    page.wait(lambda: [line[-8:] for line in page.texts(".log-row")] == ["number 1"], "the filtered log")
    rosout.close()

    # The address and the settings of the page contain what is shown.
    assert "plot=odom%3Abase_link.x" in page.raw.url
    page.raw.reload()
    page.drawn()
    page.wait(lambda: curves(page).get("odom:base_link.x", NONE) != NONE, "the curve after a reload")
    assert page.raw.locator("#pane-log").is_visible()
    assert page.raw.locator("#pane-graph").is_hidden()
    for name in ("plots", "message", "log"):
        page.raw.locator(f"#pane-{name} .icon-button[title^=Close]").last.click()
    assert page.raw.locator("#dock").is_hidden()


def run_with_log():
    run = Run.healthy(seconds=6)
    log = find("rcl_interfaces/msg/Log")
    for i in range(6):
        entry = log(level=30, name=EVIL, msg=f"{EVIL} {i}")
        entry.stamp.sec, entry.stamp.nanosec = divmod(START + i * SECOND, SECOND)
        run.message("/rosout", "rcl_interfaces/msg/Log", entry, START + i * SECOND + MS)
    text = find("std_msgs/msg/String")
    run.message("/text", "std_msgs/msg/String", text(data=EVIL), START + SECOND)
    for i, state in enumerate(("idle", "driving", "driving", EVIL)):
        run.message("/state", "std_msgs/msg/String", text(data=state), START + (i + 1) * SECOND)
    return run


def test_the_panels_of_a_recording(view, open_page, tmp_path):
    path = run_with_log().write(tmp_path)
    with coframe.open_bag(path) as bag:
        (expected,) = evaluate(["odom:base_link.x"], bag)
    page = open_page(f"{view(path).url}#plot=odom:base_link.x&plot={EVIL}&topic=/text&panel=message&panel=log").drawn()
    page.wait(lambda: page.evaluate(BLUE) > 100, "the whole curve")
    box = page.raw.locator("#charts .u-over").first.bounding_box()

    def click(part):
        page.raw.mouse.click(box["x"] + part * box["width"], box["y"] + box["height"] / 2)
        page.raw.mouse.move(0, 0)  # The values are those of the playhead again.
        page.settle()

    def value_at_playhead():
        at = page.origin() + round(page.evaluate("coframe.time"))
        return at, expected.values[expected.stamps <= at + 1000][-1]

    click(0.5)
    at, value = value_at_playhead()
    assert at == pytest.approx(START + 3 * SECOND, abs=0.1 * SECOND)
    page.wait(lambda: abs(number(curves(page)["odom:base_link.x"]) - value) < 1e-3, "the value at the playhead")
    page.raw.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 20)
    page.raw.mouse.down()
    page.raw.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 20, steps=4)
    page.raw.mouse.up()
    page.raw.wait_for_timeout(300)
    click(0.5)
    assert value_at_playhead()[0] == pytest.approx(START + 3.3 * SECOND, abs=0.05 * SECOND), "zoomed"

    page.wait(lambda: len(page.texts(".log-row")) == 6, "the log")
    assert page.texts(".log-row .log-text")[4] == f"{EVIL} 4"
    page.raw.locator(".log-row").nth(4).click()
    page.settle()
    assert value_at_playhead()[0] == pytest.approx(START + 4 * SECOND, abs=1 * MS)
    page.wait(lambda: page.texts("#fields .field-value") == [EVIL], "the message as text")
    problem = page.raw.locator("#curves .curve[data-state=error]")
    assert "is neither two frames nor a topic" in problem.inner_text()
    with page.raw.expect_download() as download:
        page.raw.locator("#pane-plots").get_by_text("CSV", exact=True).click()
    content = download.value.path().read_text()
    rows = list(csv.reader(io.StringIO(content)))
    assert rows[0] == ["stamp_ns", "odom:base_link.x", EVIL]
    assert [float(row[1]) for row in rows[1:]] == expected.values.tolist(), "all points, without thinning"
    with page.raw.expect_download() as download:
        page.raw.get_by_text("PNG", exact=True).click()
    assert download.value.path().read_bytes().startswith(b"\x89PNG")
    for name in ("plots", "message", "log"):
        page.raw.locator(f"#pane-{name} .icon-button[title^=Close]").last.click()
    check_states_and_table(page)
    assert page.evaluate("window.hacked") is None


def check_states_and_table(page):
    """Show the states of a field and the last messages of its topic, at the time that is clicked."""
    page.key("q")
    page.raw.fill("#pane-states input", "/state.data")
    page.key("Enter")
    page.wait(lambda: page.texts("#states .state-value") == [EVIL], "the state at 4 s")
    box = page.raw.locator("#states canvas").bounding_box()
    page.raw.mouse.click(box["x"] + 0.4 * box["width"], box["y"] + 5)  # 2.4 s of 6 s
    page.wait(lambda: page.texts("#states .state-value") == ["driving"], "the state at 2.4 s")
    assert page.raw.locator("#states li").get_attribute("data-state") == "ok"
    colors = page.evaluate("""() => {
        const canvas = document.querySelector("#states canvas");
        return [0.1, 0.25, 0.4, 0.6, 0.9].map((part) =>
            [...canvas.getContext("2d").getImageData(part * canvas.width, 2, 1, 1).data].join());
    }""")
    before, idle, driving, evil, after = colors
    assert len({before, idle, driving, evil}) == 4
    assert before == after, "nothing is drawn before the first and after the last message"
    page.key("Escape")
    page.key("x")
    page.raw.fill("#pane-table input", "/state")
    page.key("Enter")
    page.wait(lambda: page.texts("#table-rows tr td:last-child") == ["driving", "idle"], "the rows up to the playhead")
    page.raw.locator("#table-rows button").last.click()
    page.wait(lambda: page.texts("#table-rows tr td:last-child") == ["idle"], "the row at 1 s")
    page.wait(lambda: page.texts("#states .state-value") == ["idle"], "the state at 1 s")


@pytest.mark.slow
def test_the_panels_fit_phones_and_both_themes(demo, open_page):
    page = open_page(f"{demo.url}#plot=odom:base_link.x&panel=plots&panel=log", width=390, height=800).drawn()
    page.wait(lambda: page.raw.locator("#pane-log").is_visible(), "the last panel")
    assert page.raw.locator("#pane-plots").is_hidden(), "one panel at a time"
    page.click("#bar button[title=Panels]")
    page.raw.get_by_role("menuitem", name="Plots").click()
    page.wait(lambda: page.evaluate(BLUE) > 30, "a drawn curve")
    for selector in ("#dock", "#charts", "#timeline", "#pane-plots .pane-head"):
        box = page.raw.locator(selector).bounding_box()
        assert box["x"] >= 0, selector
        assert box["x"] + box["width"] <= 390, selector
        assert box["y"] + box["height"] <= 800, selector
    axis = "getComputedStyle(document.querySelector('#pane-plots h2')).color"
    before = page.evaluate(axis)
    page.key("d")
    page.until("before => getComputedStyle(document.querySelector('#pane-plots h2')).color !== before", before)
    page.wait(lambda: page.evaluate(BLUE) > 30, "the curve in the other theme")
