# SPDX-License-Identifier: Apache-2.0
"""Relations between two frames, and the timeline."""

import base64
import shlex

import numpy as np
import pytest

import coframe
from coframe.cli.static_arguments import parse

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND


@pytest.fixture
def buffer():
    buffer = coframe.Buffer(None)
    for tenth in range(101):
        turned = coframe.Transform.from_rpy([tenth, 2.0, 0.0], [0.1, -0.2, 0.3 + tenth / 100])
        buffer.set("map", "base", turned, BEGIN + tenth * SECOND // 10)
    for tenth in (0, 1, 2, 3, 80, 81):
        buffer.set("base", "arm", coframe.Transform([0.0, 0.0, tenth]), BEGIN + tenth * SECOND // 10)
    buffer.set("base", "the lidar", coframe.Transform([0.1, 0.0, 0.3]), static=True)
    buffer.set("dock", "charger", coframe.Transform(), BEGIN)
    return buffer


def test_a_relation_in_every_notation(buffer, view, open_tab):
    tab = open_tab(view(buffer))
    received = tab.ask("relation", "relate", id=7, target="map", source="the lidar")
    expected = buffer.lookup("map", "the lidar")
    assert (received["id"], received["ok"], received["error"]) == (7, True, None)
    assert int(tab.last["hello"]["origin"]) + received["stamp"] == expected.stamp
    np.testing.assert_allclose(received["translation"], expected.translation)
    np.testing.assert_allclose(received["quaternion"], expected.quaternion)
    np.testing.assert_allclose(received["rpy_deg"], np.degrees(expected.rpy))
    np.testing.assert_allclose(np.reshape(received["matrix"], (4, 4)), expected.matrix)
    assert received["chain"] == ["the lidar", "base", "map"]
    words = shlex.split(received["static_command"])
    assert words[:2] == ["coframe", "static"]
    static = parse(words[2:])
    assert (static.frame_id, static.child_frame_id) == ("map", "the lidar")
    np.testing.assert_allclose(static.transform.values, expected.values, atol=1e-6)


def test_a_relation_at_the_displayed_time(buffer, view, open_tab):
    tab = open_tab(view(buffer))
    origin = int(tab.wait("hello")["origin"])
    tab.send("time", mode="at", at=BEGIN + SECOND // 4 - origin)
    received = tab.ask("relation", "relate", id=1, target="arm", source="map")
    expected = buffer.lookup("arm", "map", BEGIN + SECOND // 4)
    np.testing.assert_allclose(received["translation"], expected.translation)
    assert received["chain"] == ["map", "base", "arm"]


@pytest.mark.parametrize(
    ("target", "source", "at", "chain", "broken_at", "reason"),
    [
        ("map", "charger", None, ["charger", "dock", "map"], "dock", "not part of the same tree"),
        ("map", "lider", None, ["lider", "map"], "lider", "does not exist"),
        ("map", "arm", 9.5, ["arm", "base", "map"], "arm", "extrapolation into the future"),
        ("the lidar", "arm", 9.5, ["arm", "base", "the lidar"], "arm", "extrapolation into the future"),
    ],
)
def test_a_missing_relation_gives_the_reason(buffer, view, open_tab, target, source, at, chain, broken_at, reason):
    tab = open_tab(view(buffer))
    origin = int(tab.wait("hello")["origin"])
    if at is not None:
        tab.send("time", mode="at", at=BEGIN + at * SECOND - origin)
    received = tab.ask("relation", "relate", id=1, target=target, source=source)
    assert (received["ok"], received["matrix"], received["chain"], received["broken_at"]) == (
        False,
        None,
        chain,
        broken_at,
    )
    assert reason in received["error"]
    assert received["hint"]


def test_the_timeline_counts_samples_and_lists_gaps(buffer, view, open_tab):
    tab = open_tab(view(buffer))
    hello = tab.wait("hello")
    first, last = hello["span"]
    received = tab.ask("timeline", "timeline", **{"from": first, "to": last, "bins": 10})
    assert (received["bins"], received["from"], received["to"]) == (10, first, last)
    names = [frame["name"] for frame in tab.last["tree"]["frames"]]
    edges = {names[edge["frame"]]: edge for edge in received["edges"]}
    assert set(edges) == {"base", "arm", "charger"}

    def counts(name):
        return np.frombuffer(base64.b64decode(edges[name]["counts"]), "<u2").tolist()

    assert counts("base") == [10] * 9 + [11]
    assert counts("arm") == [4, 0, 0, 0, 0, 0, 0, 0, 2, 0]
    assert edges["base"]["gaps"] == []
    assert edges["arm"]["gaps"] == [[first + 3 * SECOND // 10, first + 8 * SECOND]]


def test_steps_move_from_stamp_to_stamp_and_stop_at_the_ends(view, open_tab):
    buffer = coframe.Buffer(None)
    for second in (0, 1, 1000):
        buffer.set("map", "base", coframe.Transform([second, 0.0, 0.0]), BEGIN + second * SECOND)
    tab = open_tab(view(buffer))
    first, _ = tab.wait("hello")["span"]
    tab.send("time", mode="at", at=first + SECOND // 2)
    for direction, expected in ((1, SECOND), (1, 1000 * SECOND), (1, 1000 * SECOND), (-1, SECOND), (-1, 0)):
        tab.send("step", direction=direction)
        tab.frame_update(lambda update, expected=expected: update.time == first + expected)
