# SPDX-License-Identifier: Apache-2.0
"""Neighbors on Fast DDS, the default middleware of ROS 2: a C++ program on Debian's libfastrtps-dev."""

import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

SOURCE = Path(__file__).with_name("fast_dds.cpp")

# Runs in the network of the test, with the path of the program as argument.
PRELUDE = """
import array, subprocess, sys, time
import coframe
from coframe.messages import find, serialize
from coframe.wire import Participant, QoS
from coframe.wire.domains import domain_id
from coframe.wire.rtps.discovery_info import NodeInfo, encode_info

def eventually(condition):
    deadline = time.monotonic() + 20
    while not condition():
        assert time.monotonic() < deadline, "timed out after 20 s"
        time.sleep(0.01)

class FastDds:
    def __init__(self, domain):
        self.process = subprocess.Popen([sys.argv[1], str(domain)], stdin=-1, stdout=-1, text=True)
        self.guid = self.read("guid")

    def read(self, what):
        first, *rest = self.process.stdout.readline().split()
        assert first == what, (first, rest)
        return bytes.fromhex(rest[0]) if what == "guid" else rest

    def ask(self, what, *words):
        print(*words, file=self.process.stdin, flush=True)
        return self.read(what)

    def announce(self, name, readers=(), writers=()):
        graph_type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"
        self.ask("guid", "writer", "ros_discovery_info", graph_type, "transient")
        info = encode_info(self.guid, [NodeInfo("/", name, tuple(readers), tuple(writers))], 24)
        self.ask("written", "write", "ros_discovery_info", info.hex())
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """The path of the program on Fast DDS."""
    compiler = shutil.which("g++") or pytest.skip("the program on Fast DDS needs g++")
    target = tmp_path_factory.mktemp("fast_dds") / "fast_dds"
    options = ["-std=c++17", "-o", target, SOURCE, "-lfastrtps", "-lfastcdr"]
    built = subprocess.run([compiler, *options], capture_output=True, text=True, check=False)
    if "No such file" in built.stderr:
        pytest.skip("Fast DDS is not installed: apt-get install libfastrtps-dev")
    assert built.returncode == 0, built.stderr
    return target


@pytest.fixture
def run(program, network, domain_id):  # noqa: ARG001 - sets the domain
    """Return a function that runs code with coframe in the network of the test, and returns its stderr."""

    def in_network(code):
        command = network.command(sys.executable, "-c", PRELUDE + textwrap.dedent(code), program)
        result = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        assert result.returncode == 0, result.stderr
        return result.stderr

    return in_network


def test_a_large_cloud_arrives(run):
    run(
        """
        participant = Participant.get()
        node = participant.add_node("/", "camera")
        cloud_type = find("sensor_msgs/msg/PointCloud2")
        publisher = participant.publisher(node, "/cloud", cloud_type, QoS())
        fast = FastDds(participant.domain_id)
        fast.ask("guid", "reader", "rt/cloud", "sensor_msgs::msg::dds_::PointCloud2_", "volatile")
        eventually(lambda: publisher.matched and fast.ask("matched", "matched", "rt/cloud") == ["1"])
        data = serialize(cloud_type(data=array.array("B", bytes(range(200)) * 200_000)))
        for _ in range(3):
            publisher.write(data)
        begun = time.monotonic()
        for _ in range(3):
            _, size, checksum, _ = fast.read("received")
            assert (int(size), int(checksum)) == (len(data), sum(data))
        assert time.monotonic() - begun < 20
        participant.close()
        """
    )


def test_closed_endpoints_and_participants_leave_at_once(run):
    """Without a key hash, Fast DDS would keep them until the lease of the participant expires, after 10 s."""
    run(
        """
        fast = FastDds(domain_id())
        fast.ask("guid", "writer", "rt/chatter", "std_msgs::msg::dds_::String_", "volatile")
        participant = Participant.get()
        node = participant.add_node("/", "listener")
        text = find("std_msgs/msg/String")
        subscriptions = [participant.subscription(node, "/chatter", text, QoS()) for _ in range(2)]
        for left in (1, 0):
            eventually(lambda: fast.ask("matched", "matched", "rt/chatter") == [str(left + 1)])
            begun = time.monotonic()
            subscriptions.pop().close() if left else participant.close()
            eventually(lambda: fast.ask("matched", "matched", "rt/chatter") == [str(left)])
            assert time.monotonic() - begun < 3
        """
    )


def test_repeated_announcements_do_not_disturb(run, monkeypatch):
    interface = '<NetworkInterface address="127.0.0.1" multicast="true"/>'
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")  # where announcements are repeated
    monkeypatch.setenv(
        "CYCLONEDDS_URI",
        f"<CycloneDDS><Domain><General><Interfaces>{interface}</Interfaces></General></Domain></CycloneDDS>",
    )
    run(
        """
        domain = domain_id()
        fast = FastDds(domain)
        fast.ask("guid", "reader", "rt/chatter", "std_msgs::msg::dds_::String_", "volatile")
        participant = Participant.get()
        text = find("std_msgs/msg/String")
        publisher = participant.publisher(participant.add_node("/", "talker"), "/chatter", text, QoS())
        eventually(lambda: publisher.matched and fast.ask("matched", "matched", "rt/chatter") == ["1"])
        announced = time.monotonic() + 1.2
        while time.monotonic() < announced:
            assert publisher.matched == 1
            assert fast.ask("matched", "matched", "rt/chatter") == ["1"]
            time.sleep(0.02)
        data = serialize(text(data="morning"))  # with its end a multiple of 4 bytes
        publisher.write(data)
        _, size, checksum, _ = fast.read("received")
        assert (int(size), int(checksum)) == (len(data), sum(data))
        participant.close()
        """
    )


def test_late_static_transforms_arrive_before_why_answers(run):
    run(
        """
        from click.testing import CliRunner
        from coframe.cli.app import app
        stamped = find("geometry_msgs/msg/TransformStamped")(child_frame_id="camera_link")
        stamped.header.frame_id = "base_link"
        message = find("tf2_msgs/msg/TFMessage")(transforms=[stamped])
        fast = FastDds(domain_id())
        guid = fast.ask("guid", "writer", "rt/tf_static", "tf2_msgs::msg::dds_::TFMessage_", "transient")
        fast.announce("calibration", writers=[guid])
        fast.ask("written", "write", "rt/tf_static", serialize(message).hex())
        for _ in range(3):
            result = CliRunner().invoke(app, ["why", "base_link", "camera_link"])
            assert result.exit_code == 0, result.output
            assert "/calibration" in result.stdout
        """
    )


HISTORY = """
import coframe._core as core

