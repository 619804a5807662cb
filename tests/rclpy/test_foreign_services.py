# SPDX-License-Identifier: Apache-2.0
"""Services next to nodes whose middleware sends requests in another form: no request is misread by either side."""

import logging
import threading

import pytest
from rtps_peer import CYCLONE_DDS, FAST_DDS, RTI_CONNEXT

import rclpy
from coframe.errors import WireError
from coframe.messages import codec
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import HistoryPolicy, QoSProfile
from std_srvs.srv import SetBool
from tf2_ros import BufferClient, TimeoutException, TransformException

pytestmark = pytest.mark.cyclone_only("over Fast DDS, requests in both forms are understood")

TYPE = "std_srvs/srv/SetBool"
ACTION = "tf2_msgs/action/LookupTransform"
OTHERS = [FAST_DDS, RTI_CONNEXT, b"\x01\x99"]
REFUSED = "An unnamed node uses Fast DDS, so its service /{} cannot be called"
# The request {data: true} with the header of Cyclone DDS, and without it but long enough to have one.
WITH_HEADER = bytes.fromhex("00010000") + bytes(8) + b"\x01" + bytes(7) + b"\x01"
WITHOUT_HEADER = bytes.fromhex("00010000") + b"\x01" * 17


def discover(node, service, wait_until):
    """Wait until the node has discovered the server of another middleware."""
    participant = node._Coframe__participant
    wait_until(lambda: participant.subscribers(f"/{service}", kind="request"))


def answer(request, response):
    response.success = request.data
    return response


@pytest.mark.parametrize("vendor", OTHERS)
def test_no_request_is_sent_to_a_server_that_would_misread_it(node, start_peer, wait_until, vendor):
    peer = start_peer(vendor)
    requests = peer.serve("/light", TYPE)
    client = node.create_client(SetBool, "light")
    discover(node, "light", wait_until)
    future = client.call_async(SetBool.Request(data=True))
    assert future.done()
    names = {FAST_DDS: "Fast DDS", RTI_CONNEXT: "RTI Connext"}
    used = names.get(vendor, "an unknown DDS implementation (vendor ID 1.153)")
    assert str(future.exception()).startswith(f"An unnamed node uses {used}, so its service /light cannot be called: ")
    assert "RMW_IMPLEMENTATION=rmw_cyclonedds_cpp" in str(future.exception())
    with pytest.raises(WireError, match="its service /light cannot be called"):
        client.call(SetBool.Request(data=True), timeout_sec=10)
    assert not client.wait_for_service(timeout_sec=0.3)
    with pytest.raises(KeyError):
        client.get_pending_request(1)
    assert peer.received_on(requests) == []


def test_the_error_names_the_node(node, start_peer, wait_until):
    peer = start_peer(FAST_DDS)
    peer.serve("/light", TYPE)
    peer.name("lamp")
    client = node.create_client(SetBool, "light")
    wait_until(lambda: ("lamp", "/") in node.get_node_names_and_namespaces())
    discover(node, "light", wait_until)
    with pytest.raises(WireError, match=r"^Node /lamp uses Fast DDS, so its service /light cannot be called"):
        client.call(SetBool.Request())


def test_a_node_is_reported_once_also_if_its_name_comes_later(node, start_peer, wait_until):
    warnings = []
    participant = node._Coframe__participant
    participant.on_warning(warnings.append)
    peer = start_peer(FAST_DDS)
    for service in ("light", "motor"):
        peer.serve(f"/{service}", TYPE)
        node.create_client(SetBool, service)
    wait_until(lambda: warnings)
    peer.name("lamp")
    wait_until(lambda: ("lamp", "/") in node.get_node_names_and_namespaces())
    participant._mismatches.check(participant._endpoints())
    assert len(warnings) == 1
    assert warnings[0].startswith("An unnamed node uses Fast DDS, so its service /")


def test_a_call_before_the_server_is_discovered_fails_too(node, start_peer):
    client = node.create_client(SetBool, "light")
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    future = client.call_async(SetBool.Request(data=True))
    called = []
    future.add_done_callback(lambda done: called.append(done.exception()))
    assert not future.done()
    peer = start_peer(FAST_DDS)
    requests = peer.serve("/light", TYPE)
    executor.spin_until_future_complete(future, timeout_sec=10)
    executor.spin_once(timeout_sec=1)
    assert str(future.exception()).startswith(REFUSED.format("light"))
    assert called == [future.exception()]
    assert peer.received_on(requests) == []


