# SPDX-License-Identifier: Apache-2.0
"""Hostile input is rejected with a message or shown as text, and the viewer keeps working."""

import csv
import json

import pytest
import recordings

import coframe
from coframe.messages import find
from coframe.wire.qos import QoS

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND

MARKUP = [
    "<img src=x onerror=window.hacked=1>",
    "</script><script>window.hacked=1</script>",
    '"><svg onload=window.hacked=1>',
    "javascript:window.hacked=1",
    "{{constructor.constructor('window.hacked=1')()}}",
    "__proto__",
    "constructor",
    "\u202eevil\u2028\n\x00",
]


def small_buffer():
    buffer = coframe.Buffer(None)
    for second in range(11):
        buffer.set("map", "base", coframe.Transform([second, 0.0, 0.0]), BEGIN + second * SECOND)
    return buffer


def test_names_with_markup_and_of_any_length_are_shown_as_text(view, open_page):
    buffer = small_buffer()
    names = [*MARKUP, "x" * 10_000]
    for i, name in enumerate(names):
        buffer.set("map", name, coframe.Transform([1.0, i, 0.0]), BEGIN + 10 * SECOND)
    page = open_page(view(buffer, fixed="map").url).drawn()
    shown = page.rows()
    assert MARKUP[0] in shown
    assert MARKUP[1] in shown
    assert "__proto__" in shown
    assert max(map(len, shown)) <= 300
    for row in (0, 1, len(shown) - 1):  # in the inspector, as the fixed frame, and in the lists of names
        page.raw.locator("#panel .row:visible .name").nth(row).click()
        page.click("text=Use as Fixed Frame")
    for name in names:
        page.raw.evaluate(
            "name => { const s = document.querySelector('#fixed'); s.value = name; s.onchange?.(); }", name
        )
    assert (
        page.evaluate("document.querySelectorAll('#panel img, #labels img, #inspector img, svg[onload]').length") == 0
    )
    assert page.evaluate("window.hacked === undefined && ({}).position === undefined")
    assert page.raw.locator("#panel").bounding_box()["width"] < 500
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_objects_with_invalid_numbers_are_hidden(domain_id, view, open_page):
    pytest.importorskip("dds_library", reason="messages are received over DDS")
    with coframe.connect("browser_hostile", domain=domain_id) as ros:
        ros.buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), static=True)
        ros.buffer.set("map", "huge", coframe.Transform([1e300, 0.0, 0.0]), static=True)
        pose = find("geometry_msgs/msg/PoseStamped")()
        pose.header.frame_id = "map"
        pose.pose.position.x = float("nan")
        path = find("nav_msgs/msg/Path")(poses=[pose, pose])
        path.header.frame_id = "map"
        marker = find("visualization_msgs/msg/Marker")(type=1)
        marker.header.frame_id = "map"
        marker.pose.position.x = float("inf")
        marker.scale.x = float("nan")
        publishers = [
            (ros.publisher(topic, type(message)), message)
            for topic, message in (("/pose", pose), ("/path", path), ("/marker", marker))
        ]
        page = open_page(view(ros).url).drawn()

        def all_received():
            for publisher, message in publishers:
                publisher.publish(message)
            shown = page.evaluate("Object.values(coframe.displays).filter((one) => one.topic)")
            waiting = [one for one in shown if one["state"] == "waiting" and "no node publishes" in one["text"]]
            return len(shown) == 3 and not waiting

        page.wait(all_received, "three displays")
        updates = page.evaluate("coframe.updates")
        page.until("updates => coframe.updates > updates + 2", updates)
        assert page.evaluate("coframe.frames.base.visible")
        assert page.evaluate("coframe.invalidMessages") == 0


ESCAPE = """<robot name="thief"><link name="base"><visual><geometry>
  <mesh filename="{}"/></geometry></visual></link></robot>"""
BOMB = """<?xml version="1.0"?><!DOCTYPE bomb [<!ENTITY a "aaaaaaaaaaaaaaaaaaaa">{}]>
<robot name="&i;"><link name="base"/></robot>"""


def describe(ros, text):
    """Publish a robot description like robot_state_publisher does."""
    message = find("std_msgs/msg/String")(data=text)
    publisher = ros.publisher("/robot_description", type(message), QoS(1, transient_local=True))
    publisher.publish(message)
    return publisher