text = find("std_msgs/msg/String")
TOPIC, TYPE, DATA = "rt/map_name", "std_msgs::msg::dds_::String_", serialize(text(data="hall"))
LATCHED = QoS(depth=1, transient_local=True)

def join():
    participant = Participant.get()
    return participant, participant.subscription(participant.add_node("/", "viewer"), "/map_name", text, LATCHED)

def seconds_to(condition):
    begun = time.monotonic()
    eventually(condition)
    return time.monotonic() - begun

def observer(participant):
    return core.EndpointReader(participant._session.native.entity, core.SUBSCRIPTIONS, core.Event())

def requests(changes):
    return [topic for _, _, _, _, topic, _, _, user_data, _ in changes if b"coframe=history" in user_data]
"""


def test_history_arrives_when_its_writer_is_discovered(run):
    """Without a request from coframe, it would arrive with the periodic heartbeat of Fast DDS, every 3 s."""
    run(
        HISTORY
        + textwrap.dedent("""
        fast = FastDds(domain_id())
        guid = fast.ask("guid", "writer", TOPIC, TYPE, "transient")
        fast.ask("written", "write", TOPIC, DATA.hex())
        fast.announce("map_server", writers=[guid])
        times = []
        for _ in range(4):
            participant, subscription = join()
            eventually(lambda: participant.publishers("/map_name"))
            times.append(seconds_to(lambda: subscription.take()))
            times.append(seconds_to(lambda: ("/", "map_server") in participant.nodes()))
            participant.close()
        assert max(times) < 1 and sorted(times)[4] < 0.3, times
        """)
    )


def test_endpoints_are_discovered_on_both_sides_without_waiting_for_a_heartbeat(run):
    """Fast DDS sends heartbeats before Cyclone DDS knows it, and repeats them after 1 s."""
    errors = run(
        HISTORY
        + textwrap.dedent("""
        fast = FastDds(domain_id())
        fast.ask("guid", "writer", TOPIC, TYPE, "transient")
        fast.ask("guid", "reader", "rt/answers", TYPE, "transient")
        times = []
        for _ in range(5):
            begun = time.monotonic()
            participant, subscription = join()
            publisher = participant.publisher(participant.add_node("/", "talker"), "/answers", text, LATCHED)
            publisher.write(DATA)
            eventually(lambda: participant.publishers("/map_name"))
            assert fast.read("received")[0] == "rt/answers"
            times.append(time.monotonic() - begun)
            participant.close()
            eventually(lambda: fast.ask("matched", "matched", "rt/answers") == ["0"])
        assert sorted(times)[2] < 0.8, times
        """)
    )
    assert "malformed" not in errors


def test_lists_wait_for_the_nodes_of_discovered_processes(run):
    run(
        HISTORY
        + textwrap.dedent("""
        from click.testing import CliRunner
        from coframe.cli.app import app
        named, silent = FastDds(domain_id()), FastDds(domain_id())
        guid = named.ask("guid", "writer", TOPIC, TYPE, "transient")
        named.announce("map_server", writers=[guid])
        result = CliRunner().invoke(app, ["node", "list"])
        assert (result.exit_code, result.stdout) == (0, "/map_server\\n"), result.output
        assert result.stderr.splitlines() == [
            "Waiting for the nodes of 1 process (Fast DDS).",
            "coframe: The nodes of 1 process (Fast DDS) are still unknown after 3 s, so they are not listed.",
        ]
        silent.process.kill()
        silent.process.wait()
        result = CliRunner().invoke(app, ["topic", "info", "-v", "/map_name"])
        assert "Node name: map_server" in result.stdout
        """)
    )


def test_history_of_a_node_that_starts_later_arrives_at_once(run):
    run(
        HISTORY
        + textwrap.dedent("""
        participant, subscription = join()
        for number in range(1, 4):
            fast = FastDds(domain_id())
            fast.ask("guid", "writer", TOPIC, TYPE, "transient")
            fast.ask("written", "write", TOPIC, DATA.hex())
            eventually(lambda: len(participant.publishers("/map_name")) == number)
            assert seconds_to(lambda: subscription.take()) < 1
        participant.close()
        """)
    )


def test_the_readers_that_request_history_are_few_and_not_shown(run):
    run(
        HISTORY
        + textwrap.dedent("""
        fast = FastDds(domain_id())
        fast.ask("guid", "writer", TOPIC, TYPE, "transient")  # which writes nothing, so that no attempt succeeds
        participant, subscription = join()
        changes = observer(participant)
        left, shown = set(), set()
        def look():
            left.update(guid for _, alive, guid, *_ in changes.take() if not alive)
            shown.update(info.guid for info in participant.subscribers("/map_name"))
            return len(left)
        eventually(lambda: look() == 3)
        eventually(lambda: fast.ask("matched", "matched", TOPIC) == ["1"])
        time.sleep(0.5)
        assert look() == 3
        assert shown == {subscription.guid}
        participant.close()
        """)
    )


def test_history_is_requested_only_where_it_is_needed(run):
    """Not from writers on Cyclone DDS, which send it without a request, and not for volatile subscriptions."""
    run(
        HISTORY
        + textwrap.dedent("""
        OTHER = '''if True:
            import sys
            from coframe.messages import find, serialize
            from coframe.wire import Participant, QoS
            text = find("std_msgs/msg/String")
            participant = Participant.get()
            node = participant.add_node("/", "other")
            publisher = participant.publisher(node, "/map_name", text, QoS(depth=1, transient_local=True))
            publisher.write(serialize(text(data="hall")))
            sys.stdin.read()
            participant.close()
        '''
        other = subprocess.Popen([sys.executable, "-c", OTHER], stdin=-1)
        participant, subscription = join()
        changes = observer(participant)
        participant.subscription(participant.add_node("/", "listener"), "/chatter", text, QoS())
        eventually(lambda: subscription.take())
        other.stdin.close()
        other.wait()
        fast = FastDds(domain_id())
        fast.ask("guid", "writer", "rt/chatter", TYPE, "transient")
        fast.announce("talker")
        eventually(lambda: participant.publishers("/chatter") and ("/", "talker") in participant.nodes())
        assert set(requests(changes.take())) <= {"ros_discovery_info"}
        participant.close()
        """)
    )


SERVICES = """
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_srvs.srv import SetBool