def test_a_blocking_call_before_the_server_is_discovered_fails_too(node, start_peer):
    client = node.create_client(SetBool, "light")
    threading.Timer(0.1, lambda: start_peer(FAST_DDS).serve("/light", TYPE)).start()
    with pytest.raises(WireError, match="its service /light cannot be called"):
        client.call(SetBool.Request(data=True), timeout_sec=20)


def test_a_server_that_understands_is_still_reached(make_node, start_peer, wait_until):
    """Fast DDS does not match the partitions of the requests, so that they reach only the other server."""
    node, server = make_node(), make_node("server")
    server.create_service(SetBool, "light", answer)
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(server)
    executor.add_node(node)
    client = node.create_client(SetBool, "light")
    start_peer(FAST_DDS).serve("/light", TYPE)
    wait_until(lambda: len(node._Coframe__participant.subscribers("/light", kind="request")) == 2)
    assert client.wait_for_service(timeout_sec=10)
    future = client.call_async(SetBool.Request(data=True))
    executor.spin_until_future_complete(future, timeout_sec=10)
    assert future.result().success
    # Others may match all partitions. So may Fast DDS, if its profiles choose a partition.
    peer = start_peer(RTI_CONNEXT)
    requests = peer.serve("/light", TYPE)
    wait_until(lambda: len(node._Coframe__participant.subscribers("/light", kind="request")) == 3)
    assert not client.service_is_ready()
    with pytest.raises(WireError, match="uses RTI Connext, so its service /light cannot be called"):
        client.call(SetBool.Request(data=True))
    assert peer.received_on(requests) == []


def test_fast_dds_in_a_partition_may_receive_requests(make_node, start_peer, wait_until):
    node, server = make_node(), make_node("server")
    server.create_service(SetBool, "light", answer)
    client = node.create_client(SetBool, "light")
    peer = start_peer(FAST_DDS)
    peer.announce("reader", "rq/lightRequest", "std_srvs::srv::dds_::SetBool_Request_", ("robot1",))
    wait_until(lambda: len(node._Coframe__participant.subscribers("/light", kind="request")) == 2)
    with pytest.raises(WireError, match="uses Fast DDS"):
        client.call(SetBool.Request(data=True))


def test_requests_that_are_all_kept_are_not_sent_beside_fast_dds(make_node, start_peer, wait_until):
    """A writer that keeps all requests would stop when Fast DDS, which does not match it, acknowledges none."""
    node, server = make_node(), make_node("server")
    keep_all = QoSProfile(history=HistoryPolicy.KEEP_ALL)
    server.create_service(SetBool, "light", answer, qos_profile=keep_all)
    client = node.create_client(SetBool, "light", qos_profile=keep_all)
    assert client.wait_for_service(timeout_sec=10)
    peer = start_peer(FAST_DDS)
    requests = peer.serve("/light", TYPE)
    wait_until(lambda: len(node._Coframe__participant.subscribers("/light", kind="request")) == 2)
    with pytest.raises(WireError, match="uses Fast DDS"):
        client.call(SetBool.Request(data=True))
    assert peer.received_on(requests) == []


def test_a_server_with_the_same_form_is_called(node, start_peer, wait_until):
    """The participant for these tests matches and is sent requests, unless its vendor is another one."""
    peer = start_peer(CYCLONE_DDS)
    requests = peer.serve("/light", TYPE)
    client = node.create_client(SetBool, "light")
    assert client.wait_for_service(timeout_sec=10)
    client.call_async(SetBool.Request(data=True))
    wait_until(lambda: peer.received_on(requests))
    [request] = peer.received_on(requests)
    assert codec.deserialize(request[:4] + request[20:], SetBool.Request).data


def test_parameter_clients_fail(node, start_peer, wait_until):
    peer = start_peer(FAST_DDS)
    services = {
        "get_parameters": "GetParameters",
        "set_parameters": "SetParameters",
        "set_parameters_atomically": "SetParametersAtomically",
        "list_parameters": "ListParameters",
        "describe_parameters": "DescribeParameters",
        "get_parameter_types": "GetParameterTypes",
    }
    readers = [peer.serve(f"/lamp/{name}", f"rcl_interfaces/srv/{kind}") for name, kind in services.items()]
    client = AsyncParameterClient(node, "/lamp")
    for name in services:
        discover(node, f"lamp/{name}", wait_until)
    parameter = Parameter("rate", value=1)
    futures = {
        "get_parameters": client.get_parameters(["rate"]),
        "set_parameters": client.set_parameters([parameter]),
        "set_parameters_atomically": client.set_parameters_atomically([parameter]),
        "list_parameters": client.list_parameters(),
        "describe_parameters": client.describe_parameters(["rate"]),
        "get_parameter_types": client.get_parameter_types(["rate"]),
    }
    for name, future in futures.items():
        assert str(future.exception()).startswith(REFUSED.format(f"lamp/{name}")), name
    assert not client.wait_for_services(timeout_sec=0.2)
    assert [peer.received_on(reader) for reader in readers] == [[]] * 6


