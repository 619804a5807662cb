# SPDX-License-Identifier: Apache-2.0
"""Requests and replies that are not valid: no callback runs, no call is answered, and one warning has their number."""

import logging

import pytest
from rtps_peer import CYCLONE_DDS

import rclpy
from coframe.errors import DecodeError
from coframe.messages import codec
from coframe.wire import request_header
from coframe.wire.request_header import RequestHeader
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from nav_msgs.srv import GetPlan
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionServer
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool

pytestmark = pytest.mark.dds_only("the requests come from an RTPS program")

HEADER = RequestHeader(7, 1)
SET_RATE = SetParameters.Request(parameters=[Parameter("rate", value=7).to_parameter_msg()])


def plan_request() -> GetPlan.Request:
    """Return a request that is still a valid GetPlan request of another plan if its first 16 bytes are missing."""
    request = GetPlan.Request(tolerance=0.25)
    request.start.header.frame_id = request.goal.header.frame_id = "map"
    request.goal.pose.orientation.w = 1.0
    return request


def hostile(request) -> list[bytes]:
    """Return damaged forms of a request."""
    valid = request_header.join(HEADER, codec.serialize(request))
    return [
        codec.serialize(request),  # without a header, as other middlewares send it
        valid[:12],  # half a header
        valid[:20],  # nothing but the header
        valid[: (len(valid) - 1) // 4 * 4],  # truncated
        b"\x00\x03" + valid[2:],  # a parameter list
        valid + bytes(4),
        valid + b"\xff" * 40,
        valid[:20] + b"\xff" * 12,  # impossible lengths
    ]


@pytest.fixture
def attack(start_peer):
    """Return a function that sends the damaged forms of a request to a service, and then the request itself."""
    peer = start_peer(CYCLONE_DDS)

    def send(service, srv_type, request):
        writer = peer.call(service, srv_type)
        for message in [*hostile(request), request_header.join(HEADER, codec.serialize(request))]:
            peer.write(writer, message)
        return peer

    return send


@pytest.fixture
def spin(context, node, wait_until):
    """Return a function that spins until a condition is true."""
    executor = rclpy.executors.SingleThreadedExecutor(context=context)
    executor.add_node(node)
    return lambda condition: wait_until(condition, lambda: executor.spin_once(timeout_sec=0.01))


@pytest.fixture
def warnings_about(caplog):
    """Return a function that returns the warnings about a service."""
    caplog.set_level(logging.WARNING, "coframe.wire")
    return lambda service: [record.message for record in caplog.records if f" of {service}" in record.message]


@pytest.mark.parametrize(
    ("srv_type", "request_"),
    [
        (SetBool, SetBool.Request(data=True)),
        (AddTwoInts, AddTwoInts.Request(a=1, b=2)),
        (GetPlan, plan_request()),
        (SetParameters, SET_RATE),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_no_callback_of_a_service_runs(node, attack, spin, warnings_about, srv_type, request_):
    asked = []
    service = node.create_service(srv_type, "plan", lambda request, response: asked.append(request) or response)
    attack("/plan", srv_type.Request.ROS_TYPE.removesuffix("_Request"), request_).name("attacker")
    spin(lambda: asked)
    assert asked == [request_]
    ignored = service._Service__requests.ignored
    assert len(hostile(request_)) - 2 <= ignored <= len(hostile(request_))  # DDS drops some by itself.
    spin(lambda: warnings_about("/plan"))
    [warning] = warnings_about("/plan")
    assert warning.startswith(f"Ignored {ignored} requests of /plan")
    assert ": the last one is invalid (" in warning
    assert "Check that both sides have the same definition of the service and the same middleware." in warning


def test_a_request_without_a_header_is_reported(node, start_peer, spin, warnings_about):
    service = node.create_service(SetBool, "switch", lambda _, response: response)
    peer = start_peer(CYCLONE_DDS)
    writer = peer.call("/switch", "std_srvs/srv/SetBool")
    peer.name("attacker")
    spin(lambda: ("attacker", "/") in node.get_node_names_and_namespaces())
    peer.write(writer, codec.serialize(SetBool.Request(data=True)))
    spin(lambda: service._Service__requests.ignored)
    spin(lambda: warnings_about("/switch"))
    [warning] = warnings_about("/switch")
    assert warning.startswith("Ignored 1 request of /switch from /attacker: it has ")
    assert "bytes without a CDR header and a request header" in warning


def test_a_flood_causes_one_warning(node, start_peer, spin, warnings_about):
    service = node.create_service(SetBool, "switch", lambda _, response: response)
    peer = start_peer(CYCLONE_DDS)
    writer = peer.call("/switch", "std_srvs/srv/SetBool")
    for _ in range(3):
        before = service._Service__requests.ignored
        for _ in range(100):
            peer.write(writer, b"\x00\x01\x00\x00" + bytes(8))
        spin(lambda before=before: service._Service__requests.ignored > before)  # The queue has ten.
        spin(lambda: warnings_about("/switch"))
    assert len(warnings_about("/switch")) == 1


def test_no_callback_of_parameters_runs(context, node, attack, spin, warnings_about):
    served = rclpy.create_node("served", context=context)
    served.declare_parameter("rate", 5)
    changed = []
    served.add_on_set_parameters_callback(changed.append)
    node.executor.add_node(served)
    attack("/served/set_parameters", "rcl_interfaces/srv/SetParameters", SET_RATE)
    with pytest.raises(AttributeError):  # of the callback's result, for the valid request
        spin(lambda: warnings_about("/served/set_parameters") and changed)
    assert [[parameter.value for parameter in parameters] for parameters in changed] == [[7]]
    spin(lambda: warnings_about("/served/set_parameters"))
    served.destroy_node()


def test_parameter_services_of_nodes_without_parameters(node, attack, wait_until, warnings_about):
    node._Coframe__participant.add_node("/", "command")
    peer = attack("/command/set_parameters", "rcl_interfaces/srv/SetParameters", SET_RATE)
    wait_until(lambda: warnings_about("/command/set_parameters"))
    wait_until(lambda: peer.received)  # the response to the valid request


def test_no_callback_of_an_action_server_runs(node, attack, spin, warnings_about):
    called, parts = [], Fibonacci.Impl
    server = ActionServer(
        node, Fibonacci, "count", called.append, goal_callback=called.append, cancel_callback=called.append
    )
    prefix = "example_interfaces/action/Fibonacci"
    goal = parts.SendGoalService.Request(goal=Fibonacci.Goal(order=3))
    attack("/count/_action/send_goal", f"{prefix}_SendGoal", goal)
    attack("/count/_action/get_result", f"{prefix}_GetResult", parts.GetResultService.Request())
    attack("/count/_action/cancel_goal", "action_msgs/srv/CancelGoal", parts.CancelGoalService.Request())
    spin(lambda: all(warnings_about(f"/count/_action/{name}") for name in ("send_goal", "get_result", "cancel_goal")))
    spin(lambda: called)
    assert called == [Fibonacci.Goal(order=3)]
    server.destroy()


def test_only_replies_that_are_understood_are_answers(node, start_peer, spin, warnings_about, wait_until):
    peer = start_peer(CYCLONE_DDS)
    reader = peer.announce("reader", "rq/switchRequest", "std_srvs::srv::dds_::SetBool_Request_")
    writer = peer.announce("writer", "rr/switchReply", "std_srvs::srv::dds_::SetBool_Response_")
    client = node.create_client(SetBool, "switch")
    assert client.wait_for_service(timeout_sec=10)
    first, second = client.call_async(SetBool.Request(data=True)), client.call_async(SetBool.Request())
    wait_until(lambda: len(peer.received_on(reader)) >= 2)
    header, second_header = (request_header.split(request)[0] for request in peer.received_on(reader)[:2])
    reply = codec.serialize(SetBool.Response(success=True, message="done"))
    for message in (
        reply,
        reply[:12],
        request_header.join(RequestHeader(header.client ^ 1, header.sequence), reply),
        request_header.join(RequestHeader(header.client, 99), reply),
        request_header.join(RequestHeader(header.sequence, 0), reply),
    ):
        peer.write(writer, message)
    spin(lambda: warnings_about("/switch"))
    assert warnings_about("/switch")[0].startswith("Ignored 1 reply of /switch: it has 12 bytes without ")
    assert not first.done()
    assert not second.done()
    peer.write(writer, request_header.join(second_header, reply + bytes(8)))  # another layout
    spin(second.done)
    assert isinstance(second.exception(), DecodeError)
    peer.write(writer, request_header.join(header, reply))
    spin(first.done)
    assert first.result() == SetBool.Response(success=True, message="done")
