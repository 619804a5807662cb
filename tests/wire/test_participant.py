# SPDX-License-Identifier: Apache-2.0
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import coframe
from coframe import WireError
from coframe._core import Event
from coframe.messages import find
from coframe.wire import Participant, QoS

STRING = find("std_msgs/msg/String")

NODE_IN_A_CHILD = """
    from coframe.wire import Participant, QoS
    from coframe.messages import find
    participant = Participant.get()
    node = participant.add_node("/robot", "{name}")
    participant.publisher(node, "/chatter", find("std_msgs/msg/String"), QoS())
    print("ready", flush=True)
    input()
    participant.close()
"""


def wire_threads() -> set[str]:
    return {thread.name for thread in threading.enumerate() if thread.name.startswith("coframe-wire")}


def native_threads() -> int:
    tasks = Path("/proc/self/task")
    return len(list(tasks.iterdir())) if tasks.is_dir() else threading.active_count()


def test_one_participant_per_process_and_domain(domain_id):
    first = Participant.get(domain_id)
    assert Participant.get() is first, "None is ROS_DOMAIN_ID"
    first.close()
    assert first.nodes() == []
    first.close()
    second = Participant.get(domain_id)
    assert second is not first
    second.close()


def test_close_stops_all_threads(domain_id):
    before = native_threads()
    participant = Participant.get(domain_id)
    node = participant.add_node("/", "tester")
    participant.tf_reader(node, "/tf", coframe.Buffer(), static=False)
    assert f"coframe-wire-{domain_id}" in wire_threads()
    assert native_threads() > before
    participant.close()
    assert f"coframe-wire-{domain_id}" not in wire_threads()
    assert native_threads() == before


def test_endpoints_of_a_closed_participant_raise_an_error(domain_id):
    participant = Participant.get(domain_id)
    node = participant.add_node("/", "tester")
    publisher = participant.publisher(node, "/chatter", STRING, QoS())
    subscription = participant.subscription(node, "/chatter", STRING, QoS(), on_data=None)
    participant.close()
    assert publisher.matched == subscription.matched == 0
    assert subscription.take() == []
    assert not subscription.pending()
    with pytest.raises(WireError, match="publisher on /chatter is closed"):
        publisher.write(b"\0\1\0\0\1\0\0\0\0")
    publisher.close()
    node.close()


def test_a_process_without_close_exits_promptly_and_cleanly(child, participant, node):
    talker = participant.publisher(node, "/tf", find("tf2_msgs/msg/TFMessage"), QoS(100))
    other = child("""
        import coframe
        connection = coframe.connect("forgetful")
        print("ready", flush=True)
        input()
    """)
    other.read()
    talker.write(b"\0\1\0\0" + bytes(4))
    began = time.monotonic()
    assert other.finish() == (0, "")
    assert time.monotonic() - began < 3


@pytest.mark.cyclone_only("Fast DDS does not announce the depth")
@pytest.mark.parametrize("distro", ["humble", "jazzy"])
def test_nodes_of_other_processes_of_any_distribution_are_discovered(distro, child, participant, eventually):
    other = child(NODE_IN_A_CHILD.format(name="talker"), ROS_DISTRO=distro)
    eventually(lambda: ("/robot", "talker") in participant.nodes())
    eventually(lambda: participant.topics().get("/chatter") == ["std_msgs/msg/String"])
    eventually(lambda: [publisher.node for publisher in participant.publishers("/chatter")] == ["talker"])
    (publisher,) = participant.publishers("/chatter")
    assert (publisher.namespace, publisher.node) == ("/robot", "talker")
    assert publisher.ros_type == "std_msgs/msg/String"
    assert publisher.qos == QoS()
    assert other.finish() == (0, "")
    eventually(lambda: ("/robot", "talker") not in participant.nodes())
    eventually(lambda: not participant.publishers("/chatter"))


@pytest.mark.slow  # DDS gives the silent ten seconds
def test_nodes_of_a_killed_process_disappear_when_its_lease_expires(participant, child, eventually):
    other = child(NODE_IN_A_CHILD.format(name="talker"))
    eventually(lambda: ("/robot", "talker") in participant.nodes())
    other.kill()
    eventually(lambda: ("/robot", "talker") not in participant.nodes())


@pytest.mark.slow
def test_nodes_that_come_and_go_leave_nothing_in_other_processes(child):
    watching = child("""
        import gc, sys, time
        from coframe.wire import Participant
        participant = Participant.get()
        participant.add_node("/", "watching")
        print("ready", flush=True)
        while input():
            while participant.nodes() != [("/", "watching")]:
                time.sleep(0.01)
            gc.collect()
            print(sys.getallocatedblocks(), flush=True)
    """)
    passing = child("""
        import rclpy
        while input():
            for number in range(40):
                rclpy.init()
                rclpy.create_node(f"passing_{number}").destroy_node()
                rclpy.shutdown()
            print("done", flush=True)
    """)

    def blocks_after_forty_nodes():
        passing.ask("more")
        return int(watching.ask("count"))

    assert watching.read() == "ready"
    before = blocks_after_forty_nodes()
    assert (blocks_after_forty_nodes() - before) / 40 < 12, "objects per node"