def serve_action(peer, name, action):
    """Announce the services of an action server. Return the readers of requests."""
    peer.announce("writer", f"rt{name}/_action/feedback", "x")
    kinds = {
        "send_goal": f"{action}_SendGoal",
        "get_result": f"{action}_GetResult",
        "cancel_goal": "action_msgs/srv/CancelGoal",
    }
    return [peer.serve(f"{name}/_action/{service}", kind) for service, kind in kinds.items()]


def test_action_clients_fail(node, start_peer, wait_until):
    peer = start_peer(FAST_DDS)
    readers = serve_action(peer, "/count", "example_interfaces/action/Fibonacci")
    client = ActionClient(node, Fibonacci, "count")
    for service in ("send_goal", "get_result", "cancel_goal"):
        discover(node, f"count/_action/{service}", wait_until)
    future = client.send_goal_async(Fibonacci.Goal(order=3), feedback_callback=print)
    assert str(future.exception()).startswith(REFUSED.format("count/_action/send_goal"))
    assert client._feedback_callbacks == {}
    with pytest.raises(WireError, match="uses Fast DDS"):
        client.send_goal(Fibonacci.Goal(order=3))
    handle = rclpy.action.client.ClientGoalHandle(client, rclpy.action.client.UUID(), None)
    with pytest.raises(WireError, match="its service /count/_action/get_result cannot be called"):
        handle.get_result()
    with pytest.raises(WireError, match="its service /count/_action/cancel_goal cannot be called"):
        handle.cancel_goal()
    assert not client.wait_for_server(timeout_sec=0.2)
    assert [peer.received_on(reader) for reader in readers] == [[]] * 3


def test_buffer_clients_fail(node, start_peer, wait_until):
    serve_action(start_peer(FAST_DDS), "/tf2_buffer_server", ACTION)
    client = BufferClient(node, "tf2_buffer_server")
    for service in ("send_goal", "get_result", "cancel_goal"):
        discover(node, f"tf2_buffer_server/_action/{service}", wait_until)
    sentence = r"^The BufferServer is not ready\. An unnamed node uses Fast DDS, so its service /tf2_buffer_server"
    with pytest.raises(TimeoutException, match=sentence):
        client.lookup_transform("map", "base_link", rclpy.time.Time())
    assert not client.can_transform("map", "base_link", rclpy.time.Time())
    client.destroy()
    client = BufferClient(node, "tf2_buffer_server")
    client.action_client.server_is_ready = lambda: True  # as if it had been, when it was asked
    with pytest.raises(TransformException, match="uses Fast DDS"):
        client.lookup_transform("map", "base_link", rclpy.time.Time())
    client.destroy()


@pytest.mark.parametrize("vendor", OTHERS)
@pytest.mark.parametrize("left", [False, True], ids=["there", "left"])
def test_no_callback_runs_on_requests_of_another_form(node, start_peer, wait_until, caplog, vendor, left):
    caplog.set_level(logging.WARNING, "coframe.wire")
    asked = []
    service = node.create_service(SetBool, "motor", lambda request, response: asked.append(request) or response)
    requests = service._Service__requests
    peer = start_peer(vendor)
    writer = peer.call("/motor", TYPE)
    wait_until(requests.matched_handles)
    peer.write(writer, WITH_HEADER)
    peer.write(writer, WITHOUT_HEADER)
    wait_until(requests.pending)
    if left:
        participant = node._Coframe__participant
        [(handle, _)] = participant._graph.writers("rq/motorRequest").items()
        participant._graph._take_endpoints(_Left(handle, peer.prefix + writer), participant._graph._writers)
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    for _ in range(10):
        executor.spin_once(timeout_sec=0.05)
    assert asked == []
    assert requests.matched == 0


class _Left:
    """The discovery reader, which reports that a writer has left."""

    def __init__(self, handle, guid):
        self._handle, self._guid = handle, guid

    def take(self):
        return [(self._handle, False, self._guid, b"", "", "", (1, False, False, False), b"", ())]


def test_a_request_of_the_same_form_is_answered(node, start_peer, wait_until):
    asked = []
    node.create_service(SetBool, "motor", lambda request, response: asked.append(request) or response)
    peer = start_peer(CYCLONE_DDS)
    peer.write(peer.call("/motor", TYPE), WITH_HEADER)
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    wait_until(lambda: asked, lambda: executor.spin_once(timeout_sec=0.05))
    assert asked[0].data
    wait_until(lambda: peer.received)
