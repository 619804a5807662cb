# SPDX-License-Identifier: Apache-2.0
"""Services, service clients and parameter services."""

import threading
import time

import pytest

import rclpy
from coframe.messages import codec
from coframe.wire import QoS, request_header
from coframe.wire.request_header import RequestHeader
from rcl_interfaces.msg import LoggerLevel
from rcl_interfaces.srv import GetLoggerLevels, GetParameters, ListParameters, SetLoggerLevels, SetParameters
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.logging import LoggingSeverity
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from std_srvs.srv import SetBool, Trigger


def answer(request, response):
    response.success = request.data
    response.message = f"got {request.data}"
    return response


@pytest.fixture
def executor(node):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    return executor


def test_call_async(node, executor):
    node.create_service(SetBool, "switch", answer)
    client = node.create_client(SetBool, "switch")
    assert client.wait_for_service(timeout_sec=10)
    assert client.service_is_ready()
    assert ("/switch", ["std_srvs/srv/SetBool"]) in node.get_service_names_and_types()
    futures = [client.call_async(SetBool.Request(data=value)) for value in (True, False, True)]
    for future in futures:
        executor.spin_until_future_complete(future, timeout_sec=10)
    assert [future.result().success for future in futures] == [True, False, True]


def test_clients_receive_only_their_own_responses(node, executor):
    node.create_service(SetBool, "switch", answer)
    clients = [node.create_client(SetBool, "switch") for _ in range(2)]
    assert all(client.wait_for_service(timeout_sec=10) for client in clients)
    futures = [client.call_async(SetBool.Request(data=index == 0)) for index, client in enumerate(clients)]
    for future in futures:
        executor.spin_until_future_complete(future, timeout_sec=10)
    assert [future.result().message for future in futures] == ["got True", "got False"]


def test_no_server_available(node):
    client = node.create_client(SetBool, "nowhere")
    assert not client.service_is_ready()
    assert not client.wait_for_service(timeout_sec=0.05)
    assert client.call(SetBool.Request(), timeout_sec=0.05) is None
    with pytest.raises(TypeError, match="Expected"):
        client.call_async(SetBool.Response())


def test_blocking_call_from_another_thread(node, executor):
    node.create_service(SetBool, "switch", answer)
    client = node.create_client(SetBool, "switch")
    assert client.wait_for_service(timeout_sec=10)
    results = []
    thread = threading.Thread(target=lambda: results.append(client.call(SetBool.Request(data=True), timeout_sec=10)))
    thread.start()
    while thread.is_alive():
        executor.spin_once(timeout_sec=0.05)
    assert results[0].success


def test_blocking_call_inside_a_callback(make_node, wait_until):
    node = make_node()
    pool = MultiThreadedExecutor(3, context=node.context)
    pool.add_node(node)
    node.create_service(SetBool, "switch", answer, callback_group=MutuallyExclusiveCallbackGroup())
    client = node.create_client(SetBool, "switch", callback_group=MutuallyExclusiveCallbackGroup())
    assert client.wait_for_service(timeout_sec=10)
    results = []
    guard = node.create_guard_condition(lambda: results.append(client.call(SetBool.Request(data=True), timeout_sec=10)))
    guard.trigger()
    wait_until(lambda: results, lambda: pool.spin_once(timeout_sec=0.1))
    assert results[0].success
    pool.shutdown(timeout_sec=10)


def test_blocking_call_inside_a_callback_of_a_single_threaded_executor(make_node, executor):
    server = make_node("server")
    server.create_service(SetBool, "switch", answer)
    serving = SingleThreadedExecutor(context=server.context)
    serving.add_node(server)
    thread = threading.Thread(target=serving.spin)
    thread.start()
    node = executor.get_nodes()[0]
    client = node.create_client(SetBool, "switch")
    assert client.wait_for_service(timeout_sec=10)
    results = []
    node.create_guard_condition(
        lambda: results.append(client.call(SetBool.Request(data=True), timeout_sec=10))
    ).trigger()
    executor.spin_once(timeout_sec=10)
    serving.shutdown()
    thread.join()
    assert results[0].success


def test_await_inside_a_callback(node, executor):
    inner = MutuallyExclusiveCallbackGroup()
    node.create_service(SetBool, "inner", answer, callback_group=inner)
    client = node.create_client(SetBool, "inner", callback_group=inner)

    async def outer(_, response):
        response.success = (await client.call_async(SetBool.Request(data=True))).success
        return response

    node.create_service(Trigger, "outer", outer)
    caller = node.create_client(Trigger, "outer", callback_group=inner)
    assert client.wait_for_service(timeout_sec=10)
    assert caller.wait_for_service(timeout_sec=10)
    future = caller.call_async(Trigger.Request())
    executor.spin_until_future_complete(future, timeout_sec=10)
    assert future.result().success


def test_spin_raises_if_a_callback_returns_no_response(node, executor):
    node.create_service(SetBool, "switch", lambda _request, _response: None)
    client = node.create_client(SetBool, "switch")
    assert client.wait_for_service(timeout_sec=10)
    future = client.call_async(SetBool.Request())
    with pytest.raises(TypeError, match="Expected"):
        executor.spin_until_future_complete(future, timeout_sec=10)


