# SPDX-License-Identifier: Apache-2.0
"""The same problem of many edges or topics is one finding, which names a few and counts the rest; JSON has all."""

import numpy as np
import pytest
from recordings import START
from runs import MS, SECOND, Run, rpy, yaw

from coframe.doctor.rendering.plain import as_data
from coframe.messages import find

NAMES = [f"limb{letter}" for letter in "abcdefgh"]


def later(seconds):
    return START + round(seconds * SECOND)


def edges(publish):
    """Return a healthy run in which each of eight limbs has the same problem."""
    run = Run.healthy()
    for name in NAMES:
        publish(run, name)
    return run


def moving(run, name, **options):
    for i in range(600):
        at = later(i / 50)
        run.drive(at, "base_link", name, **{key: value(i, at) for key, value in options.items()})


def two_parents(run, name):
    for i in range(120):
        run.drive(later(i / 10), "base_link", name)
        run.drive(later(i / 10 + 0.01), f"other_{name}", name)
    run.tf("base_link", f"other_{name}", START, static=True)


def both_topics(run, name):
    run.tf("base_link", name, START, static=True)
    moving(run, name)


def seldom(run, name):
    for i in range(12):
        run.drive(later(i), "base_link", name)


def constant(run, name):
    for i in range(600):
        run.tf("base_link", name, later(i / 50) + NAMES.index(name) + 1)


def wrong_norm(run, name):
    run.tf("base_link", name, START, turn=(0, 0, 0.3, 0.3), static=True)


def teleported(run, name):
    for i in range(600):
        run.tf("base_link", name, later(i / 50), (i / 100 + 8 * (i >= 300) + NAMES.index(name), 0, 0), yaw(i / 300))


def degrees(run, name):
    run.tf("base_link", name, START, (0.1, 0, NAMES.index(name) / 10), rpy(0, 0, 90.0), static=True)


def unknown_frame(run, name):
    for i in range(100):
        run.scan(later(i / 10), f"lidar_{name}", topic=f"/{name}/scan")


def unset(run, name):
    for i in range(100):
        message = find("sensor_msgs/msg/LaserScan")()
        message.header.frame_id = "lidar"
        run.message(f"/{name}/scan", "sensor_msgs/msg/LaserScan", message, later(i / 10))


def long_ago(run, name):
    for i in range(60):
        run.scan(later(i / 10), "lidar", arrived=later(i / 10 + 11.5), topic=f"/{name}/scan")


def off_clock(run, name):
    moving(run, name, stamp=lambda _, at: at - 7000 * SECOND)
    for i in range(100):  # Most sensors and edges are on the right clock.
        run.scan(later(i / 10), topic=f"/{name}/scan")


def lost_tree(run, name):
    run.tf(f"shelf_{name}", f"box_{name}", START, static=True)


EDGES = {
    "TF002": two_parents,
    "TF003": lambda run, name: moving(run, name, offset=lambda i, _: 0.5 * (i % 2)),
    "TF005": both_topics,
    "TF008": lambda run, name: moving(run, name, stamp=lambda _, at: at - 900 * MS - MS * NAMES.index(name) * 50),
    "TF009": off_clock,
    "TF010": lambda run, name: moving(run, name, stamp=lambda _, at: at - 300 * MS),
    "TF011": lambda run, name: moving(run, name, stamp=lambda i, _: later((i // 2) / 25)),
    "TF013": seldom,
    "TF018": constant,
    "TF019": wrong_norm,
    "TF020": teleported,
    "TF021": degrees,
}
TOPICS = {"TF014": unknown_frame, "TF008": unset, "TF015": long_ago}


@pytest.mark.parametrize("code", EDGES)
def test_many_edges_with_one_problem_are_one_finding(examine, code):
    report = examine(edges(EDGES[code]))
    (finding,) = [one for one in report.every_finding() if one.code == code]
    assert {edge[1] for edge in finding.edges} >= set(NAMES)
    named = [name for name in NAMES if name in finding.text or name in finding.subject]
    assert "more" in finding.text
    assert 0 < len(named) < len(NAMES)
    data = as_data(report)["findings"]
    (row,) = [one for cause in data for one in (cause, *cause["explains"]) if one["code"] == code]
    assert {edge[1] for edge in row["edges"]} >= set(NAMES)


@pytest.mark.parametrize("code", TOPICS)
def test_many_topics_with_one_problem_are_one_finding(examine, code):
    report = examine(edges(TOPICS[code]))
    (finding,) = [one for one in report.every_finding() if one.code == code]
    assert set(finding.topics) == {f"/{name}/scan" for name in NAMES}
    assert "the same for 7 other topics: /limbb/scan, /limbc/scan" in finding.text
    assert "and 2 more" in finding.text
    data = as_data(report)["findings"]
    (row,) = [one for cause in data for one in (cause, *cause["explains"]) if one["code"] == code]
    assert row["topics"] == list(finding.topics)


def test_many_trees_without_a_likely_connection_are_one_finding(only):
    finding = only(edges(lost_tree), "TF001")
    assert finding.text.startswith("9 separate trees: 'odom' with 2 frames below it, and 8 trees to whose roots no ")
    assert "'shelf_limbe' and 3 more" in finding.text
    assert finding.frames >= {f"box_{name}" for name in NAMES}


def test_different_problems_are_not_joined(examine):
    """Of ten edges, five are behind and five ahead of the clock: two findings, not one."""

    def publish(run, name):
        sign = 1 if NAMES.index(name) % 2 else -1
        moving(run, name, stamp=lambda _, at: at + sign * 3 * SECOND)

    found = [one for one in examine(edges(publish)).every_finding() if one.code == "TF008"]
    assert [len(one.edges) for one in found] == [4, 4]
    assert np.all([len({edge for one in found for edge in one.edges}) == 8])
