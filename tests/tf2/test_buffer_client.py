# SPDX-License-Identifier: Apache-2.0
"""Lookups in the buffer of another node."""

import asyncio
import subprocess
import sys
import threading
import time

import pytest

import rclpy
import tf2_ros
from action_msgs.msg import GoalStatus
from action_msgs.srv import CancelGoal
from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import PointStamped
from rclpy.action import ActionClient, ActionServer, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error
from tf2_ros import Buffer, BufferClient, BufferServer

LONG = Duration(seconds=20)


@pytest.fixture
def context(domain_id):
    context = Context()
    context.init([], domain_id=domain_id)
    yield context
    context.try_shutdown()


@pytest.fixture
def make_node(context):
    nodes = []

    def make(name):
        nodes.append(rclpy.create_node(name, context=context, start_parameter_services=False))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()


@pytest.fixture
def spin(context):
    """Return a function that spins a node in a thread until the test ends."""
    running = []

    def start(node, executor=SingleThreadedExecutor):
        spinner = executor(context=context)
        spinner.add_node(node)
        thread = threading.Thread(target=spinner.spin)
        thread.start()
        running.append((spinner, thread))

    yield start
    for spinner, thread in running:
        spinner.shutdown(timeout_sec=10)
        thread.join(10)


@pytest.fixture
def buffer():
    """Return the buffer of the server."""
    return Buffer(cache_time=Duration(seconds=1000))


@pytest.fixture
def server(make_node, spin, buffer):
    node = make_node("server")
    server = BufferServer(buffer, node, "tf2_buffer_server")
    spin(node)
    return server


@pytest.fixture
def client(make_node):
    return BufferClient(make_node("client"), "tf2_buffer_server")


@pytest.fixture
def connected(request, client):
    """Return the client after it has found the server."""
    request.getfixturevalue("server")
    assert client.action_client.wait_for_server(timeout_sec=10)
    return client


def wait_until(condition, meanwhile=lambda: time.sleep(0.005)):
    deadline = time.monotonic() + 20
    while not condition():
        assert time.monotonic() < deadline, "the condition did not come true in time"
        meanwhile()


def active_goals(server):
    return sum(goal.is_active for goal in list(server.action_server._ActionServer__goals.values()))


def test_lookup(connected, buffer, stamped):
    buffer.set_transform(stamped("map", "robot", 10.0, (1.0, 2.0, 3.0), (0.0, 0.0, 1.0, 0.0)), "me")
    expected = buffer.lookup_transform("map", "robot", Time())
    assert connected.lookup_transform("map", "robot", Time()) == expected
    assert connected.lookup_transform("map", "robot", Time(seconds=10)) == expected
    assert connected.can_transform("map", "robot", Time()) is True
    assert connected.can_transform("robot", "nowhere", Time()) is False


def test_lookup_between_two_times(connected, buffer, stamped):
    for second in (1.0, 2.0):
        buffer.set_transform(stamped("map", "robot", second, (second, 0.0, 0.0)), "me")
    query = ("robot", Time(seconds=2), "robot", Time(seconds=1), "map")
    found = connected.lookup_transform_full(*query)
    assert found == buffer.lookup_transform_full(*query)
    assert found.transform.translation.x == -1.0
    assert connected.can_transform_full(*query) is True
    assert connected.can_transform_full(*query[:4], "nowhere") is False


def test_errors_equal_those_of_a_buffer(connected, buffer, stamped):
    for parent, child in (("map", "robot"), ("other map", "other robot")):
        buffer.set_transform(stamped(parent, child, 10.0), "me")
    for query in (
        ("map", "nowhere", Time()),
        ("map", "other robot", Time()),
        ("map", "robot", Time(seconds=9)),
        ("map", "", Time()),
        ("/map", "robot", Time()),
    ):
        with pytest.raises(tf2_ros.TransformException) as expected:
            buffer.lookup_transform(*query)
        for timeout in (Duration(), Duration(seconds=0.01)):
            with pytest.raises(expected.type) as raised:
                connected.lookup_transform(*query, timeout)
            assert raised.type is expected.type
            assert str(raised.value) == str(expected.value)


