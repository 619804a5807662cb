# SPDX-License-Identifier: Apache-2.0
"""Parameters of other nodes: events, clients, and callbacks around a change."""

import time

import pytest

import rcl_interfaces.msg
import rclpy
from rcl_interfaces.msg import ParameterDescriptor, ParameterEvent, SetParametersResult
from rclpy import _parameter_limits
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter, parameter_dict_from_yaml_file, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient
from rclpy.parameter_event_handler import ParameterEventHandler

DYNAMIC = ParameterDescriptor(dynamic_typing=True)


@pytest.fixture
def executor(context):
    executor = SingleThreadedExecutor(context=context)
    yield executor
    executor.shutdown()


def test_events_reach_handlers_of_other_nodes(make_node, executor, wait_until):
    observer, robot = make_node("observer", namespace="/ns"), make_node("robot", namespace="/ns")
    executor.add_node(observer)
    handler, seen, events = ParameterEventHandler(observer), [], []
    wait_until(lambda: next(robot.publishers).get_subscription_count())

    def note(name):
        return lambda parameter: seen.append((name, parameter_value_to_python(parameter.value)))

    handle = handler.add_parameter_callback("speed", "robot", note("first"))
    handler.add_parameter_callback("speed", "/ns/robot", note("second"))
    handler.add_parameter_callback("speed", "", note("of the observer"))
    handler.add_parameter_event_callback(events.append)
    robot.declare_parameter("speed", 1, ParameterDescriptor(dynamic_typing=True))
    robot.set_parameters([Parameter("speed", value=2)])
    robot.set_parameters([Parameter("speed")])
    spin = lambda: executor.spin_once(timeout_sec=0.02)  # noqa: E731
    wait_until(lambda: len(events) == 3, spin)
    assert seen == [("second", 1), ("first", 1), ("second", 2), ("first", 2)]
    assert [event.node for event in events] == ["/ns/robot"] * 3
    assert all(event.stamp.sec > 0 for event in events)
    new, changed, deleted = events
    assert [[p.name for p in group] for group in (new.new_parameters, changed.changed_parameters)] == [["speed"]] * 2
    assert [(p.name, p.value.integer_value) for p in deleted.deleted_parameters] == [("speed", 2)]

    handler.remove_parameter_callback(handle)
    with pytest.raises(ValueError, match="not in list"):
        handler.remove_parameter_callback(handle)
    assert handler.configure_nodes_filter(["robot"])
    seen.clear()
    robot.declare_parameter("speed", 3)
    wait_until(lambda: seen, spin)
    assert seen == [("second", 3)]
    handler.configure_nodes_filter(["other"])
    robot.set_parameters([Parameter("speed", value=4)])
    handler.configure_nodes_filter([])
    handler.destroy()


def test_parameters_of_an_event():
    event = ParameterEvent(node="/a", changed_parameters=[Parameter("x", value=1.5).to_parameter_msg()])
    assert ParameterEventHandler.get_parameter_from_event(event, "x", "/a").value.double_value == 1.5
    assert ParameterEventHandler.get_parameter_from_event(event, "x", "/b") is None
    assert ParameterEventHandler.get_parameter_from_event(event, "y", "/a") is None


def test_client_of_another_node(context, make_node, executor, wait_until, tmp_path):
    served = rclpy.create_node("served", context=context)
    served.declare_parameters("", [("rate", 5), ("gain.p", 1.0), ("any", 1, DYNAMIC)])
    asker = make_node("asker")
    executor.add_node(served)
    executor.add_node(asker)
    client = AsyncParameterClient(asker, "served")
    assert client.wait_for_services(10)
    assert client.services_are_ready()

    def result(future):
        executor.spin_until_future_complete(future, timeout_sec=10)
        return future.result()

    names = {"use_sim_time", "start_type_description_service", "rate", "gain.p", "any"}
    assert set(result(client.list_parameters()).result.names) == names
    assert result(client.list_parameters(["gain"], 1)).result.names == ["gain.p"]
    assert [value.integer_value for value in result(client.get_parameters(["rate"])).values] == [5]
    assert list(result(client.get_parameter_types(["rate", "gain.p"])).types) == [2, 3]
    assert [found.name for found in result(client.describe_parameters(["gain.p"])).descriptors] == ["gain.p"]
    done = []
    results = result(client.set_parameters([Parameter("rate", value=6), Parameter("rate", value="x")], done.append))
    assert [entry.successful for entry in results.results] == [True, False]
    wait_until(lambda: done, lambda: executor.spin_once(timeout_sec=0.02))
    both = [Parameter("rate", value=7), Parameter("gain.p", value="x").to_parameter_msg()]
    assert not result(client.set_parameters_atomically(both)).result.successful
    assert served.get_parameter("rate").value == 6
    unknown = rcl_interfaces.msg.Parameter(name="rate", value=rcl_interfaces.msg.ParameterValue(type=99))
    for request in (client.set_parameters, client.set_parameters_atomically):
        answer = result(request([unknown]))
        refused = answer.results[0] if request == client.set_parameters else answer.result
        assert (refused.successful, refused.reason) == (False, "Unexpected parameter type 99.")
    assert [entry.successful for entry in result(client.delete_parameters(["any", "rate"])).results] == [True, False]
    assert not served.has_parameter("any")

    pytest.importorskip("yaml")
    path = tmp_path / "parameters.yaml"
    path.write_text("served: {ros__parameters: {rate: 8}}\n/**: {ros__parameters: {gain: {p: 2.0}}}\n")
    assert list(parameter_dict_from_yaml_file(str(path))) == ["rate"]
    assert [entry.successful for entry in result(client.load_parameter_file(str(path))).results] == [True]
    assert (served.get_parameter("rate").value, served.get_parameter("gain.p").value) == (8, 1.0)
    assert result(client.load_parameter_file_atomically(str(path), use_wildcard=True)).result.successful
    assert served.get_parameter("gain.p").value == 2.0
    with pytest.raises(RuntimeError, match="does not contain any valid parameters"):
        parameter_dict_from_yaml_file(str(path), target_nodes=["/other"])
    served.destroy_node()


