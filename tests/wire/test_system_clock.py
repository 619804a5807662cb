# SPDX-License-Identifier: Apache-2.0
"""A system clock with a time that messages cannot have is reported in a sentence that says so."""

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from coframe.errors import WireError
from coframe.messages import find
from coframe.wire import Participant, QoS, system_clock

BEFORE_1970 = "1969-06-01 00:00:00"
AFTER_2038 = "2040-01-01 00:00:00"
AFTER_2106 = "2107-01-01 00:00:00"
SET_THE_CLOCK = "Set the clock, for example with: sudo date --set"

LIBRARY = next(Path("/usr/lib").glob("*/faketime/libfaketime.so.1"), None)
with_faketime = pytest.mark.skipif(LIBRARY is None, reason="needs libfaketime (apt-get install faketime)")


@pytest.fixture
def set_clock(monkeypatch):
    def set_to(seconds):
        monkeypatch.setattr(system_clock, "time", SimpleNamespace(time=lambda: seconds))

    return set_to


@pytest.mark.parametrize(
    ("seconds", "sends", "stamps"),
    [(-1, False, False), (0, True, True), (2**31 - 1, True, True), (2**31, True, False), (2**32, False, False)],
)
def test_limits(set_clock, seconds, sends, stamps):
    set_clock(seconds)
    assert (system_clock.clock_fault() is None, system_clock.stamp_fault() is None) == (sends, stamps)


def test_joining_and_publishing(set_clock, domain_id):
    participant = Participant.get(domain_id)
    node = participant.add_node("/", "early")
    publisher = participant.publisher(node, "/tf", find("tf2_msgs/msg/TFMessage"), QoS())
    set_clock(-20_000_000)
    with pytest.raises(
        WireError, match="The system clock says 1969-05-14 12:26:40 UTC, but messages can only have times"
    ) as raised:
        Participant.get(domain_id + 1)
    assert raised.value.hint.startswith(SET_THE_CLOCK)
    # A message is refused for the same reason; damaged transforms stand in for it here.
    with pytest.raises(WireError, match=r"Publishing on /tf failed\. The system clock says 1969-05-14"):
        publisher.write(b"\xff" * 8)
    participant.close()


def faked(variables, *words):
    """Run Python with a clock of libfaketime; the steady clock is that of the system."""
    fake = {"LD_PRELOAD": str(LIBRARY), "FAKETIME_DONT_FAKE_MONOTONIC": "1", "DONT_FAKE_MONOTONIC": "1"}
    environment = {**os.environ, **fake, "PYTHONUNBUFFERED": "1", **variables}
    command = [sys.executable, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False, timeout=60)


@with_faketime
@pytest.mark.parametrize("when", [BEFORE_1970, AFTER_2106])
@pytest.mark.parametrize("words", [["record", "-o", "out"], ["monitor"], ["topic", "list"]])
@pytest.mark.usefixtures("domain_id")
def test_commands_with_a_wrong_clock(tmp_path, monkeypatch, when, words):
    monkeypatch.chdir(tmp_path)
    done = faked({"FAKETIME": f"@{when}"}, "-m", "coframe.cli", *words)
    assert done.returncode == 1
    first, second = done.stderr.splitlines()
    assert first.startswith(f"coframe: The system clock says {when[:10]}")
    assert second.strip().startswith(SET_THE_CLOCK)
    assert list(tmp_path.iterdir()) == []


@with_faketime
@pytest.mark.parametrize("words", [["topic", "list"], ["static", "--frame-id", "a", "--child-frame-id", "b"]])
@pytest.mark.usefixtures("domain_id")
def test_nodes_after_2038(words):
    done = faked({"FAKETIME": f"@{AFTER_2038}"}, "-m", "coframe.cli", *words)
    assert (done.returncode, "Traceback" in done.stderr) == (1, False)
    assert "The system clock says 2040-01-01" in done.stderr
    assert "the stamps of ROS 2 messages end at 2038-01-19" in done.stderr


NODE = """
import sys
import rclpy
from pathlib import Path
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("n")
publisher = node.create_publisher(String, "/chatter", 10)
publisher.publish(String(data="a"))
# An empty file, as between truncating and writing it, would be a third time for a moment.
new = Path(sys.argv[1] + ".new")
new.write_text("@1969-06-01 00:00:00")
new.replace(sys.argv[1])
try:
    while True:
        publisher.publish(String(data="a"))
        rclpy.spin_once(node, timeout_sec=0.1)
except RuntimeError as error:
    print(error)
node.get_logger().info("the node continues")
rclpy.spin_once(node, timeout_sec=1.5)
node.destroy_node()
rclpy.shutdown()
"""


@with_faketime
@pytest.mark.cyclone_only("the threads of Fast DDS do not end while the clock is before 1970")
@pytest.mark.usefixtures("domain_id")
def test_a_clock_that_is_set_while_a_node_runs(tmp_path):
    """Publishing fails with the reason, a warning has it too, and the node can end."""
    now = tmp_path / "now"
    now.write_text("@2026-06-01 00:00:00")
    # While libfaketime reads the file in one thread, the others see the real time: it reads it once a second only.
    done = faked({"FAKETIME_TIMESTAMP_FILE": str(now), "FAKETIME_CACHE_DURATION": "1"}, "-c", NODE, now)
    assert (done.returncode, "Traceback" in done.stderr) == (0, False), done.stderr
    assert "Publishing on /chatter failed. The system clock says 1969-06-01" in done.stdout
    assert done.stderr.count(SET_THE_CLOCK) == 1
    assert "the node continues" in done.stderr