@pytest.mark.parametrize(
    ("error", "exception"),
    [
        (TF2Error.LOOKUP_ERROR, tf2_ros.LookupException),
        (TF2Error.CONNECTIVITY_ERROR, tf2_ros.ConnectivityException),
        (TF2Error.EXTRAPOLATION_ERROR, tf2_ros.ExtrapolationException),
        (TF2Error.INVALID_ARGUMENT_ERROR, tf2_ros.InvalidArgumentException),
        (TF2Error.TIMEOUT_ERROR, tf2_ros.TimeoutException),
        (TF2Error.TRANSFORM_ERROR, tf2_ros.TransformException),
        (99, tf2_ros.TransformException),
    ],
)
def test_error_codes(make_node, spin, client, error, exception):
    def execute(goal_handle):
        goal_handle.succeed()
        return LookupTransform.Result(error=TF2Error(error=error, error_string="what went wrong"))

    node = make_node("server")
    ActionServer(node, LookupTransform, "tf2_buffer_server", execute)
    spin(node)
    assert client.action_client.wait_for_server(timeout_sec=10)
    with pytest.raises(exception, match="what went wrong") as raised:
        client.lookup_transform("map", "robot", Time())
    assert raised.type is exception


def test_no_server(client):
    for ask in (
        lambda: client.lookup_transform("map", "robot", Time()),
        lambda: client.lookup_transform_full("map", Time(), "robot", Time(), "map"),
    ):
        with pytest.raises(tf2_ros.TimeoutException, match=r"^The BufferServer is not ready\.$"):
            ask()
    assert client.can_transform("map", "robot", Time()) is False


def test_server_that_does_not_respond(make_node, client):
    client.timeout_padding = Duration(seconds=0.05)
    BufferServer(Buffer(), make_node("server"), "tf2_buffer_server")  # The node is not spinning.
    assert client.action_client.wait_for_server(timeout_sec=10)
    asked = time.monotonic()
    with pytest.raises(tf2_ros.TimeoutException, match="did not come back in the specified time"):
        client.lookup_transform("map", "robot", Time())
    assert 0.05 <= time.monotonic() - asked < 5.0


def test_server_destroyed_during_a_lookup(server, connected):
    connected.timeout_padding = Duration(seconds=0.05)
    raised = []

    def ask():
        try:
            connected.lookup_transform("map", "robot", Time(), Duration(seconds=0.3))
        except tf2_ros.TransformException as error:
            raised.append(error)

    thread = threading.Thread(target=ask)
    thread.start()
    wait_until(lambda: active_goals(server))
    server.destroy()
    thread.join(10)
    assert isinstance(raised[0], tf2_ros.TimeoutException)
    assert "did not come back in the specified time" in str(raised[0])


def test_server_that_rejects_goals(make_node, spin, client):
    node = make_node("server")
    ActionServer(
        node, LookupTransform, "tf2_buffer_server", lambda _: None, goal_callback=lambda _: GoalResponse.REJECT
    )
    spin(node)
    assert client.action_client.wait_for_server(timeout_sec=10)
    with pytest.raises(tf2_ros.TimeoutException, match="did not come back with accepted status"):
        client.lookup_transform("map", "robot", Time())


def test_aborted_goal_without_an_error_raises(make_node, spin, client):
    """The C++ server aborts goals after their timeout without an error in the result."""

    def execute(goal_handle):
        goal_handle.abort()
        return LookupTransform.Result()

    node = make_node("server")
    ActionServer(node, LookupTransform, "tf2_buffer_server", execute)
    spin(node)
    assert client.action_client.wait_for_server(timeout_sec=10)
    with pytest.raises(tf2_ros.TimeoutException, match="not available within the timeout"):
        client.lookup_transform("map", "robot", Time())