@pytest.fixture
def ask(context, make_node, executor):
    """Return a function that creates a node and returns it with a function, which sends requests to it and waits."""
    served = []

    def create(**options):
        served.append(rclpy.create_node("served", context=context, **options))
        asker = make_node("asker")
        for node in (served[0], asker):
            executor.add_node(node)
        client = AsyncParameterClient(asker, "served")
        assert client.wait_for_services(10)

        def send(request, *args):
            future = getattr(client, request)(*args)
            executor.spin_until_future_complete(future, timeout_sec=20)
            return future.result()

        return served[0], send

    yield create
    for node in served:
        node.destroy_node()


def test_other_nodes_cannot_add_parameters_without_limit(ask, monkeypatch):
    node, send = ask(allow_undeclared_parameters=True)
    monkeypatch.setattr(_parameter_limits, "MAX_PARAMETERS", 3)
    monkeypatch.setattr(_parameter_limits, "MAX_BYTES", 4 << 20)
    full = "Other nodes can set at most 3 parameters of a node and 4 MiB in total."
    results = send("set_parameters", [Parameter(f"p{i}", value=i) for i in range(5)]).results
    assert [result.reason for result in results] == ["", "", "", full, full]
    assert not node.has_parameter("p3")
    assert send("set_parameters_atomically", [Parameter("p3", value=3)]).result.reason == full
    assert send("set_parameters", [Parameter("p0", value=10)]).results[0].successful, "it is not a new one"
    assert [result.successful for result in send("delete_parameters", ["p0"]).results] == [True]
    assert send("set_parameters", [Parameter("p3", value=3)]).results[0].successful
    assert send("set_parameters", [Parameter("p3", value="x" * (5 << 20))]).results[0].reason == full
    assert node.get_parameter("p3").value == 3
    long = send("set_parameters", [Parameter("x" * 300, value=3)]).results[0].reason
    assert long == "The name of a new parameter is longer than the maximum of 256 bytes."
    node.declare_parameter("y" * 300, 1)
    send("delete_parameters", ["p1"])
    assert send("set_parameters", [Parameter("y" * 300, value=2)]).results[0].successful, "the node declared it"
    assert node.declare_parameter("own", 1).value == 1, "the node itself has no limit"


def test_a_request_with_many_names_is_answered_soon(ask):
    node, send = ask()
    for i in range(200):
        node.declare_parameter(f"gain.joint_{i}", 0.0)
    start = time.monotonic()
    results = send("set_parameters", [Parameter(f"gain.joint_{i}x", value=0.0) for i in range(10_000)]).results
    assert [result.successful for result in results] == [False] * 10_000
    assert "Invalid access to undeclared parameter(s)" in results[0].reason
    listed = send("list_parameters", [f"gain.axis_{i}" for i in range(100_000)] + ["gain"], 1).result.names
    assert len(listed) == 200
    assert time.monotonic() - start < 10


def test_callbacks_before_and_after_a_change(node):
    node.declare_parameter("a", 1)
    node.declare_parameter("b", 0)
    after = []

    def add_b(parameters):
        return [*parameters, Parameter("b", value=parameters[0].value * 10)]

    def check(parameters):
        return SetParametersResult(successful=all(parameter.value < 100 for parameter in parameters), reason="too big")

    node.add_pre_set_parameters_callback(add_b)
    node.add_on_set_parameters_callback(check)
    node.add_post_set_parameters_callback(after.append)
    assert node.set_parameters([Parameter("a", value=2)])[0].successful
    assert (node.get_parameter("a").value, node.get_parameter("b").value) == (2, 20)
    assert [[parameter.name for parameter in parameters] for parameters in after] == [["a", "b"]]
    assert node.set_parameters_atomically([Parameter("a", value=10)]).reason == "too big"
    assert len(after) == 1
    node.remove_pre_set_parameters_callback(add_b)
    node.add_pre_set_parameters_callback(lambda _: [])
    assert "parameter list cannot be empty" in node.set_parameters([Parameter("a", value=1)])[0].reason
    node.remove_post_set_parameters_callback(after.append)


def test_a_client_subscribes_to_the_events_of_all_nodes(make_node, executor, wait_until):
    observer, robot, events = make_node("observer"), make_node("robot"), []
    subscription = AsyncParameterClient.on_parameter_event(observer, events.append)
    executor.add_node(observer)
    wait_until(lambda: subscription.get_publisher_count() >= 2, timeout=20.0)
    robot.declare_parameter("rate", 5)
    wait_until(
        lambda: any(event.node == "/robot" for event in events),
        lambda: executor.spin_once(timeout_sec=0.05),
        timeout=20.0,
    )
