"""Figures of links, publishers and chains."""

import json

import numpy as np
import pytest
from recordings import START
from runs import MS, SECOND, Run
from typer.testing import CliRunner

from coframe.cli.app import app
from coframe.doctor import observe_recording
from coframe.doctor.figures import chain_figures, link_figures, publisher_figures


@pytest.fixture
def seen(tmp_path):
    run = Run.healthy(seconds=4, skip={"scan"}, latency=2 * MS)
    for i in range(40):
        at = START + i * SECOND // 10
        run.tf("base_link", "arm", at, (0.1 * i, 0, 0), arrived=at + 30 * MS)
    (observation,) = observe_recording(run.write(tmp_path)).values()
    return observation


def test_rate_jitter_and_delay_of_links(seen):
    rows = {(row.parent, row.child): row for row in link_figures(seen)}
    drive, arm, mount = rows["odom", "base_link"], rows["base_link", "arm"], rows["base_link", "lidar"]
    assert drive.rate == pytest.approx(50.0)
    assert arm.rate == pytest.approx(10.0)
    assert (drive.delay, drive.delay_p99, drive.delay_max) == (2 * MS, 2 * MS, 2 * MS)
    assert arm.delay == 30 * MS
    assert drive.jitter == pytest.approx(0.0, abs=1.0)
    # The recording ends as the drive's last transform comes, 3.982 s after its start; the arm's newest stamp is 3.9 s.
    assert (drive.age, arm.age) == (2 * MS, 82 * MS)
    assert mount.static
    assert mount[5:] == (None,) * 6, "what is static has neither rate nor delay nor age"


def test_a_publisher_counts_messages_not_transforms(seen):
    (everyone,) = publisher_figures(seen)
    assert everyone.messages == 200 + 40 - 0
    assert everyone.delay == pytest.approx((200 * 2 * MS + 40 * 30 * MS) / 240)


def test_a_chain_is_limited_by_its_slowest_link(seen):
    chain = chain_figures(seen, "odom", "arm")
    assert chain.frames == ["odom", "base_link", "arm"]
    assert chain.limit == ("base_link", "arm")
    # Stamps every 100 ms that come 30 ms later: 30 to 130 ms old, half of it on average.
    assert chain.delay == pytest.approx(80 * MS, rel=0.05)
    assert chain.delay_max == pytest.approx(130 * MS, rel=0.02)
    up_and_down = chain_figures(seen, "lidar", "arm")
    assert up_and_down.frames == ["lidar", "base_link", "arm"]


def test_chains_that_do_not_move_or_are_none(seen):
    assert chain_figures(seen, "base_link", "lidar").limit is None
    assert chain_figures(seen, "base_link", "nowhere") is None
    assert chain_figures(seen, "arm", "arm").frames == ["arm"]


def test_a_stopped_link_limits_the_chain(tmp_path):
    run = Run.healthy(seconds=4, skip={"scan"})
    for i in range(20):
        run.tf("base_link", "arm", START + i * SECOND // 50, (0.1 * i, 0, 0))
    (observation,) = observe_recording(run.write(tmp_path)).values()
    chain = chain_figures(observation, "odom", "arm")
    assert chain.limit == ("base_link", "arm")
    assert chain.limit_share > 0.85
    assert np.isclose(chain.delay_max, observation.end - START - 19 * SECOND // 50)


@pytest.mark.parametrize(
    ("arguments", "text"),
    [(["a"], "give two frames, or none"), (["--json", "--classic"], "exclude"), (["--duration", "0s"], "more than 0")],
)
def test_wrong_usage_is_a_sentence(arguments, text):
    result = CliRunner().invoke(app, ["monitor", *arguments])
    assert result.exit_code == 2
    assert text in result.output


def test_the_command_names_publishers_live(inside):
    inside.start("-m", "coframe.lab.complete_tf_tree")

    def monitor(*options):
        return inside.run("-m", "coframe.cli", "monitor", "map", "camera_link", "--once", *options)

    data = {"links": []}
    while len(data["links"]) < 10 or data["chain"] is None:
        data = json.loads(monitor("--json", "--duration", "2s").stdout)
    classic = monitor("--classic", "--duration", "2s").stdout
    assert {row["publisher"] for row in data["links"]} == {"/complete_tf_tree"}
    assert data["chain"]["frames"][:3] == ["map", "odom", "base_link"]
    assert data["chain"]["frames"][-1] == "camera_link"
    assert (
        "Chain is: map -> odom -> base_link -> link1 -> link2 -> end_effector -> camera_link\nNet delay     avg = "
        in classic
    )
    assert "Frame: camera_link, published by /complete_tf_tree, Average Delay: 0, Max Delay: 0" in classic
    assert "Node: /complete_tf_tree " in classic
