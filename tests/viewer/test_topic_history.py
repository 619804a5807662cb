# SPDX-License-Identifier: Apache-2.0
"""The table of a topic and the states of its fields, as a page receives them."""

import contextlib
import json
from types import SimpleNamespace

import pytest
import recordings
from recordings import START
from runs import MS, SECOND, Run

import coframe
from coframe.errors import PlotError
from coframe.messages import find
from coframe.viewer.panels.states import StateHistory, parse_state_field, read_histories, state_text
from coframe.viewer.sources.topic_messages import StampedMessage

STATES = ["idle", "idle", "driving", "driving", "driving", "docked", "idle"]


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    run = Run.healthy(seconds=4)
    for i, state in enumerate(STATES):
        at = START + i * SECOND // 2 + MS
        run.message("/state", "std_msgs/msg/String", find("std_msgs/msg/String")(data=state), at)
        status = find("action_msgs/msg/GoalStatusArray")()
        if i > 2:
            status.status_list.append(find("action_msgs/msg/GoalStatus")(status=2 if i < 5 else 4))
        run.message("/goals", "action_msgs/msg/GoalStatusArray", status, at)
    with coframe.open_bag(run.write(tmp_path_factory.mktemp("history"))) as recording:
        yield recording


@pytest.fixture
def tab(view, open_tab, recording):
    tab = open_tab(view(recording))
    tab.has("hello")
    return tab


def states(tab, number):
    """Return the changes of a field as seconds and texts, once its topic is read, and its last message."""
    found = []

    def collect(message):
        if message["id"] == number:
            found[:] = [] if message["reset"] else found
            found.extend(
                (round((one["stamp"] + origin - START) / SECOND, 2), one["text"]) for one in message["changes"]
            )
        return message["id"] == number and message["state"] != "waiting" and not message["changes"]

    origin = int(tab.has("hello")["origin"])
    return tab.wait("states", collect), found


def test_the_states_of_a_recorded_field(tab):
    fields = ["/state.data", "/goals.status_list[0].status", "/state.date", "/tf", "/nothing.data"]
    tab.send("states", fields=[{"id": i, "expression": text} for i, text in enumerate(fields)])
    last, changes = states(tab, 0)
    assert changes == [(0.0, "idle"), (1.0, "driving"), (2.5, "docked"), (3.0, "idle")]
    origin = int(tab.has("hello")["origin"])
    assert round((last["until"] + origin - START) / SECOND, 2) == 3.0
    tab.send("states", fields=[{"id": 1, "expression": fields[1]}])
    last, changes = states(tab, 1)
    assert changes == [(1.5, "2 STATUS_EXECUTING"), (2.5, "4 STATUS_SUCCEEDED")]
    assert last["text"] == "3 messages without a value"
    for number, text in ((2, "Did you mean 'data'?"), (3, "contains a topic, but no field")):
        tab.send("states", fields=[{"id": 7 + number, "expression": fields[number]}])
        assert text in tab.wait("states", lambda one, n=number: one["id"] == 7 + n and one["state"] == "error")["text"]
    for _ in range(10):  # Each request has an answer, also if an earlier one was the same.
        tab.send("states", fields=[{"id": 4, "expression": fields[4]}])
        assert tab.wait("states", lambda one: one["id"] == 4)["text"] == "there are no messages on /nothing"
        tab.send("states", fields=[])
    tab.send("states", fields=[{"id": i, "expression": "/state.data"} for i in range(17)])
    assert "at most 16 fields" in tab.wait("problem")["text"]


def test_the_table_follows_the_displayed_time(tab):
    origin = int(tab.has("hello")["origin"])

    def show(seconds, first, last):
        at = START + round(seconds * SECOND) - origin
        tab.send("time", mode="at", at=at, playing=False, speed=1.0, loop=None)
        return tab.wait("table", lambda table: (table["first"], table["last"]) == (first, last))

    tab.send("time", mode="at", at=START + SECOND - origin, playing=False, speed=1.0, loop=None)
    tab.send("table", topic="/state", rows=3)
    table = tab.wait("table", lambda table: table["rows"])
    assert table["message_type"] == "std_msgs/msg/String"
    assert table["columns"] == [{"path": "data", "type": "string"}]
    assert [(row["key"], row["cells"]) for row in table["rows"]] == [(1, ["idle"]), (2, ["idle"])]
    table = show(2.2, 3, 5)
    assert [row["cells"] for row in table["rows"]] == [["driving"]] * 3, "the earlier rows are not in it"
    assert show(1.7, 2, 4)["rows"][0]["key"] == 2, "a row that was dropped is sent again"
    tab.send("table", topic="/goals", rows=1)
    table = tab.wait("table", lambda table: table["topic"] == "/goals" and table["rows"])
    assert [column["path"] for column in table["columns"]] == ["status_list"], "a sequence is one column"
    assert table["rows"][0]["cells"] == ["1 element"]
    tab.send("table", topic="/nothing", rows=1)
    assert tab.wait("table", lambda table: table["topic"] == "/nothing")["text"] == "there are no messages on /nothing"


