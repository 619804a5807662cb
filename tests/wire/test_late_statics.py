# SPDX-License-Identifier: Apache-2.0
"""Static transforms that arrive some time after their publisher was discovered, as from Fast DDS."""

import json

import pytest
from click.testing import CliRunner

import coframe
from coframe.cli.app import app

# A publisher that other nodes match, but that sends its transforms later.
LATE = """
import time
from coframe.messages import find
from coframe.wire import Participant

participant = Participant.get()
node = participant.add_node("/", "late")
broadcaster = participant.static_broadcaster(node)
print("ready", flush=True)
{wait}
transform = find("geometry_msgs/msg/TransformStamped")(child_frame_id="camera_link")
transform.header.frame_id = "base_link"
transform.transform.translation.x = 0.5
broadcaster.send([transform])
input()
participant.close()
"""


def test_connection_says_whose_static_transforms_are_awaited(child, eventually):
    publisher = child(LATE.format(wait="input()"))
    assert publisher.read() == "ready"
    with coframe.connect() as ros:
        eventually(lambda: ros.awaited_statics() == ["/late"])
        assert not ros.wait_for_statics("20ms")
        result = CliRunner().invoke(app, ["lookup", "base_link", "camera_link", "--duration", "1s"])
        assert result.exit_code == 1
        assert "The static transforms of /late have not arrived yet" in result.stderr
        publisher.process.stdin.write("\n")
        publisher.process.stdin.flush()
        assert ros.wait_for_statics()
        assert ros.awaited_statics() == []
        assert ros.buffer.lookup("base_link", "camera_link").translation[0] == 0.5


def test_lookups_succeed_after_waiting_for_static_transforms(child):
    publisher = child(LATE.format(wait=""))
    assert publisher.read() == "ready"
    for _ in range(3):
        with coframe.connect() as ros:
            assert ros.wait_for_statics("20s")
            assert ros.buffer.lookup("base_link", "camera_link").x == 0.5


def test_why_waits_for_static_transforms(child):
    # The command listens for 0.3 s, and the transforms are sent 1.5 s after it has subscribed.
    publisher = child(LATE.format(wait="while not broadcaster.matched: time.sleep(0.01)\ntime.sleep(1.5)"))
    assert publisher.read() == "ready"
    result = CliRunner().invoke(app, ["why", "base_link", "camera_link", "--duration", "300ms", "--json"])
    assert result.exit_code == 0, result.output
    assert json.loads(result.stdout)["edges"][0]["publisher"] == "/late"


@pytest.mark.slow  # It waits for 5 s.
def test_why_says_what_it_has_waited_for(child):
    assert child(LATE.format(wait="input()")).read() == "ready"
    result = CliRunner().invoke(app, ["why", "base_link", "camera_link"])
    assert result.exit_code == 1
    assert "The static transforms of /late have not arrived yet" in result.stdout
