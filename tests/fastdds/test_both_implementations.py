# SPDX-License-Identifier: Apache-2.0
"""Processes on Fast DDS and on Cyclone DDS communicate in everything."""

import contextlib
import itertools
import os
import subprocess
import sys

import pytest

import coframe
from coframe import _core
from coframe.messages import codec, find
from coframe.wire import selection
from coframe.wire.names import Endpoint
from coframe.wire.participant import Participant
from coframe.wire.qos import QoS
from coframe.wire.request_header import RequestHeader, join

STRING = find("std_msgs/msg/String")
WIRES = ("fastdds", "dds")
PAIRS = list(itertools.product(WIRES, WIRES))


def static(parent: str, child: str):
    message = find("geometry_msgs/msg/TransformStamped")()
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation.x = 1.0
    return message


@pytest.mark.parametrize(("sender", "receiver"), PAIRS)
def test_messages_and_static_transforms_arrive(sender: str, receiver: str, domain_id: int) -> None:
    with coframe.connect("sender", domain=domain_id, wire=sender) as there:
        node = there.participant.add_node("/robot", "broadcaster")
        there.participant.static_broadcaster(node).send([static("map", "base")])
        publisher = there.publisher("/news", STRING)
        with coframe.connect("receiver", domain=domain_id, wire=receiver) as here:
            assert here.buffer.wait("map", "base", timeout="20s").translation[0] == 1.0
            received = here.subscribe("/news", STRING)
            for number in itertools.count():
                publisher.publish(STRING(data=f"{number} from {sender}"))
                if (message := received.receive("0.1s")) is not None:
                    assert message.data.endswith(f"from {sender}")
                    break
                assert number < 200


@pytest.mark.parametrize("wire", WIRES)
def test_each_sees_the_nodes_of_the_other(wire: str, domain_id: int, eventually) -> None:
    other = next(name for name in WIRES if name != wire)
    here, there = Participant.get(domain_id, wire), Participant.get(domain_id, other)
    try:
        node = there.add_node("/robot", "talker")
        publisher = there.publisher(node, "/news", STRING, QoS(depth=3, deadline=2_000_000_000))
        eventually(lambda: ("/robot", "talker") in here.nodes())
        eventually(lambda: here.publishers("/news"))
        (found,) = here.publishers("/news")
        assert (found.node, found.namespace, found.guid) == ("talker", "/robot", publisher.guid)
        assert (found.qos.reliable, found.qos.deadline, found.ros_type) == (True, 2_000_000_000, "std_msgs/msg/String")
        assert found.type_hash.startswith("RIHS01_")
        node.close()
        eventually(lambda: not here.publishers("/news"))
        eventually(lambda: ("/robot", "talker") not in here.nodes())
    finally:
        here.close()
        there.close()


def test_all_endpoints_of_a_service_and_a_client_belong_to_their_nodes(domain_id: int, eventually) -> None:
    """Also those that are created when an endpoint of the other implementation is discovered."""
    on_fast_dds, on_cyclone_dds = Participant.get(domain_id, "fastdds"), Participant.get(domain_id, "dds")
    add = find("example_interfaces/srv/AddTwoInts")

    def owners(kind: str) -> set[str | None]:
        endpoint = Endpoint("/add", "", kind)
        graph = on_cyclone_dds._graph
        return {graph.owner(writer.guid) for writer in graph.writers(endpoint.dds_topic).values()}

    try:
        for participant, name in ((on_fast_dds, "fast"), (on_cyclone_dds, "cyclone")):
            server, client = participant.add_node("/", f"{name}_server"), participant.add_node("/", f"{name}_client")
            participant.service_publisher(server, "/add", add.Response, QoS(), "reply")
            participant.service_subscription(server, "/add", add.Request, QoS(), "request")
            participant.service_subscription(client, "/add", add.Response, QoS(), "reply")
            participant.service_publisher(client, "/add", add.Request, QoS(), "request")
        graph, topic = on_cyclone_dds._graph, Endpoint("/add", "", "reply").dds_topic
        eventually(lambda: len(graph.writers(topic)) == 3)  # two of the server on Fast DDS
        eventually(lambda: owners("reply") == {"/fast_server", "/cyclone_server"})
        eventually(lambda: owners("request") == {"/fast_client", "/cyclone_client"})
    finally:
        on_fast_dds.close()
        on_cyclone_dds.close()