@pytest.mark.parametrize(
    "mesh",
    [
        "package://crane/../../secret.stl",
        pytest.param("file:///etc/passwd", marks=pytest.mark.slow),
        pytest.param("../../secret.stl", marks=pytest.mark.slow),
    ],
)
def test_meshes_outside_of_the_packages_are_rejected_with_a_message(domain_id, tmp_path, view, open_page, mesh):
    pytest.importorskip("dds_library", reason="robot descriptions are received over DDS")
    (tmp_path / "a" / "crane").mkdir(parents=True)
    (tmp_path / "a" / "crane" / "package.xml").write_text("<package><name>crane</name></package>")
    (tmp_path / "secret.stl").write_bytes(b"\0" * 84)
    with coframe.connect("browser_thief", domain=domain_id) as ros:
        ros.buffer.set("map", "base", coframe.Transform(), static=True)
        describe(ros, ESCAPE.format(mesh))
        page = open_page(view(ros, mesh_roots=[tmp_path / "a"]).url).drawn()
        page.until("Object.values(coframe.displays).some((one) => one.class === 'RobotModel' && one.state === 'error')")
        page.tab("displays")
        page.wait(lambda: mesh.rpartition("/")[2] in page.text("#body-displays .card:has-text('RobotModel') .status"))
        assert page.evaluate("coframe.connected")


