# SPDX-License-Identifier: Apache-2.0
"""Processes of coframe on Zenoh: they find each other, end cleanly, and leave the graph when they are killed."""

import os
import signal
import subprocess
import sys

import pytest

import coframe
from coframe.messages import codec, find
from coframe.wire import QoS

STRING = find("std_msgs/msg/String")

CONNECTED = """
import sys
import coframe
with coframe.connect("other") as ros:
    print("ready", flush=True)
    sys.stdin.readline()
"""


def test_a_process_ends_cleanly_and_leaves_the_graph(participant, child, eventually):
    other = child(CONNECTED)
    assert other.stdout.readline() == "ready\n"
    eventually(lambda: ("/", "other") in participant.nodes())
    _, errors = other.communicate("\n", timeout=20)
    assert (other.returncode, errors) == (0, "")
    eventually(lambda: participant.nodes() == [])


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="Windows has no SIGKILL")
def test_a_killed_process_leaves_the_graph(participant, child, eventually):
    other = child(CONNECTED)
    assert other.stdout.readline() == "ready\n"
    eventually(lambda: ("/", "other") in participant.nodes())
    other.kill()
    eventually(lambda: participant.nodes() == [])


def test_a_participant_that_is_not_closed_does_not_stop_the_exit(child):
    other = child("""
        import coframe
        from coframe.messages import find
        ros = coframe.connect("forgotten")
        ros.subscribe("/chatter", find("std_msgs/msg/String"), print)
        print("end", flush=True)
    """)
    output, errors = other.communicate(timeout=20)
    assert (other.returncode, output, errors) == (0, "end\n", "")


def test_the_last_messages_are_sent_when_a_process_ends(participant, node, child, eventually):
    subscription = participant.subscription(node, "/chatter", STRING, QoS(depth=2000))
    other = child("""
        import coframe
        from coframe.messages import find
        with coframe.connect("burst") as ros:
            String = find("std_msgs/msg/String")
            publisher = ros.publisher("/chatter", String)
            while not publisher.matched:
                pass
            for number in range(1000):
                publisher.publish(String(data=str(number)))
    """)
    _, errors = other.communicate(timeout=30)
    assert (other.returncode, errors) == (0, "")
    received = []
    eventually(lambda: received.extend(subscription.take()) or len(received) == 1000)
    assert [codec.deserialize(sample.data, STRING).data for sample in received] == [str(n) for n in range(1000)]


def test_a_slow_callback_does_not_lose_messages_of_other_topics(participant, node, child, eventually):
    quick = participant.subscription(node, "/quick", STRING, QoS(depth=2000))
    slow = participant.subscription(node, "/slow", STRING, QoS(depth=1))
    other = child("""
        import coframe
        from coframe.messages import find
        with coframe.connect("burst") as ros:
            String = find("std_msgs/msg/String")
            publishers = ros.publisher("/slow", String), ros.publisher("/quick", String)
            while not all(publisher.matched for publisher in publishers):
                pass
            for number in range(500):
                for publisher in publishers:
                    publisher.publish(String(data=str(number)))
    """)
    _, errors = other.communicate(timeout=30)
    assert (other.returncode, errors) == (0, "")
    received = []
    eventually(lambda: received.extend(quick.take()) or len(received) == 500)
    eventually(slow.pending)
    assert len(slow.take()) == 1  # the newest; the others were dropped and counted
    assert slow._reader.dropped > 0


def test_processes_of_one_machine_find_each_other_without_a_router(network):
    code = """
import subprocess, sys, time
from coframe.wire import Participant
participant = Participant.get()
participant.add_node("/", sys.argv[1])
end = time.monotonic() + 20
if sys.argv[1] == "first":
    other = subprocess.Popen([sys.executable, "-c", sys.argv[2], "second"], stdin=subprocess.PIPE)
while len(participant.nodes()) < 2 and time.monotonic() < end:
    time.sleep(0.01)
print(sorted(name for _, name in participant.nodes()), flush=True)
if sys.argv[1] == "first":
    other.communicate(timeout=20)
else:
    sys.stdin.read()
participant.close()
"""
    unconfigured = {name: value for name, value in os.environ.items() if not name.startswith("ZENOH_")}
    done = subprocess.run(
        network.command(sys.executable, "-c", code, "first", code),
        env={**unconfigured, "COFRAME_WIRE": "zenoh"},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.stdout.splitlines() == ["['first', 'second']"] * 2
    assert "only processes of coframe on this machine are found" in done.stderr
    assert "Start a router: coframe router" in done.stderr


def test_late_listeners_get_static_transforms(zenoh_domain, child):
    other = child("""
        import sys, rclpy, tf2_ros
        from geometry_msgs.msg import TransformStamped
        rclpy.init()
        node = rclpy.create_node("broadcaster")
        transform = TransformStamped(child_frame_id="odom")
        transform.header.frame_id = "map"
        transform.transform.translation.x = 2.5
        broadcaster = tf2_ros.StaticTransformBroadcaster(node)
        broadcaster.sendTransform(transform)
        print("ready", flush=True)
        sys.stdin.readline()
        rclpy.shutdown()
    """)
    assert other.stdout.readline() == "ready\n"
    with coframe.connect("late", domain=zenoh_domain) as ros:
        assert ros.buffer.lookup("map", "odom", timeout="15s").translation[0] == 2.5
        (publisher,) = ros.publishers()
        assert publisher.node == "/broadcaster"
