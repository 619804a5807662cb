# SPDX-License-Identifier: Apache-2.0
"""Nodes answer requests while and after another process floods them, with few lines in their log."""

import time

import pytest

import rclpy.executors
from rcl_interfaces.srv import GetParameters
from rclpy.context import Context
from rclpy.parameter import Parameter

SERVER = """
    import threading
    import rclpy
    from std_srvs.srv import SetBool

    rclpy.init()
    node = rclpy.create_node("server")
    node.declare_parameter("size", 5)
    node.create_service(SetBool, "/switch", lambda request, response: response)
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    print("ready", flush=True)
    input()
"""
EMPTY_REQUEST = "00010000" + 16 * "00"  # of every parameter service
DAMAGED_REQUEST = "00010000" + "ffffff7f"
NO_REQUEST = "ff"
SERVICES = 8  # of the server: six for parameters, get_type_description and /switch
REQUESTS = 500  # to each service


@pytest.fixture
def client(zenoh_domain):
    """A node with one client and no services, so that replies of the other services have no receiver."""
    context = Context()
    context.init([], domain_id=zenoh_domain)
    no_service = Parameter("start_type_description_service", value=False)
    node = rclpy.create_node(
        "client", context=context, start_parameter_services=False, parameter_overrides=[no_service]
    )
    yield node
    node.destroy_node()
    context.shutdown()


def answer(node, client):
    """Return the value of the parameter, and how many seconds the answer has taken."""
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    start = time.monotonic()
    future = client.call_async(GetParameters.Request(names=["size"]))
    executor.spin_until_future_complete(future, timeout_sec=30)
    executor.remove_node(node)
    assert future.done(), "the request was not answered"
    return future.result().values[0].integer_value, time.monotonic() - start


@pytest.mark.parametrize(
    ("request_bytes", "is_attached"),
    [
        pytest.param(NO_REQUEST, True, marks=pytest.mark.slow),
        pytest.param(EMPTY_REQUEST, False, marks=pytest.mark.slow),
        (DAMAGED_REQUEST, True),
        (EMPTY_REQUEST, True),
    ],
    ids=["no CDR", "no attachment", "damaged", "valid from a program that is not a node"],
)
def test_a_flood_of_requests(client, ros_peer, child, eventually, request_bytes, is_attached):
    server = child(SERVER)
    assert server.stdout.readline() == "ready\n"
    eventually(lambda: sum("/SS/" in token for token in ros_peer("tokens")) == SERVICES)
    assert ros_peer("flood_services", REQUESTS, request_bytes, is_attached) == SERVICES * REQUESTS
    get_parameters = client.create_client(GetParameters, "/server/get_parameters")
    assert get_parameters.wait_for_service(10)
    for _ in range(3):
        value, seconds = answer(client, get_parameters)
        assert value == 5
        assert seconds < 10
    # No request is stored until its timeout, which is 10 minutes.
    eventually(lambda: ros_peer("ended_requests") == SERVICES * REQUESTS)
    _, errors = server.communicate("\n", timeout=30)
    assert len(errors.splitlines()) < 20, errors[-2000:]