@pytest.mark.parametrize(("server", "client"), PAIRS)
def test_a_client_calls_a_service(server: str, client: str, start) -> None:
    serving = start(server, "server.py", "add")
    assert serving.stdout.readline() == "ready\n"
    calling = start(client, "client.py", 200, 1, "add")
    output, _ = calling.communicate("go\n", timeout=60)
    assert output.splitlines()[-1] == "200 0 0"


@pytest.mark.parametrize(
    ("pairs", "each"),
    [(2, 100), pytest.param(4, 1250, marks=[pytest.mark.slow, pytest.mark.timeout(600)])],
)
def test_each_reply_reaches_the_client_that_asked(start, pairs: int, each: int) -> None:
    """Some clients on each implementation call a service on each, at the same time and in random order."""
    servers = [start(wire, "server.py", f"add_{wire}") for wire in WIRES]
    names = [f"add_{wire}" for wire in WIRES]
    clients = [start(wire, "client.py", each, number, *names) for number, wire in enumerate([*WIRES] * pairs, start=1)]
    for process in (*servers, *clients):
        assert process.stdout.readline() == "ready\n"
    for process in clients:
        process.stdin.write("go\n")
        process.stdin.flush()
    assert [process.stdout.readline() for process in clients] == [f"{each} 0 0\n"] * len(clients)


def test_the_first_request_of_a_client_reaches_a_server_on_cyclone_dds(domain_id: int, start, eventually) -> None:
    """Each client sends its request as soon as it has found the server, which may not have found the client yet."""
    assert start("dds", "server.py", "add").stdout.readline() == "ready\n"
    add = find("example_interfaces/srv/AddTwoInts")
    participant = Participant.get(domain_id, "fastdds")
    try:
        eventually(lambda: participant.subscribers("/add", kind="request"))
        for number in range(6):
            node = participant.add_node("/", f"client_{number}")
            replies = participant.service_subscription(node, "/add", add.Response, QoS(), "reply")
            requests = participant.service_publisher(node, "/add", add.Request, QoS(), "request")
            eventually(lambda requests=requests: requests.matched)
            header = RequestHeader(requests.client_id, 1)
            requests.write(join(header, codec.serialize(add.Request(a=number, b=1))))
            # The subscription receives the replies to all clients of the service.
            received = []

            def receive(replies=replies, received=received, client=requests.client_id):
                received.extend(message for message in replies.take_messages() if message.header.client == client)
                return received

            eventually(receive)
            assert codec.deserialize(received[0].cdr, add.Response).sum == number + 1
    finally:
        participant.close()


@pytest.mark.parametrize("wire", WIRES)
def test_of_two_servers_with_one_name_the_one_on_fast_dds_answers_clients_on_fast_dds(wire: str, start) -> None:
    """The other server would misread what they send."""
    for each in WIRES:
        assert start(each, "server.py", "add").stdout.readline() == "ready\n"
    output, _ = start(wire, "client.py", 50, 1, "add").communicate("go\n", timeout=60)
    assert output.splitlines()[-1] == "50 0 0"


def test_requests_of_strangers_are_ignored(domain_id: int, start, eventually) -> None:
    """A program that sends other bytes as requests does not stop the service."""
    serving = start("fastdds", "server.py", "add")
    assert serving.stdout.readline() == "ready\n"
    participant = Participant.get(domain_id, "dds")
    try:
        node = participant.add_node("/", "stranger")
        endpoint = Endpoint("/add", "example_interfaces/srv/AddTwoInts_Request", "request")
        writer = participant._session.service_writer(node, endpoint, QoS())
        eventually(lambda: writer.matched)
        for junk in (
            b"\0\1\0\0",
            b"\0\1\0\0" + bytes(3),
            b"\0\1\0\0" + bytes(19),
            b"\0\1\0\0" + b"\xff" * 40,
        ):
            with contextlib.suppress(_core.EndpointError):  # Cyclone DDS refuses to send the shortest
                writer.forward(junk)
        writer.close()
    finally:
        participant.close()
    output, _ = start("dds", "client.py", 20, 1, "add").communicate("go\n", timeout=60)
    assert output.splitlines()[-1] == "20 0 0"
    assert serving.poll() is None


def test_rmw_fastrtps_selects_it_where_it_is_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    environment = {"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}
    assert selection.select(environment) == ("fastdds", "RMW_IMPLEMENTATION is rmw_fastrtps_cpp")
    monkeypatch.setattr(selection, "load_plugins", lambda *_: iter(()))
    assert selection.select(environment).wire == "dds"


def test_help_does_not_import_it() -> None:
    code = "import sys, coframe.cli.app as app\napp.app(['--help'], standalone_mode=False)\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=os.environ)
    assert "coframe_fastdds" not in done.stdout.split()