def test_nodes_of_this_process_are_on_the_graph_immediately(participant):
    node = participant.add_node("/a/b", "own")
    assert participant.nodes() == [("/a/b", "own")]
    participant.subscription(node, "/chatter", STRING, QoS(depth=7, reliable=False), on_data=None)
    (subscriber,) = participant.subscribers("/chatter")
    assert (subscriber.namespace, subscriber.node, subscriber.qos.reliable) == ("/a/b", "own", False)
    node.close()
    assert participant.nodes() == []
    assert participant.topics() == {}


def test_a_change_of_the_graph_sets_the_event(participant):
    event = Event()
    participant.watch_graph(event)
    participant.add_node("/", "newcomer")
    assert event.wait(10_000_000_000)
    participant.unwatch_graph(event)


def test_invalid_node_names(participant):
    with pytest.raises(WireError, match=r"has 300 bytes\. The limit is 256 bytes"):
        participant.add_node("/", "x" * 300)
    with pytest.raises(WireError, match="Namespace 'robot' is not absolute") as caught:
        participant.add_node("robot", "x")
    assert caught.value.hint == "Use '/robot'."


@pytest.mark.dds_only("Zenoh has other names")
@pytest.mark.parametrize(
    ("topic", "ros_type", "reason"),
    [
        ("/" + "x" * 70_000, "std_msgs/msg/String", r"has 70003 bytes\. The limit is 256 bytes"),
        ("/x", "std_msgs/msg/" + "X" * 70_000, r"has 70\d\d\d bytes\. The limit is 256 bytes"),
        ("/\udcff", "std_msgs/msg/String", "is not valid UTF-8"),
    ],
)
def test_names_that_crash_cyclone_dds_are_refused(participant, node, topic, ros_type, reason):
    with pytest.raises(WireError, match=reason):
        participant.raw_publisher(node, topic, ros_type, QoS())


def test_an_invalid_domain_id():
    with pytest.raises(WireError, match="a domain ID is an integer from 0 to 232"):
        Participant.get(233)


@pytest.mark.cyclone_only("the configuration of Cyclone DDS")
def test_an_invalid_configuration_of_cyclone_dds(domain_id, monkeypatch):
    monkeypatch.setenv("CYCLONEDDS_URI", "<CycloneDDS><Nonsense/></CycloneDDS>")
    with pytest.raises(WireError, match=f"Joining domain {domain_id} failed") as caught:
        Participant.get(domain_id)
    assert "CYCLONEDDS_URI" in caught.value.hint


@pytest.mark.skipif(os.name != "posix", reason="limits of file descriptors")
def test_few_file_descriptors_are_an_error_and_not_a_crash(domain_id):
    script = "import resource, coframe; resource.setrlimit(resource.RLIMIT_NOFILE, (10, 10)); coframe.connect()"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert f"Joining domain {domain_id} failed: Too many open files. " in done.stderr


@pytest.mark.cyclone_only("only Cyclone DDS has a limit of participant indexes")
def test_the_error_for_a_full_domain(domain_id, monkeypatch, child):
    monkeypatch.setattr("coframe.wire.dds.config.MAX_PARTICIPANT_INDEX", 0)
    other = child(NODE_IN_A_CHILD.format(name="first"))
    assert other.read() == "ready"
    with pytest.raises(
        WireError, match=f"Domain {domain_id} is full on this machine: all 1 participant indexes"
    ) as caught:
        Participant.get(domain_id)
    assert "ROS_DOMAIN_ID" in caught.value.hint


@pytest.mark.skipif(not hasattr(os, "fork"), reason="only where processes fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_joining_in_a_forked_child_raises_an_error(participant):
    pid = os.fork()
    if pid == 0:
        try:
            Participant.get(participant.domain_id)
        except WireError as error:
            os._exit(0 if "forked" in str(error) else 1)
        os._exit(2)
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0


def test_a_process_exits_cleanly_while_threads_publish(child):
    ended = child("""
        import threading
        import coframe
        from coframe.errors import WireError
        from coframe.messages import find
        ros = coframe.connect("busy")
        message = find("std_msgs/msg/String")(data="x")
        publisher = ros.publisher("/busy", type(message))
        def publish():
            while True:
                try:
                    publisher.publish(message)
                except WireError:
                    pass
        for _ in range(3):
            threading.Thread(target=publish, daemon=True).start()
        input()
    """)
    assert ended.finish() == (0, "")


def test_a_forked_child_exits_cleanly_and_its_parent_stays_on_the_graph(child, participant, eventually):
    parent = child("""
        import os, signal, sys, warnings
        import coframe
        from coframe.messages import find
        warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12 warns of what this test is about
        with coframe.connect("parent") as ros:
            string = find("std_msgs/msg/String")
            publisher, subscription = ros.publisher("/s", string), ros.subscribe("/s", string)
            if (pid := os.fork()) == 0:
                signal.alarm(20)
                try:
                    publisher.publish(string())
                except RuntimeError:
                    sys.exit(3)  # through the end of the block, which closes everything
            print(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), flush=True)
            input()
    """)
    assert parent.read() == "3"
    eventually(lambda: ("/", "parent") in participant.nodes())
    assert parent.finish() == (0, "")


@pytest.mark.usefixtures("domain_id")
def test_ctrl_c_while_the_interpreter_exits_is_ignored():
    script = """
import signal
import coframe
from coframe.wire.participant import Participant

ros = coframe.connect("ends")
end = Participant._end
Participant._end = lambda self: (signal.raise_signal(signal.SIGINT), end(self), print("closed"))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "closed\n", "")