TOPICS = [("reader", "rq/lightRequest", "Request"), ("writer", "rr/lightReply", "Response"),
          ("writer", "rq/motorRequest", "Request"), ("reader", "rr/motorReply", "Response")]

def announce_services(fast):
    kind = "std_srvs::srv::dds_::SetBool_{}_"
    guids = {"reader": [], "writer": []}
    for which, topic, part in TOPICS:
        guids[which].append(fast.ask("guid", which, topic, kind.format(part), "volatile"))
    fast.announce("lamp", guids["reader"], guids["writer"])

def assert_unmatched(fast):
    # A line about a received request would come before the answer.
    for kind, topic, part in TOPICS:
        matched = (kind, part) == ("reader", "Response")  # which ignores replies without the client's identity
        assert fast.ask("matched", "matched", topic) == ["1" if matched else "0"], topic

rclpy.init()
node = rclpy.create_node("robot")
"""


def test_services_are_reported_and_never_match(run):
    """A server and a client on Fast DDS: one warning, no request arrives on either side, and DDS prints nothing."""
    errors = run(
        SERVICES
        + textwrap.dedent("""
        fast = FastDds(domain_id())
        announce_services(fast)
        asked = []
        client = node.create_client(SetBool, "light")
        server = node.create_service(SetBool, "motor", lambda request, response: asked.append(request) or response)
        assert not client.wait_for_service(timeout_sec=1.0)
        eventually(lambda: client._Client__requests.matched_handles() and server._Service__requests.matched_handles())
        eventually(lambda: ("lamp", "/") in node.get_node_names_and_namespaces())
        future = client.call_async(SetBool.Request(data=True))
        assert str(future.exception()).startswith("Node /lamp uses Fast DDS, so its service /light cannot be called")
        # A request of Fast DDS, which has no header in front; a second one that is long enough to have one.
        for request in ("0001000001000000", "00010000" + "01" * 20):
            fast.ask("written", "write", "rq/motorRequest", request)
        for _ in range(30):
            rclpy.spin_once(node, timeout_sec=0.1)
        assert asked == []
        assert_unmatched(fast)
        rclpy.shutdown()
        """)
    )
    assert errors.count("Node /lamp uses Fast DDS, so its ") == 1, errors
    assert "Start that node with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp." in errors
    assert "deserialization" not in errors


def test_calls_reach_only_the_server_that_understands_them(run):
    """Both middlewares have a server of one name: the one on Cyclone DDS is called, the other one does not match."""
    run(
        SERVICES
        + textwrap.dedent("""
        def answer(request, response):
            response.success, response.message = request.data, "x" * 700_000
            return response

        del TOPICS[2:]  # no client
        fast = FastDds(domain_id())
        announce_services(fast)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        node.create_service(SetBool, "light", answer)
        client = node.create_client(SetBool, "light")
        assert client.wait_for_service(timeout_sec=20)
        eventually(lambda: len(client._Client__requests.matched_handles()) == 2)
        for _ in range(20):  # Fast DDS acknowledges no request, which does not block the writer.
            future = client.call_async(SetBool.Request(data=True))
            executor.spin_until_future_complete(future, timeout_sec=10)
            assert future.result().success
        # With this quality of service, servers that appear later receive the requests of before.
        durable = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_client(SetBool, "late", qos_profile=durable).call_async(SetBool.Request(data=True))
        late = ("reader", "rq/lateRequest", "Request")
        TOPICS.append(late)
        fast.ask("guid", late[0], late[1], "std_srvs::srv::dds_::SetBool_Request_", "transient")
        asked = []
        node.create_service(SetBool, "late", lambda q, r: asked.append(q) or r, qos_profile=durable)
        eventually(lambda: executor.spin_once(timeout_sec=0.05) or asked)
        time.sleep(3)
        assert_unmatched(fast)
        rclpy.shutdown()
        """)
    )
