# SPDX-License-Identifier: Apache-2.0
"""What nodes publish and answer about themselves: events of services and actions, types, endpoints of services."""

import pytest

from coframe.messages.type_hash import type_hash
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from service_msgs.msg import ServiceEventInfo
from std_srvs.srv import SetBool, SetBool_Event
from type_description_interfaces.srv import GetTypeDescription

OFF, METADATA, CONTENTS = ServiceIntrospectionState
SENT, RECEIVED, ANSWERED, GOT = range(4)
HASH = "RIHS01_" + "0" * 64


@pytest.fixture
def executor(context, node):
    with SingleThreadedExecutor(context=context) as executor:
        executor.add_node(node)
        yield executor


@pytest.fixture
def call(node, executor, wait_until):
    """Return a function that calls a service and returns the events of the call."""
    service = node.create_service(SetBool, "switch", lambda request, _: SetBool.Response(success=request.data))
    client = node.create_client(SetBool, "switch")
    events = []
    subscription = node.create_subscription(SetBool.Event, "switch/_service_event", events.append, 10)
    assert client.wait_for_service(10)

    def run(state, *, count):
        events.clear()
        for side in (service, client):
            side.configure_introspection(node.get_clock(), qos_profile_system_default, state)
        wait_until(lambda: subscription.get_publisher_count() == (0 if state is OFF else 2))
        future = client.call_async(SetBool.Request(data=True))
        executor.spin_until_future_complete(future, timeout_sec=10)
        wait_until(lambda: len(events) >= count, lambda: executor.spin_once(timeout_sec=0.1))
        return sorted(events, key=lambda event: event.info.event_type)

    return run


def test_metadata_of_requests_and_responses(node, call):
    before = node.get_clock().now()
    events = call(METADATA, count=4)
    assert [event.info.event_type for event in events] == [SENT, RECEIVED, ANSWERED, GOT]
    assert len({(bytes(event.info.client_gid), event.info.sequence_number) for event in events}) == 1
    assert all(before.nanoseconds <= event.info.stamp.sec * 10**9 + event.info.stamp.nanosec for event in events)
    assert all((list(event.request), list(event.response)) == ([], []) for event in events)


def test_contents_of_requests_and_responses(call):
    sent, received, answered, got = call(CONTENTS, count=4)
    assert list(sent.request) == list(received.request) == [SetBool.Request(data=True)]
    assert list(answered.response) == list(got.response) == [SetBool.Response(success=True)]
    assert list(sent.response) == list(got.request) == []


def test_introspection_is_switched_off_again(call):
    call(METADATA, count=4)
    assert call(OFF, count=0) == []
    assert len(call(CONTENTS, count=4)) == 4


def test_a_state_of_another_type_is_rejected(node):
    client = node.create_client(SetBool, "switch")
    with pytest.raises(TypeError, match="must be a ServiceIntrospectionState, not 1"):
        client.configure_introspection(node.get_clock(), qos_profile_system_default, 1)


def test_event_classes_have_the_names_of_ros():
    assert SetBool.Event is SetBool_Event
    assert (SetBool_Event.__module__, SetBool_Event.ROS_TYPE) == ("std_srvs.srv", "std_srvs/srv/SetBool_Event")
    assert SetBool_Event().info == ServiceEventInfo()
    with pytest.raises(AssertionError, match="with length at most 1"):
        SetBool_Event(request=[SetBool.Request(), SetBool.Request()])
    with pytest.raises(ImportError, match="cannot import name 'Nothing_Event'"):
        from std_srvs.srv import Nothing_Event  # noqa: F401


def test_events_of_actions(node, executor, wait_until):
    server = ActionServer(node, Fibonacci, "fibonacci", lambda goal: (goal.succeed(), Fibonacci.Result())[1])
    client = ActionClient(node, Fibonacci, "fibonacci")
    goals, results = [], []
    parts = Fibonacci.Impl
    node.create_subscription(parts.SendGoalService.Event, "fibonacci/_action/send_goal/_service_event", goals.append, 9)
    node.create_subscription(
        parts.GetResultService.Event, "fibonacci/_action/get_result/_service_event", results.append, 9
    )
    for side in (server, client):
        side.configure_introspection(node.get_clock(), qos_profile_system_default, CONTENTS)
    assert client.wait_for_server(10)
    wait_until(lambda: all(entity.get_publisher_count() == 2 for entity in list(node.subscriptions)[-2:]))
    sent = client.send_goal_async(Fibonacci.Goal(order=3))
    executor.spin_until_future_complete(sent, timeout_sec=10)
    executor.spin_until_future_complete(sent.result().get_result_async(), timeout_sec=10)
    wait_until(lambda: len(goals) + len(results) == 8, lambda: executor.spin_once(timeout_sec=0.1))
    assert {event.request[0].goal.order for event in goals if event.request} == {3}
    server.destroy()
    client.destroy()


