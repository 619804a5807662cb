# SPDX-License-Identifier: Apache-2.0
"""Names and texts from outside in the panels of the page: they are shown as text, shortened, and never executed."""

import pytest
from recordings import START
from runs import MS, SECOND, Run

import coframe
from coframe.messages import find

MARKUP = "<img src=x onerror=window.hacked=1>"
SHORT = [MARKUP, "\x1b]0;hacked\x07\x1b[31mred\x1b[2J", "a\nb\r\nc", "\u202egpj.exe\u202d\u2066"]
LONG = "m" * 1_000_000
URDF = """<robot name="{0}"><link name="{0}"/><link name="{0}tip"/><joint name="{0}turn" type="continuous">
<parent link="{0}"/><child link="{0}tip"/></joint></robot>"""
ESCAPED = "&lt;img src=x onerror=window.hacked=1&gt;"
MAX_HEAP_BYTES = 400 << 20  # bytes of a page that shows names of 1 MB
# Elements that only markup in a name could create, and names of 1 MB that are in the page as a whole.
FOREIGN = """() => ({
    hacked: window.hacked ?? null,
    images: document.querySelectorAll("img[src=x], [onerror], [onload]").length,
    longest: Math.max(...[...document.body.querySelectorAll("*:not(script)")].map((one) =>
        Math.max(0, ...[...one.childNodes].filter((node) => node.nodeType === 3).map((node) => node.data.length)))),
    controls: /[\\x1b\\x07\\u202e\\u2066]/.test(document.body.innerText),
    heap: performance.memory?.usedJSHeapSize ?? 0,
})"""


def hostile_run(names):
    """Return a recording in which frames, topics, namespaces, texts, nodes and links have hostile names."""
    run = Run.healthy(seconds=4)
    marker, log, image = (
        find(name) for name in ("visualization_msgs/msg/Marker", "rcl_interfaces/msg/Log", "sensor_msgs/msg/Image")
    )
    for i, name in enumerate(names):
        at = START + i * SECOND // 2
        run.tf("base_link", name, START, (1.0, float(i), 0.0), static=True)
        run.tf(name, f"child of {name}", START, (0.0, 0.0, 1.0), static=True)
        text = marker(type=9, id=i, ns=name, text=name)
        text.header.frame_id = "base_link"
        text.scale.z = text.color.a = text.pose.orientation.w = 1.0
        run.message("/markers", "visualization_msgs/msg/Marker", text, at)
        lost = marker(type=10, id=i, ns=name, mesh_resource=f"package://{name}/{name}.stl")
        lost.header.frame_id = name
        lost.color.a = lost.pose.orientation.w = 1.0
        run.message("/meshes", "visualization_msgs/msg/Marker", lost, at)
        entry = log(level=40, name=name, msg=name, file=name, function=name)
        entry.stamp.sec, entry.stamp.nanosec = divmod(at, SECOND)
        run.message("/rosout", "rcl_interfaces/msg/Log", entry, at + MS)
        if "\n" not in name:
            run.message(f"/{name}", "std_msgs/msg/String", find("std_msgs/msg/String")(data=name), at)
        picture = image(height=1, width=1, encoding=name[:1000], step=3, data=bytes(3))
        picture.header.frame_id = name
        run.message("/image", "sensor_msgs/msg/Image", picture, at)
        run.scan(at, frame=f"missing {name}", topic=f"/scan{i}")
    description = find("std_msgs/msg/String")(data=URDF.format(ESCAPED))
    run.message("/robot_description", "std_msgs/msg/String", description, START)
    return run


def check(page, panel):
    """Assert that nothing was executed, and that the page shows short escaped texts and still draws."""
    found = page.evaluate(FOREIGN)
    assert found["hacked"] is None, panel
    assert found["images"] == 0, panel
    assert found["longest"] < 20_000, panel
    assert found["heap"] < MAX_HEAP_BYTES, panel
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), panel
    updates = page.evaluate("document.activeElement.blur(), coframe.updates")
    page.key("ArrowLeft")
    page.until("updates => coframe.updates > updates", updates)


def check_frames_and_displays(page):
    """Check the tree, the inspector of each frame, and the displays."""
    assert max(map(len, page.rows())) <= 300
    check(page, "tree")
    for i, name in enumerate(page.rows()):
        if not name.isascii() or not name.isidentifier():
            page.raw.locator("#panel .row:visible .name").nth(i).click()
            check(page, f"inspector of {name}")
    page.tab("displays")
    check(page, "displays")