def test_parameter_services(context, make_node, executor):
    served = rclpy.create_node("served", context=context)
    served.declare_parameters("", [("rate", 5), ("gain.p", 1.0)])
    executor.add_node(served)
    node = make_node("asker")
    executor.add_node(node)

    def call(srv_type, name, **fields):
        client = node.create_client(srv_type, f"/served/{name}")
        assert client.wait_for_service(timeout_sec=10)
        future = client.call_async(srv_type.Request(**fields))
        executor.spin_until_future_complete(future, timeout_sec=10)
        return future.result()

    listed = call(ListParameters, "list_parameters").result
    assert set(listed.names) == {"use_sim_time", "start_type_description_service", "rate", "gain.p"}
    assert listed.prefixes == ["gain"]
    assert call(ListParameters, "list_parameters", prefixes=["gain"]).result.names == ["gain.p"]
    [value] = call(GetParameters, "get_parameters", names=["rate"]).values
    assert (value.type, value.integer_value) == (2, 5)
    assert call(GetParameters, "get_parameters", names=["rate", "unknown"]).values == []  # as upstream
    messages = [Parameter("rate", value=7).to_parameter_msg(), Parameter("unknown", value=7).to_parameter_msg()]
    results = call(SetParameters, "set_parameters", parameters=messages).results
    assert [result.successful for result in results] == [True, False]
    assert served.get_parameter("rate").value == 7
    served.destroy_node()


def test_log_levels_through_services(context, make_node, executor):
    served = rclpy.create_node("served", context=context, start_parameter_services=False, enable_logger_service=True)
    asker = make_node("asker")
    executor.add_node(served)
    executor.add_node(asker)

    def call(srv_type, name, **fields):
        client = asker.create_client(srv_type, f"/served/{name}")
        assert client.wait_for_service(timeout_sec=10)
        future = client.call_async(srv_type.Request(**fields))
        executor.spin_until_future_complete(future, timeout_sec=10)
        return future.result()

    levels = [LoggerLevel(name="served", level=10), LoggerLevel(name="served", level=77)]
    results = call(SetLoggerLevels, "set_logger_levels", levels=levels).results
    assert [result.successful for result in results] == [True, False]
    assert "77" in results[1].reason
    assert served.get_logger().get_effective_level() is LoggingSeverity.DEBUG
    found = call(GetLoggerLevels, "get_logger_levels", names=["served", "unknown"]).levels
    assert [(level.name, level.level) for level in found] == [("served", 10), ("unknown", 0)]
    rclpy.logging.clear_config()
    served.destroy_node()


def test_pending_requests_by_number(node):
    client = node.create_client(SetBool, "switch")
    future = client.call_async(SetBool.Request())
    assert client.get_pending_request(1) is future
    with pytest.raises(KeyError):
        client.get_pending_request(2)


@pytest.fixture
def stranger(node, wait_until):
    """A client whose subscription to replies does not exist yet: its publisher, and a function that sends requests."""
    participant, qos = node._Coframe__participant, QoS(depth=200)
    requests = participant.service_publisher(
        participant.add_node("/", "stranger"), "/trigger", Trigger.Request, qos, "request", user_data="clientid=7;"
    )

    def send(count):
        wait_until(lambda: requests.matched == 1)
        for number in range(count):
            requests.write(request_header.join(RequestHeader(7, number + 1), codec.serialize(Trigger.Request())))

    yield send
    requests.close()


@pytest.mark.dds_only("over Zenoh, a reply needs no subscription")
def test_a_client_without_a_subscription_to_replies_delays_neither_the_node_nor_other_clients(
    node, executor, stranger, wait_until
):
    calls = []
    node.create_service(
        Trigger,
        "/trigger",
        lambda request, response: calls.append(request) or response,
        qos_profile=QoSProfile(depth=200),
    )
    client = node.create_client(Trigger, "/trigger")
    assert client.wait_for_service(timeout_sec=10.0)
    stranger(150)  # more than the number of replies that are kept for a client
    start = time.monotonic()
    wait_until(lambda: len(calls) == 150, lambda: executor.spin_once(timeout_sec=0.01))
    future = client.call_async(Trigger.Request())
    wait_until(future.done, lambda: executor.spin_once(timeout_sec=0.01))
    assert time.monotonic() - start < 1.0  # in which the first reply to the stranger still waits


@pytest.mark.dds_only("over Zenoh, a reply needs no subscription")
def test_a_reply_waits_until_its_client_can_receive_it(node, executor, stranger, wait_until):
    """Another client of the same process is discovered already, and shows nothing about this one."""
    calls = []
    node.create_service(Trigger, "/trigger", lambda request, response: calls.append(request) or response)
    assert node.create_client(Trigger, "/trigger").wait_for_service(timeout_sec=10.0)
    stranger(3)
    wait_until(lambda: len(calls) == 3, lambda: executor.spin_once(timeout_sec=0.01))
    participant = node._Coframe__participant
    replies = participant.service_subscription(
        participant.add_node("/", "late"), "/trigger", Trigger.Response, QoS(), "reply", user_data="clientid=7;"
    )
    received = []
    wait_until(lambda: received.extend(replies.take_messages()) or len(received) == 3)
    assert [message.header for message in received] == [RequestHeader(7, number) for number in (1, 2, 3)]


@pytest.mark.dds_only("over Zenoh, a reply needs no subscription")
def test_a_service_that_is_destroyed_sends_its_last_reply(node, executor, stranger, wait_until):
    calls = []
    service = node.create_service(Trigger, "/trigger", lambda request, response: calls.append(request) or response)
    stranger(1)
    wait_until(lambda: calls, lambda: executor.spin_once(timeout_sec=0.01))
    participant = node._Coframe__participant
    late = participant.add_node("/", "late")
    destroying = threading.Thread(target=node.destroy_service, args=(service,))
    destroying.start()
    replies = participant.service_subscription(
        late, "/trigger", Trigger.Response, QoS(), "reply", user_data="clientid=7;"
    )
    received = []
    wait_until(lambda: received.extend(replies.take_messages()) or received)
    destroying.join()
    assert received[0].header == RequestHeader(7, 1)