def test_an_xml_bomb_is_rejected_with_a_message(domain_id, view, open_page):
    pytest.importorskip("dds_library", reason="robot descriptions are received over DDS")
    levels = "".join(f'<!ENTITY {b} "{f"&{a};" * 20}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True))
    with coframe.connect("browser_bomb", domain=domain_id) as ros:
        ros.buffer.set("map", "base", coframe.Transform(), static=True)
        publisher = describe(ros, BOMB.format(levels))
        page = open_page(view(ros).url).drawn()
        page.wait(
            lambda: any(
                "/robot_description contains no valid robot description" in text
                for text in page.texts("#toasts .toast")
            )
        )
        good = find("std_msgs/msg/String")(data='<robot name="good"><link name="base"/></robot>')
        publisher.publish(good)
        page.until("Object.values(coframe.displays).some((one) => one.robot === 'good')")


@pytest.mark.parametrize(
    ("size", "message_part"),
    [
        (210 << 20, "At most 200 MB can be drawn."),
        (300 << 20, "at most 256 MB are served"),
    ],
)
@pytest.mark.slow
def test_a_mesh_of_hundreds_of_megabytes_is_rejected(tmp_path, view, open_page, size, message_part):
    with (tmp_path / "huge.stl").open("wb") as file:
        file.truncate(size)
    urdf = tmp_path / "robot.urdf"
    urdf.write_text(ESCAPE.format("huge.stl"))
    page = open_page(view(small_buffer(), robot=urdf).url).drawn()
    page.tab("displays")
    page.wait(lambda: any(message_part in text for text in page.texts("#body-displays .status")), message_part)
    page.shows("base")


def test_pages_of_other_sites_cannot_connect(view, open_page):
    page = open_page(view(small_buffer()).url, expected_errors=["WebSocket"]).drawn()
    foreign_page = page.raw.context.new_page()
    foreign_page.goto("about:blank")
    ended = foreign_page.evaluate(
        """url => new Promise((done) => {
            const socket = new WebSocket(url);
            socket.onmessage = (event) => done('received ' + event.data);
            socket.onclose = (event) => done(event.code);
        })""",
        page.url.replace("http", "ws") + "ws",
    )
    assert ended == 1006
    own = page.evaluate(
        """url => new Promise((done) => {
            const socket = new WebSocket(url);
            socket.onmessage = (event) => done(JSON.parse(event.data).type);
        })""",
        page.url.replace("http", "ws") + "ws",
    )
    assert own == "hello"


def test_invalid_messages_of_a_page_are_answered_and_affect_no_other_page(view, open_page):
    page = open_page(view(small_buffer()).url).drawn()
    answers = page.evaluate(
        """([url, garbage]) => new Promise((done) => {
            const socket = new WebSocket(url);
            const problems = [];
            socket.onopen = () => {
                for (const text of garbage) socket.send(text);
                socket.send(new Uint8Array(1000));
            };
            socket.onmessage = ({data}) => {
                if (typeof data !== 'string' || JSON.parse(data).type !== 'problem') return;
                if (problems.push(data) === 5) socket.send('x'.repeat(2 << 20));
            };
            socket.onclose = ({code}) => done([code, problems.length]);
        })""",
        [page.url.replace("http", "ws") + "ws", ["", "nonsense", "[]", '{"type":"time","mode":"at","at":1e400}']],
    )
    assert answers == [1009, 5]
    page.key("Space")
    page.step("ArrowLeft", -1)


def test_invalid_messages_of_a_server_are_counted_and_ignored(view, open_page):
    """A relay inserts messages between the server and the page."""
    viewer = view(small_buffer())
    relayed = []

    def relay(socket):
        server = socket.connect_to_server()
        relayed.append(socket)

        server.on_message(socket.send)

    page = open_page(viewer.url, relay=relay).drawn()
    page.pause()
    for garbage in GARBAGE:
        relayed[-1].send(garbage if isinstance(garbage, bytes) else json.dumps(garbage))
    page.until("coframe.invalidMessages > 0")
    page.step("ArrowLeft", -1)


GARBAGE = [
    None,
    [],
    {"type": 7},
    {"type": "nothing"},
    b"",
    b"\x01",
    b"\x01\0\0\0" + b"\xff" * 60,
    b"\x02\0\0\0" + b"\xff" * 60,
    b"\x03\0\0\0" + b"\xff" * 60,
    b"\x04\0\0\0" + b"\xff" * 60,
    b"\x63\0\0\0" + b"\0" * 60,
    {"type": "problem", "text": "<img src=x onerror=window.hacked=1>" * 100, "hint": ""},
    {"type": "display", "id": 99, "state": "error", "text": "not requested"},
]


# Local storage may contain anything: pages of other programs on this address, and of other versions, share it.
SETTINGS = ("bookmarks", "displays", "dock-width", "groups", "panes", "plots", "rviz", "scene-panes", "states", "tab")
SETTINGS += ("table-count", "table-topic", "views")
GROUPS = [{"source": a, "group": b, "name": a, "enabled": True} for a, b in ("AB", "BA", "CC", ("D", ""), ("D", ""))]
DISPLAY = {"class": "Grid", "enabled": True, "topic": None, "options": {}}
MIXED_SETTINGS = {
    "displays": [None, 5, *({**DISPLAY, "name": f"in {group}", "group": group} for group in "ABCD")],
    "groups": [None, "x", *GROUPS],
    "panes": ["plots", None, 5],
    "plots": [None, {}, "map->base.x"],
    "scene-panes": [None, {"kind": "top"}, {"kind": "top", "frame": None}],
    "states": [[], 7, "/state.data"],
    "views": [
        None,
        {"view": {"class": "Orbit", "options": {}}},
        {"name": "kept", "view": {"class": "x", "options": {}}},
    ],
}


@pytest.mark.parametrize("settings", [dict.fromkeys(SETTINGS), {key: {} for key in SETTINGS}, MIXED_SETTINGS])
def test_settings_of_any_form_leave_the_page_usable(view, open_page, settings):
    viewer = view(small_buffer(), fixed="map")
    stored = [{"name": f"coframe.{key}", "value": json.dumps(value)} for key, value in settings.items()]
    storage = {"cookies": [], "origins": [{"origin": viewer.url.rstrip("/"), "localStorage": stored}]}
    page = open_page(f'{viewer.url}#view={{"class":"Orbit","options":null}}&layout=[1]', storage_state=storage)
    notes = page.wait(lambda: len(page.texts("#toasts > *")) > 1 and page.texts("#toasts > *"), "both notes")
    assert [part for part in ("view", "layout") if f"The {part} in the address" in "".join(notes)] == ["view", "layout"]
    page.drawn()
    if settings is MIXED_SETTINGS:
        page.until("document.querySelector('#pane-plots')?.hidden === false && coframe.panes.length === 1")
        page.tab("displays")
        assert page.evaluate("[...document.querySelectorAll('.display-group')].map(g => g.dataset.group)") == ["D"]
        names = page.evaluate("[...document.querySelectorAll('.card')].map(card => card.dataset.display)")
        assert [name for name in names if name.startswith("in ")] == ["in A", "in B", "in C", "in D"]
        assert page.raw.locator("#views button:text('kept')").count() == 1


def test_a_message_that_cannot_be_read_is_named_in_the_table_and_in_its_file(tmp_path, view, open_page):
    reports = enumerate((b'{"a": 1}', b"{", b'{"b": 2}'))
    rows = [*recordings.messages(), *(("/report", recordings.START + i, data) for i, data in reports)]
    types = {"/report": ("Report", "jsonschema", b"{}", "json")}
    recordings.write_mcap(tmp_path / "report.mcap", rows=rows, types=types)
    page = open_page(f"{view(tmp_path / 'report.mcap').url}#panel=table")
    page.raw.fill("#pane-table input", "/report")
    page.key("Enter")
    page.scrub(0.9)
    page.wait(lambda: page.text("#table-facts") == "Report · 3 messages", "the messages")
    assert page.texts("#pane-table thead th") == ["time", "a", "b"]
    cells = [row.split("\t")[1:] for row in page.texts("#table-rows tr")]
    assert cells[0] == ["", "2"]
    assert cells[2][0] == "1"  # It may have been shown before the table had two columns.
    assert cells[1][0].startswith("the message cannot be read: Report:")
    with page.raw.expect_download() as download:
        page.click("#pane-table button:text('CSV')")
    written = list(csv.reader(download.value.path().read_text("utf-8").splitlines()))
    assert written[0] == ["stamp_ns", "a", "b", "problem"]
    assert written[1] == [str(recordings.START), "1", "", ""]
    assert written[2][3].startswith("the message cannot be read: Report:")
