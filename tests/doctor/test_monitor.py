# SPDX-License-Identifier: Apache-2.0
"""Figures of edges, publishers and chains."""

import json
import re

import numpy as np
import pytest
from click.testing import CliRunner
from recordings import START
from runs import MS, SECOND, Run

from coframe.cli.app import app
from coframe.cli.monitor import _print_classic, _printer
from coframe.connection.listener_config import ListenerConfig
from coframe.doctor import observe_recording
from coframe.doctor.live import LiveObserver
from coframe.doctor.statistics import chain_statistics, edge_statistics, publisher_statistics


@pytest.fixture
def seen(tmp_path):
    run = Run.healthy(seconds=4, skip={"scan"}, latency=2 * MS)
    for i in range(40):
        at = START + i * SECOND // 10
        run.tf("base_link", "arm", at, (0.1 * i, 0, 0), arrived=at + 30 * MS)
    (observation,) = observe_recording(run.write(tmp_path)).values()
    return observation


def test_rate_jitter_and_delay_of_edges(seen):
    rows = {(row.parent, row.child): row for row in edge_statistics(seen)}
    drive, arm, mount = rows["odom", "base_link"], rows["base_link", "arm"], rows["base_link", "lidar"]
    assert drive.rate == pytest.approx(50.0)
    assert arm.rate == pytest.approx(10.0)
    assert (drive.delay, drive.delay_p99, drive.delay_max) == (2 * MS, 2 * MS, 2 * MS)
    assert arm.delay == 30 * MS
    assert drive.jitter == pytest.approx(0.0, abs=1.0)
    # The recording ends with the last transform of base_link, 3.982 s after its start; arm ends at 3.9 s.
    assert (drive.age, arm.age) == (2 * MS, 82 * MS)
    assert mount.static
    assert mount[5:] == (*(None,) * 6, False), "a static edge has no rate, delay and age"


def test_publisher_counts_messages_not_transforms(seen):
    (everyone,) = publisher_statistics(seen)
    assert everyone.messages == 200 + 40 - 0
    assert everyone.delay == pytest.approx((200 * 2 * MS + 40 * 30 * MS) / 240)


def test_chain_is_limited_by_its_slowest_edge(seen):
    chain = chain_statistics(seen, "odom", "arm")
    assert chain.frames == ["odom", "base_link", "arm"]
    assert chain.limit == ("base_link", "arm")
    # Stamps every 100 ms that arrive 30 ms later are 30 to 130 ms old, 80 ms on average.
    assert chain.delay == pytest.approx(80 * MS, rel=0.05)
    assert chain.delay_max == pytest.approx(130 * MS, rel=0.02)
    up_and_down = chain_statistics(seen, "lidar", "arm")
    assert up_and_down.frames == ["lidar", "base_link", "arm"]


def test_static_and_missing_chains(seen):
    assert chain_statistics(seen, "base_link", "lidar").limit is None
    assert chain_statistics(seen, "base_link", "nowhere") is None
    assert chain_statistics(seen, "arm", "arm").frames == ["arm"]