@pytest.fixture
def describe(node, executor):
    client = node.create_client(GetTypeDescription, "tester/get_type_description")
    assert client.wait_for_service(10)

    def ask(name, hash_, *, sources=False):
        request = GetTypeDescription.Request(type_name=name, type_hash=hash_, include_type_sources=sources)
        future = client.call_async(request)
        executor.spin_until_future_complete(future, timeout_sec=10)
        return future.result()

    return ask


def test_a_node_describes_its_types(describe):
    answer = describe("std_srvs/srv/SetBool", type_hash(SetBool), sources=True)
    assert (answer.successful, answer.failure_reason) == (True, "")
    description = answer.type_description
    assert description.type_description.type_name == "std_srvs/srv/SetBool"
    fields = [(field.name, field.type.nested_type_name) for field in description.type_description.fields]
    assert fields[0] == ("request_message", "std_srvs/srv/SetBool_Request")
    names = [each.type_name for each in description.referenced_type_descriptions]
    assert names[:2] == ["builtin_interfaces/msg/Time", "service_msgs/msg/ServiceEventInfo"]
    sources = {source.type_name: (source.encoding, source.raw_file_contents) for source in answer.type_sources}
    assert sources["std_srvs/srv/SetBool"] == ("srv", "bool data\n---\nbool success\nstring message")
    assert sources["std_srvs/srv/SetBool_Event"] == ("implicit", "")
    assert sources["builtin_interfaces/msg/Time"] == ("msg", "int32 sec\nuint32 nanosec\n")


def test_a_type_that_the_node_uses_is_found_by_its_hash(node, describe):
    node.create_client(SetBool, "switch")
    assert describe("", type_hash(SetBool)).type_description.type_description.type_name == "std_srvs/srv/SetBool"


@pytest.mark.parametrize(
    ("name", "hash_", "reason"),
    [
        ("std_srvs/srv/SetBool", "RIHS01_12", "Failed to parse type hash"),
        ("std_srvs/srv/SetBool", HASH, "Type not currently in use by this node"),
        ("no_package/msg/Thing", HASH, "Type not currently in use by this node"),
        ("/../..", "", "Failed to parse type hash"),
    ],
)
def test_types_that_cannot_be_described(describe, name, hash_, reason):
    answer = describe(name, hash_)
    assert (answer.successful, answer.failure_reason) == (False, reason)


def test_a_parameter_switches_the_service_off(make_node):
    name = "start_type_description_service"
    node = make_node(parameter_overrides=[Parameter(name, value=False)])
    assert list(node.services) == []
    assert node.describe_parameter(name).read_only


def test_clients_and_servers_of_a_service(make_node, wait_until):
    server, user = make_node("server"), make_node("user", namespace="/robot")
    server.create_service(SetBool, "/switch", lambda _, response: response)
    user.create_client(SetBool, "/switch")
    wait_until(lambda: user.count_services("/switch") == user.count_clients("/switch") == 1)
    (served,), (used,) = user.get_servers_info_by_service("/switch"), server.get_clients_info_by_service("/switch")
    assert (served.node_name, served.endpoint_type.name) == ("server", "SERVER")
    assert (used.node_name, used.node_namespace, used.endpoint_type.name) == ("user", "/robot", "CLIENT")
    assert (served.service_type, str(served.service_type_hash)) == ("std_srvs/srv/SetBool", type_hash(SetBool))
    assert f"Service type hash: {type_hash(SetBool)}\nEndpoint type: SERVER\nEndpoint count: " in str(served)
    assert user.get_servers_info_by_service("/other") == []
    with pytest.raises(ValueError, match="topic name 'a//b' is invalid"):
        user.get_servers_info_by_service("a//b")