def test_what_is_not_shown_of_states_is_said(json_tab):
    long = ["x" * 100 + end for end in "abb"]
    mode = [{"mode": "a"}, {}, {"mode": "b"}]
    tab = json_tab(long=[{"text": one} for one in long], mode=mode, many=[{"n": i} for i in range(5001)], late=mode[1:])
    for number, (field, note, expected) in enumerate(
        [
            ("/long.text", "", ["x" * 100 + "…"] * 2),
            ("/mode.mode", "1 message without a value", ["a", "b"]),
            ("/late.mode", "1 message without a value", ["b"]),
            ("/many.n", "only the last 5000 of 5001 changes are shown", [str(i) for i in range(5001)]),
        ]
    ):
        tab.send("states", fields=[{"id": number, "expression": field}])
        last, changes = states(tab, number)
        assert (last["state"], last["text"]) == ("ok", note)
        assert [text for _, text in changes] == expected
    tab.send("states", fields=[{"id": id_, "expression": "/many.n"} for id_ in (5, 6)])
    order = []

    def collect(message):
        order.extend([message["id"]] * len(message["changes"]))
        return order.count(5) == order.count(6) == 5001

    tab.wait("states", collect)
    assert 5 in order[order.index(6) :], "the fields are not read in turn"
    tab.send("states", fields=[{"id": 9, "expression": "/many.m"}])
    assert "has no field 'm'. Fields: n." in tab.wait("states", lambda one: one["state"] == "error")["text"]


def test_fields_of_a_topic_are_read_together(json_tab, monkeypatch):
    from coframe.viewer.sources.recorded import RecordedMessages

    reads = []
    read = RecordedMessages._read
    monkeypatch.setattr(RecordedMessages, "_read", lambda self, index: reads.append(index) or read(self, index))
    tab = json_tab(both=[{"n": i, "m": i // 2} for i in range(1200)])
    fields = ["/both.n", "/both.m", "/both.nothing"]
    tab.send("states", fields=[{"id": i, "expression": text} for i, text in enumerate(fields)])
    found = {0: [], 1: []}

    def collect(message):
        if message["id"] in found:
            found[message["id"]] += [one["text"] for one in message["changes"]]
        return len(found[0]) == 1200 and len(found[1]) == 600

    tab.wait("states", collect)
    assert found == {0: [str(i) for i in range(1200)], 1: [str(i) for i in range(600)]}
    assert sorted(reads) == list(range(1200)), "each message is read once"


def test_states_are_in_order_although_the_time_of_a_topic_jumps_back():
    stamps = [10, 20, 30, 15, 40]
    texts = ["a", "b", "c", "c", "d"]
    stored = [
        StampedMessage(key, stamp, lambda text=text: {"data": text})
        for key, (stamp, text) in enumerate(zip(stamps, texts, strict=True), start=1)
    ]
    messages = SimpleNamespace(
        type="", at=lambda _time: stored[-1], times=lambda: stamps, after=lambda key, last: stored[key:last]
    )
    history = StateHistory(parse_state_field("/state.data"), messages)
    assert read_histories([history]) == {}
    assert history.since(0) == [(10, "a"), (15, "c"), (40, "d")], "what was after the jump belongs to another time"
    assert (history.edition, history.total, history.until) == (1, 3, 40)


@pytest.fixture
def json_tab(tmp_path, view, open_tab):
    """Return a function that records topics of JSON and opens a tab; a message is an object, or its text."""

    opened = contextlib.ExitStack()

    def start(**topics):
        rows = [
            (f"/{topic}", START + i * SECOND, (one if isinstance(one, str) else json.dumps(one)).encode())
            for topic, messages in topics.items()
            for i, one in enumerate(messages)
        ]
        types = {f"/{topic}": ("Report", "jsonschema", b"{}", "json") for topic in topics}
        recordings.write_mcap(tmp_path / "reports.mcap", rows=sorted(rows, key=lambda row: row[1]), types=types)
        return open_tab(view(opened.enter_context(coframe.open_bag(tmp_path / "reports.mcap"))))

    with opened:
        yield start


def test_each_message_of_a_table_is_shown_whatever_its_fields_are(json_tab):
    wide = [{f"f{i}": i for i in range(41)}]
    tab = json_tab(mixed=[{"a": 1}, {}, {"b": {"c": [1, 2]}}, "{"], wide=wide, empty=[{}])
    tab.send("table", topic="/mixed", rows=9)
    table = tab.wait("table", lambda table: table["rows"])
    assert [column["path"] for column in table["columns"]] == ["a", "b.c"]
    assert [row["cells"] for row in table["rows"]] == [["1", ""], ["", ""], ["", "2 elements"], ["", ""]]
    assert [row["problem"][:30] for row in table["rows"]] == ["", "", "", "the message cannot be read: Re"]
    tab.send("table", topic="/wide", rows=9)
    table = tab.wait("table", lambda table: table["topic"] == "/wide" and table["rows"])
    assert len(table["columns"]) == 40
    assert table["text"] == "only the first 40 fields are shown"
    tab.send("table", topic="/empty", rows=9)
    assert tab.wait("table", lambda table: table["topic"] == "/empty" and table["rows"])["columns"] == []


def test_constants_give_states_their_names():
    level = find("diagnostic_msgs/msg/DiagnosticStatus")
    assert state_text(level(level=level.ERROR), parse_state_field("/a.level"), "") == "2 ERROR"
    marker = find("visualization_msgs/msg/Marker")
    assert state_text(marker(action=2), parse_state_field("/a.action"), "") == "2", "two constants have this value"
    assert state_text(marker(frame_locked=True), parse_state_field("/a.frame_locked"), "") == "true"
    with pytest.raises(PlotError, match=r"is a message, not a state"):
        state_text(marker(), parse_state_field("/a.pose"), "")
    with pytest.raises(PlotError, match=r"is not a field of a topic"):
        parse_state_field("odom:base_link.x")