@pytest.mark.parametrize("executor", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_lookup_inside_a_callback(connected, server, buffer, stamped, context, executor):
    """The transform is received while the callback waits. Another executor spins the server."""
    found = []
    group = MutuallyExclusiveCallbackGroup()
    guard = connected.node.create_guard_condition(
        lambda: found.append(connected.lookup_transform("map", "robot", Time(), LONG)), group
    )
    guard.trigger()
    inserting = threading.Thread(
        target=lambda: (wait_until(lambda: active_goals(server)), buffer.set_transform(stamped("map", "robot"), "me"))
    )
    inserting.start()
    spinner = executor(context=context)
    spinner.add_node(connected.node)
    wait_until(lambda: found, lambda: spinner.spin_once(timeout_sec=0.1))
    inserting.join(10)
    assert found[0].child_frame_id == "robot"
    spinner.shutdown(timeout_sec=10)


def test_server_and_client_in_one_node(make_node, spin, buffer, stamped):
    """With a single executor, lookups work with several threads or in coroutines."""
    node = make_node("both")
    BufferServer(buffer, node, "tf2_buffer_server")
    client = BufferClient(node, "tf2_buffer_server")
    assert client.action_client.wait_for_server(timeout_sec=10)
    found = []

    async def ask():
        found.append(await client.lookup_transform_async("map", "robot", Time(), LONG))
        query = ("map", Time(), "robot", Time(), "map")
        found.append(await client.lookup_transform_full_async(*query, LONG))

    node.create_guard_condition(ask).trigger()
    spin(node)
    buffer.set_transform(stamped("map", "robot"), "me")
    wait_until(lambda: len(found) == 2)
    assert found[0].child_frame_id == found[1].child_frame_id == "robot"


@pytest.fixture
def error_of():
    """Return the exception of an asynchronous lookup, while the node of the client is spinning."""

    def ask(client, timeout):
        raised = []

        async def look_up():
            try:
                await client.lookup_transform_async("map", "nowhere", Time(), timeout)
            except tf2_ros.TransformException as error:
                raised.append(error)

        client.node.executor.create_task(look_up)
        wait_until(lambda: raised)
        return raised[0]

    return ask


@pytest.mark.parametrize("seconds", [0.0, 0.02])
def test_async_errors(connected, spin, error_of, seconds):
    spin(connected.node)
    assert isinstance(error_of(connected, Duration(seconds=seconds)), tf2_ros.LookupException)


def test_async_lookup_without_a_response(make_node, spin, client, error_of):
    client.timeout_padding = Duration(seconds=0.05)
    BufferServer(Buffer(), make_node("server"), "tf2_buffer_server")  # The node is not spinning.
    assert client.action_client.wait_for_server(timeout_sec=10)
    spin(client.node)
    assert "did not come back in the specified time" in str(error_of(client, Duration()))
    wait_until(lambda: not list(client.node.timers))


def test_lookup_in_asyncio(connected, spin, buffer, stamped):
    spin(connected.node)
    buffer.set_transform(stamped("map", "robot"), "me")
    found = asyncio.run(connected.lookup_transform_async("map", "robot", Time()))
    assert found.child_frame_id == "robot"


def test_transforming_data(connected, buffer, stamped):
    import tf2_geometry_msgs  # noqa: F401 - registers the types

    buffer.set_transform_static(stamped("map", "robot", 0.0, (1.0, 0.0, 0.0)), "me")
    point = PointStamped()
    point.header.frame_id = "robot"
    with pytest.warns(UserWarning, match="Passing a builtin_interfaces.msg.Time argument is deprecated"):
        assert connected.transform(point, "map").point.x == 1.0


def test_invalid_arguments(client):
    with pytest.raises(TypeError, match=r"^Must pass a rclpy.time.Time object\.$"):
        client.lookup_transform("map", "robot", 0.0)
    with pytest.raises(TypeError, match="must be an rclpy Duration, not float"):
        client.lookup_transform("map", "robot", Time(), 1.0)
    with pytest.raises(TypeError, match="argument 1 must be str, not NoneType"):
        client.lookup_transform(None, "robot", Time())
    with (
        pytest.warns(UserWarning, match="Use rclpy.time.Time instead") as warned,
        pytest.raises(tf2_ros.TimeoutException, match="not ready"),
    ):
        client.lookup_transform("map", "robot", TimeMessage())
    assert warned[0].filename == __file__
    client.destroy()
    client.destroy()


def test_cancel(server, make_node):
    client = ActionClient(make_node("client"), LookupTransform, "tf2_buffer_server")
    assert client.wait_for_server(timeout_sec=10)
    goal = LookupTransform.Goal(target_frame="map", source_frame="robot", timeout=LONG.to_msg())
    goal_handle = client._Coframe__wait_for(client.send_goal_async(goal))
    wait_until(lambda: active_goals(server))
    assert goal_handle.cancel_goal().return_code == CancelGoal.Response.ERROR_NONE
    assert goal_handle.get_result().status == GoalStatus.STATUS_CANCELED


@pytest.mark.usefixtures("server")
def test_status_of_goals(make_node):
    """A goal that fails immediately finishes as succeeded, and one that times out as aborted, as in C++."""
    client = ActionClient(make_node("client"), LookupTransform, "tf2_buffer_server")
    assert client.wait_for_server(timeout_sec=10)
    statuses = {}
    for seconds in (0.0, 0.02):
        goal = LookupTransform.Goal(
            target_frame="map", source_frame="robot", timeout=Duration(seconds=seconds).to_msg()
        )
        response = client.send_goal(goal)
        assert response.result.error.error == TF2Error.LOOKUP_ERROR
        statuses[seconds] = response.status
    assert statuses == {0.0: GoalStatus.STATUS_SUCCEEDED, 0.02: GoalStatus.STATUS_ABORTED}


def test_many_goals_do_not_need_many_threads(server, make_node, buffer, stamped):
    client = ActionClient(
        make_node("client"),
        LookupTransform,
        "tf2_buffer_server",
        goal_service_qos_profile=tf2_ros._lookup_action.QOS,
        result_service_qos_profile=tf2_ros._lookup_action.QOS,
    )
    assert client.wait_for_server(timeout_sec=10)
    goal = LookupTransform.Goal(target_frame="map", source_frame="robot", timeout=Duration(seconds=100).to_msg())
    before = threading.active_count()
    accepted = [client.send_goal_async(goal) for _ in range(1000)]
    for future in accepted:
        client._Coframe__wait_for(future, 20)
    wait_until(lambda: active_goals(server) == 1000)
    assert threading.active_count() <= before + 2
    results = [future.result().get_result_async() for future in accepted]
    buffer.set_transform(stamped("map", "robot"), "me")
    for future in results:
        client._Coframe__wait_for(future, 20)
    assert {future.result().result.transform.child_frame_id for future in results} == {"robot"}


def test_buffer_server_node(client, make_node, stamped):
    """`python -m tf2_ros.buffer_server` receives transforms and responds, here with a remapped name."""
    command = [sys.executable, "-W", "error", "-m", "tf2_ros.buffer_server", "--ros-args", "-p", "buffer_size:=60.0"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        try:
            assert client.action_client.wait_for_server(timeout_sec=20)
            wait_until(lambda: "tf_buffer" in client.node.get_node_names())
            broadcaster = tf2_ros.StaticTransformBroadcaster(make_node("talker"))
            broadcaster.sendTransform(stamped("map", "robot", 5.0, (1.0, 2.0, 3.0)))
            found = client.lookup_transform("map", "robot", Time(), LONG)
            assert (found.header.frame_id, found.child_frame_id) == ("map", "robot")
            assert found.transform.translation.z == 3.0
        finally:
            process.terminate()
        assert process.communicate(timeout=10)[1] == ""
        assert process.returncode in {0, -15}