def check_findings(page):
    """Check the findings and the page about one of them."""
    page.tab("findings")
    page.wait(lambda: "TF0" in page.text("#body-findings"), "the findings")
    check(page, "findings")
    page.raw.locator("#findings .finding").first.locator(".finding-head").click()
    check(page, "the frame of a finding")


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_hostile_names_of_a_recording_are_text_in_every_panel_of_the_scene(view, open_page, tmp_path):
    path = hostile_run([*SHORT, LONG]).write(tmp_path)
    # Meshes that do not exist are errors that the browser logs.
    page = open_page(view(path, fixed="odom").url, expected_errors=["Failed to load resource"]).drawn()
    page.wait(lambda: MARKUP in page.rows(), "the frames in the tree")
    check_frames_and_displays(page)
    check_findings(page)


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_hostile_names_of_nodes_and_frames_on_the_graph_are_text(domain_id, view, open_page):
    pytest.importorskip("cyclonedds", reason="nodes are found over DDS")
    text = find("std_msgs/msg/String")
    with coframe.connect("browser_injection", domain=domain_id) as ros:
        for i, name in enumerate([*SHORT, LONG]):
            ros.buffer.set("map", name, coframe.Transform([1.0, i, 0.0]), static=True)
            node = ros.participant.add_node("/", name[:250])
            ros.participant.publisher(node, f"/topic{i}", text, coframe.wire.qos.QoS(1))
        page = open_page(f"{view(ros, fixed='map').url}#panel=graph").drawn()
        page.wait(
            lambda: page.raw.locator(f'.graph-box[data-name="/{MARKUP}"]').count(), "the nodes in the graph of nodes"
        )
        check(page, "graph")
        boxes = page.raw.locator(".graph-box")
        for i in range(min(boxes.count(), 12)):
            boxes.nth(i).focus()
            page.key("Enter")
            check(page, f"message of {i}")


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_hostile_names_of_a_recording_are_text_in_plots_log_and_messages(view, open_page, tmp_path):
    path = hostile_run([*SHORT, LONG]).write(tmp_path)
    url = f"{view(path, fixed='odom').url}#panel=plots&panel=log&panel=message"
    page = open_page(url, expected_errors=["Failed to load resource"]).drawn()
    page.wait(lambda: any(MARKUP in row for row in page.texts(".log-row")), "the log")
    check(page, "log")
    box = page.raw.locator("#pane-plots input")
    # The name of 1 MB is not offered: a text that is that long cannot be edited, and the server refuses it.
    for typed, first in (("base_link:<", f"base_link:{MARKUP}."), ("base_link:mm", None), ("m", None), ("/<", None)):
        box.fill("")
        box.press_sequentially(typed)
        if first is not None:
            page.wait(lambda first=first: first in page.texts("#completion-expression li"), "the completion")
        page.key("ArrowDown")
        page.key("Enter")
        assert page.evaluate("document.querySelector('#pane-plots input').value.length") <= 1000
    for name in SHORT[:1]:
        box.fill(f"base_link:{name}.x")
        page.key("Enter")
    page.wait(
        lambda: page.raw.locator("#curves .curve[data-state=ok]").count(),
        f"a curve, not {page.texts('#curves .curve')}",
    )
    check(page, "plots")
    topic = page.raw.locator("#pane-message input")
    topic.fill(f"/{MARKUP}")
    page.key("Enter")
    page.wait(lambda: MARKUP in page.text("#fields"), "the message")
    check(page, "message")


@pytest.mark.slow
@pytest.mark.timeout(300)
def test_hostile_names_are_text_in_a_replay(view, open_page, tmp_path):
    path = hostile_run([*SHORT, LONG]).write(tmp_path)
    page = open_page(view(path, fixed="odom").url, expected_errors=["Failed to load resource"]).drawn()
    file = page.save_replay(tmp_path / "replay.html", 2)
    replay = open_page(file, expected_errors=["Failed to load resource"]).drawn()
    replay.wait(lambda: MARKUP in replay.rows(), "the frames in the tree")
    check_frames_and_displays(replay)
    replay.tab("findings")  # A replay contains none.
    check(replay, "findings")


@pytest.mark.slow
def test_a_name_that_is_too_long_for_a_request_does_not_close_the_connection(view, open_page):
    buffer = coframe.Buffer()
    buffer.set("map", "n" * 1_200_000, coframe.Transform(), static=True)
    buffer.set("map", "base", coframe.Transform(), static=True)
    sockets = []
    page = open_page("about:blank")
    page.raw.on("websocket", lambda socket: sockets.append(socket.url))
    page.raw.goto(view(buffer, fixed="map").url)
    page.drawn()
    page.raw.locator("#panel .row:visible .name").filter(has_text="nnn").click()
    page.click("text=Use as Fixed Frame")
    page.wait(lambda: "too large for the server" in page.text("#toasts"), "the message")
    page.shows("base")
    assert len(sockets) == 1