def test_stale_edge_limits_the_chain(tmp_path):
    run = Run.healthy(seconds=4, skip={"scan"})
    for i in range(20):
        run.tf("base_link", "arm", START + i * SECOND // 50, (0.1 * i, 0, 0))
    (observation,) = observe_recording(run.write(tmp_path)).values()
    chain = chain_statistics(observation, "odom", "arm")
    assert chain.limit == ("base_link", "arm")
    assert chain.limit_share > 0.85
    assert np.isclose(chain.delay_max, observation.end - START - 19 * SECOND // 50)


class Irregular:
    """Two edges with irregular messages, and the expected figures."""

    def __init__(self, folder):
        random = np.random.default_rng(7)
        self.sent = {
            ("map", "odom"): np.sort(random.uniform(0, 10, 300)),
            ("odom", "base_link"): np.arange(0, 10, 0.02) + random.uniform(0, 0.005, 500),
        }
        self.took = {edge: random.gamma(2.0, 0.01, len(sent)) for edge, sent in self.sent.items()}
        run = Run()
        for edge, sent in self.sent.items():
            for number, (stamp, took) in enumerate(zip(sent, self.took[edge], strict=True)):
                at = START + round(stamp * SECOND)
                run.tf(*edge, at, (number, 0, 0), arrived=at + round(took * SECOND))
        (self.seen,) = observe_recording(run.write(folder)).values()
        self.end = max((self.sent[edge] + self.took[edge]).max() for edge in self.sent)

    def newest(self, edge, now):
        """Return the newest stamp that has arrived by a time."""
        return self.sent[edge][self.sent[edge] + self.took[edge] <= now].max()


@pytest.fixture
def irregular(tmp_path):
    return Irregular(tmp_path)


def test_figures_of_edges_match_the_expected_ones(irregular):
    for row in edge_statistics(irregular.seen):
        sent, took = irregular.sent[row.parent, row.child], irregular.took[row.parent, row.child]
        intervals = np.diff(np.sort(sent + took))
        assert row.transforms == len(sent)
        assert row.rate == pytest.approx(1 / intervals.mean())
        assert row.jitter == pytest.approx(intervals.std() * SECOND, rel=1e-6)
        assert row.delay == pytest.approx(took.mean() * SECOND, rel=1e-6)
        assert row.delay_p99 == pytest.approx(np.percentile(took, 99) * SECOND, rel=1e-6)
        assert row.delay_max == pytest.approx(took.max() * SECOND, rel=1e-6)
        assert row.age == pytest.approx((irregular.end - sent.max()) * SECOND, abs=2)


def test_figures_of_a_chain_match_frequent_lookups(irregular):
    chain = chain_statistics(irregular.seen, "base_link", "map")
    begun = max((irregular.sent[edge] + irregular.took[edge]).min() for edge in irregular.sent)
    moments = np.linspace(begun + 1e-6, irregular.end, 4001)
    newest = np.array([[irregular.newest(edge, now) for now in moments] for edge in irregular.sent])
    ages = moments - newest.min(axis=0)
    share = np.mean(newest[0] < newest[1])
    assert share > 0.5, "the edge with the lower rate limits the chain"
    assert chain.frames == ["base_link", "odom", "map"]
    assert chain.limit == ("map", "odom")
    assert chain.limit_share == pytest.approx(share, abs=0.02)
    assert chain.delay == pytest.approx(ages.mean() * SECOND, rel=0.02)
    assert chain.delay_p99 == pytest.approx(np.percentile(ages, 99) * SECOND, rel=0.05)


def test_classic_format_is_that_of_tf2_monitor(seen, capsys):
    """Like tf2_monitor: three line breaks, a blank line before the frames, and the second heading on stderr."""
    _print_classic(seen, ("odom", "lidar"))
    printed = capsys.readouterr()
    assert printed.err == "\nAll Broadcasters:\n"
    assert re.fullmatch(
        r"\n\n\nRESULTS: for odom to lidar\n"
        r"Chain is: odom -> base_link -> lidar\n"
        r"Net delay     avg = 0\.01\d+: max = 0\.02\d*\n"
        r"\nFrames:\n"
        r"(?=(?:.*\n)*Frame: base_link, published by <no authority available>, Average Delay: 0\.002, "
        r"Max Delay: 0\.002\n)"
        r"(?=(?:.*\n)*Frame: lidar, published by <no authority available>, Average Delay: 0, Max Delay: 0\n)"
        r"(?:Frame: .*\n){3}"
        r"Node: <no authority available> \d+\.\d+ Hz, Average Delay: 0\.00666667 Max Delay: 0\.03\n",
        printed.out,
    )
    _print_classic(seen, None)
    assert capsys.readouterr().out.startswith("\n\n\nRESULTS: for all Frames\n\nFrames:\nFrame: ")


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["a"], "SOURCE is missing"),
        (["--json", "--classic"], "--json cannot be combined with --classic"),
        (["--duration", "0s"], "greater than 0"),
    ],
)
def test_wrong_usage_gives_a_message(arguments, text):
    result = CliRunner().invoke(app, ["monitor", *arguments])
    assert result.exit_code == 2
    assert text in result.output


def test_a_silent_graph_says_what_to_check(domain_id, capsys):
    with LiveObserver(ListenerConfig.of(domain=domain_id), window=SECOND) as observer:
        observation = observer.observe()
    _printer(as_json=False, classic=False)(observation, None)
    question = "s a broadcaster running in the same ROS domain?"
    assert f"no transforms received yet: i{question}" in capsys.readouterr().out.replace("\n", " ")
    output = CliRunner().invoke(app, ["doctor", "--duration", "0.3s"]).output
    assert f"nothing to examine. I{question}" in output


@pytest.mark.slow
def test_live_command_names_publishers(inside):
    inside.start("-m", "coframe.lab.complete_tf_tree")

    def monitor(*options):
        return inside.run("-m", "coframe.cli", "monitor", "map", "camera_link", "--once", *options)

    data = {"edges": []}
    while len(data["edges"]) < 10 or data["chain"] is None:
        data = json.loads(monitor("--json", "--duration", "2s").stdout)
    classic = monitor("--classic", "--duration", "2s").stdout
    assert {row["publisher"] for row in data["edges"]} == {"/complete_tf_tree"}
    assert data["chain"]["frames"][:3] == ["map", "odom", "base_link"]
    assert data["chain"]["frames"][-1] == "camera_link"
    assert (
        "Chain is: map -> odom -> base_link -> link1 -> link2 -> end_effector -> camera_link\nNet delay     avg = "
        in classic
    )
    assert "Frame: camera_link, published by /complete_tf_tree, Average Delay: 0, Max Delay: 0" in classic
    assert "Node: /complete_tf_tree " in classic
