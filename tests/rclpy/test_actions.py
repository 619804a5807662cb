# SPDX-License-Identifier: Apache-2.0
"""Actions: goals, feedback, cancel requests and results."""

import importlib.util
import subprocess
import sys
import threading
from pathlib import Path

import pytest

import rclpy
from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from builtin_interfaces.msg import Time
from coframe.messages import codec
from rclpy.action import (
    ActionClient,
    ActionServer,
    CancelResponse,
    GoalResponse,
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)
from rclpy.action import server as action_server
from rclpy.action._status import encode_entry, encode_statuses
from rclpy.exceptions import RCLError
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import serialize_message
from rclpy.task import Future
from std_srvs.srv import SetBool, Trigger
from tf2_msgs.action import LookupTransform
from unique_identifier_msgs.msg import UUID

FIBONACCI = "int32 order\n---\nint32[] sequence\n---\nint32[] partial_sequence\n"


@pytest.fixture(scope="session")
def fibonacci(tmp_path_factory):
    """Return the action type of the ROS tutorials."""
    script = Path(__file__).resolve().parents[2] / "scripts/generate_messages.py"
    spec = importlib.util.spec_from_file_location("generate_messages", script)
    generator = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generator)
    definition = tmp_path_factory.mktemp("interfaces") / "Fibonacci.action"
    definition.write_text(FIBONACCI, encoding="utf-8")
    module = generator.Module("test_interfaces", "action")
    module.add(definition)
    names = {}
    exec(compile(module.text(), definition, "exec"), names)
    return names["Fibonacci"]


@pytest.fixture
def count(fibonacci):
    """Return the execute callback of the ROS tutorials."""

    def execute(goal_handle):
        sequence = [0, 1]
        for _ in range(goal_handle.request.order):
            sequence.append(sequence[-1] + sequence[-2])
            goal_handle.publish_feedback(fibonacci.Feedback(partial_sequence=sequence))
        goal_handle.succeed()
        return fibonacci.Result(sequence=sequence)

    return execute


@pytest.fixture
def serve(make_node, fibonacci):
    """Return a function that starts an action server and spins it in a thread until the test ends."""
    running = []

    def start(execute, *, executor=SingleThreadedExecutor, action=fibonacci, name="fibonacci", node=None, **options):
        node = node or make_node("server")
        server = ActionServer(node, action, name, execute, **options)
        spinner = executor(context=node.context)
        spinner.add_node(node)
        thread = threading.Thread(target=spinner.spin)
        thread.start()
        running.append((spinner, thread))
        return server

    yield start
    for spinner, thread in running:
        spinner.shutdown(timeout_sec=10)
        thread.join(10)


@pytest.fixture
def connect(make_node, fibonacci):
    """Return a function that creates action clients and waits for their server."""

    def make(name="client", action_name="fibonacci", action=fibonacci, **options):
        client = ActionClient(make_node(name), action, action_name, **options)
        assert client.wait_for_server(timeout_sec=10)
        return client

    return make


@pytest.fixture
def result_of(context):
    """Return a function that spins a client until a future is done and returns the result."""
    spinner = SingleThreadedExecutor(context=context)

    def spin(client, future):
        spinner.add_node(client._node)
        spinner.spin_until_future_complete(future, timeout_sec=10)
        assert future.done()
        return future.result()

    yield spin
    spinner.shutdown()


class Gate:
    """Gate that blocks execute callbacks, which run in their own threads, until the test opens it."""

    def __init__(self, end):
        self.end = end
        self.reached = threading.Semaphore(0)
        self.opened = threading.Event()

    def __call__(self, goal_handle):
        self.reached.release()
        assert self.opened.wait(10)
        return self.end(goal_handle)


@pytest.mark.parametrize("executor", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_feedback_and_result(serve, connect, count, executor, result_of, wait_until, fibonacci):
    serve(count, executor=executor)
    client = connect()
    received = []
    goal_handle = result_of(client, client.send_goal_async(fibonacci.Goal(order=3), feedback_callback=received.append))
    assert goal_handle.accepted
    assert goal_handle.stamp.sec > 0
    response = result_of(client, goal_handle.get_result_async())
    assert response.status == goal_handle.status == GoalStatus.STATUS_SUCCEEDED
    assert list(response.result.sequence) == [0, 1, 1, 2, 3]
    # Feedback that is queued when the result arrives is not lost.
    wait_until(lambda: len(received) == 3, lambda: rclpy.spin_once(client._node, executor=spinner_of(client)))
    assert [list(message.feedback.partial_sequence) for message in received] == [
        [0, 1, 1],
        [0, 1, 1, 2],
        [0, 1, 1, 2, 3],
    ]
    assert all(message.goal_id == goal_handle.goal_id for message in received)


def spinner_of(client):
    return client._node.executor


def test_server_and_client_in_one_node_with_the_global_executor(domain_id, count, fibonacci):
    rclpy.init(args=[], domain_id=domain_id)
    try:
        node = rclpy.create_node("both")
        ActionServer(node, fibonacci, "fibonacci", count)
        client = rclpy.action.ActionClient(node, fibonacci, "fibonacci")
        assert client.wait_for_server(timeout_sec=10)
        goal_handle = Future()
        client.send_goal_async(fibonacci.Goal(order=1)).add_done_callback(
            lambda future: goal_handle.set_result(future.result())
        )
        rclpy.spin_until_future_complete(node, goal_handle, timeout_sec=10)
        result = goal_handle.result().get_result_async()
        rclpy.spin_until_future_complete(node, result, timeout_sec=10)
        assert list(result.result().result.sequence) == [0, 1, 1]
        node.destroy_node()
    finally:
        rclpy.shutdown()


@pytest.mark.parametrize("answer", [GoalResponse.REJECT, True], ids=["rejected", "no GoalResponse"])
def test_rejected_goal(serve, connect, count, result_of, answer, fibonacci):
    serve(count, goal_callback=lambda goal: answer if goal.order < 0 else GoalResponse.ACCEPT)
    client = connect()
    goal_handle = result_of(client, client.send_goal_async(fibonacci.Goal(order=-1), feedback_callback=print))
    assert not goal_handle.accepted
    assert goal_handle.stamp == Time()
    assert result_of(client, goal_handle.get_result_async()).status == GoalStatus.STATUS_UNKNOWN
    assert result_of(client, client.send_goal_async(fibonacci.Goal(order=1))).accepted


def test_cancel(serve, connect, result_of, wait_until, fibonacci):
    asked = []

    def execute(goal_handle):
        wait_until(lambda: goal_handle.is_cancel_requested)
        goal_handle.canceled()
        return fibonacci.Result(sequence=[7])

    def cancel(goal_handle):
        asked.append(goal_handle.request.order)
        return CancelResponse.ACCEPT

    serve(execute, executor=MultiThreadedExecutor, cancel_callback=cancel)
    client = connect()
    goal_handle = result_of(client, client.send_goal_async(fibonacci.Goal(order=9)))
    canceling = result_of(client, goal_handle.cancel_goal_async())
    assert canceling.return_code == CancelGoal.Response.ERROR_NONE
    assert [info.goal_id for info in canceling.goals_canceling] == [goal_handle.goal_id]
    assert asked == [9]
    response = result_of(client, goal_handle.get_result_async())
    assert response.status == goal_handle.status == GoalStatus.STATUS_CANCELED
    assert list(response.result.sequence) == [7]


def test_rejected_cancel_request(serve, connect, count, result_of, fibonacci):
    gate = Gate(count)
    serve(gate, executor=MultiThreadedExecutor)
    client = connect()
    goal_handle = result_of(client, client.send_goal_async(fibonacci.Goal(order=1)))
    refused = result_of(client, goal_handle.cancel_goal_async())
    assert (refused.return_code, refused.goals_canceling) == (CancelGoal.Response.ERROR_REJECTED, [])
    gate.opened.set()
    assert result_of(client, goal_handle.get_result_async()).status == GoalStatus.STATUS_SUCCEEDED
    too_late = result_of(client, goal_handle.cancel_goal_async())
    assert too_late.return_code == CancelGoal.Response.ERROR_GOAL_TERMINATED
    goal_handle._goal_id = UUID(uuid=[1] * 16)
    unknown = result_of(client, goal_handle.cancel_goal_async())
    assert unknown.return_code == CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID


def test_cancel_several(serve, connect, result_of, fibonacci):
    """A request without identifier selects all goals, a stamp earlier goals, and both together the union."""

    def end(goal_handle):
        (goal_handle.canceled if goal_handle.is_cancel_requested else goal_handle.succeed)()
        return fibonacci.Result()

    gate = Gate(end)
    serve(gate, executor=lambda context: MultiThreadedExecutor(6, context=context), cancel_callback=lambda _: ACCEPT)
    client = connect()
    handles = [result_of(client, client.send_goal_async(fibonacci.Goal(order=order))) for order in range(4)]

    def cancel(goal_info):
        request = CancelGoal.Request(goal_info=goal_info)
        response = result_of(client, client._ActionClient__cancel_client.call_async(request))
        assert response.return_code == CancelGoal.Response.ERROR_NONE
        return {bytes(info.goal_id.uuid) for info in response.goals_canceling}

    ids = [bytes(goal_handle.goal_id.uuid) for goal_handle in handles]
    assert cancel(GoalInfo(stamp=handles[0].stamp)) == {ids[0]}
    assert cancel(GoalInfo(stamp=handles[1].stamp, goal_id=handles[2].goal_id)) == {ids[1], ids[2]}
    assert cancel(GoalInfo()) == {ids[3]}
    gate.opened.set()
    for goal_handle in handles:
        assert result_of(client, goal_handle.get_result_async()).status == GoalStatus.STATUS_CANCELED


ACCEPT = CancelResponse.ACCEPT


@pytest.mark.parametrize("mistake", ["raises", "sets no state", "returns nothing", "aborts"])
def test_abort(serve, connect, result_of, mistake, capfd, fibonacci):
    def execute(goal_handle):
        if mistake == "raises":
            raise RuntimeError("no more numbers")
        if mistake == "returns nothing":
            goal_handle.abort()
            return None
        if mistake == "aborts":
            goal_handle.abort()
        return fibonacci.Result(sequence=[7])

    serve(execute)
    client = connect()
    goal_handle = result_of(client, client.send_goal_async(fibonacci.Goal()))
    response = result_of(client, goal_handle.get_result_async())
    assert response.status == GoalStatus.STATUS_ABORTED
    assert list(response.result.sequence) == ([] if mistake in {"raises", "returns nothing"} else [7])
    log = {
        "raises": "Error raised in execute callback: no more numbers",
        "sets no state": "Goal state not set, assuming aborted. Goal ID:",
        "returns nothing": "The execute callback returned NoneType instead of Fibonacci_Result",
        "aborts": "",
    }
    assert log[mistake] in capfd.readouterr().err


def test_goal_cannot_be_finished_twice(serve, connect, fibonacci):
    errors = []

    def execute(goal_handle):
        for end in (goal_handle.canceled, goal_handle.succeed, goal_handle.abort, goal_handle.execute):
            try:
                end()
            except RCLError as error:
                errors.append(str(error))
        assert not goal_handle.is_active
        return fibonacci.Result()

    serve(execute)
    client = connect()
    response = client.send_goal(fibonacci.Goal())
    assert response.status == GoalStatus.STATUS_SUCCEEDED
    transition = "Failed to update goal state: goal_handle attempted invalid transition from state"
    assert errors == [
        f"{transition} EXECUTING with event CANCELED",
        f"{transition} SUCCEEDED with event ABORT",
        f"{transition} SUCCEEDED with event EXECUTE",
    ]


def test_result_requested_after_the_goal_finished(serve, connect, count, result_of, fibonacci):
    serve(count)
    client = connect()
    goal_handle = result_of(client, client.send_goal_async(fibonacci.Goal(order=1)))
    responses = [result_of(client, goal_handle.get_result_async()) for _ in range(2)]
    assert [list(response.result.sequence) for response in responses] == [[0, 1, 1]] * 2


def test_results_expire(serve, connect, count, result_of, wait_until, fibonacci):
    serve(count, result_timeout=0)
    client = connect()
    goal_handle = result_of(client, client.send_goal_async(fibonacci.Goal(order=1)))
    status_of_result = lambda: result_of(client, goal_handle.get_result_async()).status  # noqa: E731
    wait_until(lambda: status_of_result() == GoalStatus.STATUS_UNKNOWN)


@pytest.mark.parametrize("result_timeout", [900, -1])
def test_the_server_forgets_the_first_finished_goals_at_the_limit(
    serve, connect, count, result_of, fibonacci, monkeypatch, result_timeout
):
    monkeypatch.setattr(action_server, "MAX_GOALS", 3)
    serve(count, result_timeout=result_timeout)
    client = connect()
    handles = []
    for _ in range(5):
        handles.append(result_of(client, client.send_goal_async(fibonacci.Goal(order=1))))
        assert result_of(client, handles[-1].get_result_async()).status == GoalStatus.STATUS_SUCCEEDED
    statuses = [result_of(client, handle.get_result_async()).status for handle in handles]
    assert statuses == [GoalStatus.STATUS_UNKNOWN] * 2 + [GoalStatus.STATUS_SUCCEEDED] * 3


def test_the_goals_of_a_server_have_a_limit_of_bytes(serve, connect, count, result_of, fibonacci, monkeypatch):
    waiting = []
    serve(count, handle_accepted_callback=waiting.append)
    client = connect()
    goal = fibonacci.Goal(order=1)
    size = len(serialize_message(goal))
    monkeypatch.setattr(action_server, "MAX_GOAL_BYTES", size - 1)
    first = result_of(client, client.send_goal_async(goal))
    assert first.accepted, "a single goal may be larger"
    monkeypatch.setattr(action_server, "MAX_GOAL_BYTES", 2 * size)
    assert [result_of(client, client.send_goal_async(goal)).accepted for _ in range(2)] == [True, False]
    waiting[0].execute()
    assert result_of(client, first.get_result_async()).status == GoalStatus.STATUS_SUCCEEDED
    assert result_of(client, client.send_goal_async(goal)).accepted
    assert result_of(client, first.get_result_async()).status == GoalStatus.STATUS_UNKNOWN, "it is forgotten"


def test_the_server_rejects_goals_and_requests_beyond_the_limit(
    serve, connect, count, result_of, wait_until, fibonacci, monkeypatch, printed
):
    monkeypatch.setattr(action_server, "MAX_GOALS", 2)
    monkeypatch.setattr(action_server, "MAX_RESULT_REQUESTS", 3)
    waiting = []
    serve(count, handle_accepted_callback=waiting.append)
    client = connect()
    handles = [result_of(client, client.send_goal_async(fibonacci.Goal(order=1))) for _ in range(4)]
    assert [handle.accepted for handle in handles] == [True, True, False, False]
    results = [handles[0].get_result_async() for _ in range(5)]
    wait_until(lambda: "Ignoring requests: 3 wait for the result" in printed())
    assert len(waiting[0]._Coframe__result_requests) == 3
    waiting[0].execute()
    for result in results[:3]:
        assert result_of(client, result).status == GoalStatus.STATUS_SUCCEEDED
    assert result_of(client, client.send_goal_async(fibonacci.Goal(order=1))).accepted, "a goal has finished"
    assert not all(result.done() for result in results)
    assert printed().count("Rejecting goals: the unfinished goals would exceed the maximum of 2 or 64 MiB") == 1
    assert printed().count("Ignoring requests: 3 wait for the result of one goal.") == 1


def test_a_damaged_status_message_is_ignored(serve, connect, count, result_of, fibonacci, capfd):
    serve(count, handle_accepted_callback=lambda _: None)
    client = connect()
    handle = result_of(client, client.send_goal_async(fibonacci.Goal(order=1)))
    good = codec.serialize(
        GoalStatusArray(status_list=[GoalStatus(goal_info=GoalInfo(goal_id=handle.goal_id), status=2)])
    )
    for cdr in (good, good[:-3], b"\0\1\0\0\xff\xff\xff\xff"):
        client._ActionClient__on_status(cdr)
        assert handle.status == GoalStatus.STATUS_EXECUTING
    assert capfd.readouterr().err.count("Ignoring damaged messages with the status of goals") == 1


def test_two_clients(serve, connect, count, result_of, wait_until, fibonacci):
    serve(count)
    clients = [connect("first"), connect("second")]
    received = [[], []]
    futures = [
        client.send_goal_async(fibonacci.Goal(order=order), feedback_callback=received[order - 1].append)
        for order, client in enumerate(clients, 1)
    ]
    goal_handles = list(map(result_of, clients, futures))
    responses = [
        result_of(client, goal_handle.get_result_async())
        for client, goal_handle in zip(clients, goal_handles, strict=True)
    ]
    assert [list(response.result.sequence) for response in responses] == [[0, 1, 1], [0, 1, 1, 2]]
    executor = spinner_of(clients[0])
    wait_until(lambda: [len(messages) for messages in received] == [1, 2], lambda: executor.spin_once(timeout_sec=0.1))
    assert goal_handles[0] != goal_handles[1]


def test_goal_with_a_given_identifier(serve, connect, count, result_of, fibonacci):
    serve(count)
    client = connect()
    goal_id = UUID(uuid=list(range(16)))
    first, second = (result_of(client, client.send_goal_async(fibonacci.Goal(), goal_uuid=goal_id)) for _ in range(2))
    assert first.goal_id == goal_id
    assert (first.accepted, second.accepted) == (True, False)
    assert first == second


def test_deferred_goals(serve, connect, count, result_of, wait_until, fibonacci):
    accepted = []
    serve(count, handle_accepted_callback=accepted.append)
    client = connect()
    first, second = (result_of(client, client.send_goal_async(fibonacci.Goal(order=order))) for order in (1, 2))
    executor = spinner_of(client)
    # The client may receive the response before the server's callback has run.
    wait_until(
        lambda: len(accepted) == 2 and first.status == GoalStatus.STATUS_ACCEPTED,
        lambda: executor.spin_once(timeout_sec=0.1),
    )
    accepted[1].execute()
    assert list(result_of(client, second.get_result_async()).result.sequence) == [0, 1, 1, 2]
    assert accepted[0].status == GoalStatus.STATUS_ACCEPTED
    assert not first.get_result_async().done()

    def other(goal_handle):
        goal_handle.abort(fibonacci.Result(sequence=[3]))

    accepted[0].execute(other)
    response = result_of(client, first.get_result_async())
    assert (response.status, list(response.result.sequence)) == (GoalStatus.STATUS_ABORTED, [3])


def test_coroutines_execute_many_goals_in_one_thread(serve, connect, result_of, fibonacci):
    opened = Future()

    async def execute(goal_handle):
        await opened
        goal_handle.succeed()
        return fibonacci.Result(sequence=[goal_handle.request.order])

    async def decide(goal):
        return GoalResponse.ACCEPT if goal.order else GoalResponse.REJECT

    async def begin(goal_handle):
        goal_handle.execute()

    serve(execute, goal_callback=decide, handle_accepted_callback=begin)
    client = connect()
    handles = [result_of(client, client.send_goal_async(fibonacci.Goal(order=order))) for order in range(4)]
    assert [goal_handle.accepted for goal_handle in handles] == [False, True, True, True]
    results = [goal_handle.get_result_async() for goal_handle in handles[1:]]
    opened.set_result(None)
    assert [list(result_of(client, result).result.sequence) for result in results] == [[1], [2], [3]]


def test_waiting_inside_a_callback_of_a_single_threaded_executor(serve, connect, count, wait_until, fibonacci):
    serve(count)
    client = connect()
    responses = []

    def call(_, response):
        responses.append(client.send_goal(fibonacci.Goal(order=1)))
        return response

    client._node.create_service(Trigger, "call", call)
    caller = client._node.create_client(Trigger, "call")
    assert caller.wait_for_service(timeout_sec=10)
    caller.call_async(Trigger.Request())
    executor = SingleThreadedExecutor(context=client._node.context)
    executor.add_node(client._node)
    wait_until(lambda: responses, lambda: executor.spin_once(timeout_sec=10))
    assert list(responses[0].result.sequence) == [0, 1, 1]
    executor.shutdown()


def test_awaiting_inside_a_callback(serve, connect, count, wait_until, fibonacci):
    serve(count)
    client = connect()
    sequences = []

    async def call():
        goal_handle = await client.send_goal_async(fibonacci.Goal(order=1))
        response = await goal_handle.get_result_async()
        canceling = await goal_handle.cancel_goal_async()
        sequences.append((list(response.result.sequence), canceling.return_code))

    client._node.create_guard_condition(call).trigger()
    executor = SingleThreadedExecutor(context=client._node.context)
    executor.add_node(client._node)
    wait_until(lambda: sequences, lambda: executor.spin_once(timeout_sec=10))
    assert sequences == [([0, 1, 1], CancelGoal.Response.ERROR_GOAL_TERMINATED)]
    executor.shutdown()


def test_blocking_calls(serve, connect, count, fibonacci):
    gate = Gate(count)
    serve(gate, executor=MultiThreadedExecutor)
    client = connect()
    goal_handle = client._Coframe__wait_for(client.send_goal_async(fibonacci.Goal(order=1)))
    assert goal_handle.cancel_goal().return_code == CancelGoal.Response.ERROR_REJECTED
    gate.opened.set()
    assert list(goal_handle.get_result().result.sequence) == [0, 1, 1]


def test_names_follow_namespaces_and_remaps(make_node, serve, count, result_of, wait_until, fibonacci):
    server_node = make_node("server", namespace="/robot", cli_args=["--ros-args", "-r", "fibonacci:=numbers"])
    serve(count, node=server_node)
    rule = "/elsewhere/_action/send_goal:=/robot/numbers/_action/send_goal"
    client_node = make_node("client", cli_args=["--ros-args", "-r", "fibonacci:=/robot/numbers", "-r", rule])
    client = ActionClient(client_node, fibonacci, "fibonacci")
    assert client.wait_for_server(timeout_sec=10)
    assert result_of(client, client.send_goal_async(fibonacci.Goal(order=1))).accepted
    assert ActionClient(client_node, fibonacci, "/elsewhere")._ActionClient__goal_client.service_is_ready()

    expected = [("/robot/numbers", ["test_interfaces/action/Fibonacci"])]
    wait_until(lambda: get_action_server_names_and_types_by_node(client_node, "server", "/robot") == expected)
    assert dict(get_action_names_and_types(client_node))["/robot/numbers"] == expected[0][1]
    assert dict(client_node.get_action_names_and_types())["/robot/numbers"] == expected[0][1]
    assert expected[0] in get_action_client_names_and_types_by_node(server_node, "client", "/")
    assert get_action_server_names_and_types_by_node(server_node, "client", "/") == []
    services = dict(client_node.get_service_names_and_types())
    assert services["/robot/numbers/_action/send_goal"] == ["test_interfaces/action/Fibonacci_SendGoal"]
    assert services["/robot/numbers/_action/get_result"] == ["test_interfaces/action/Fibonacci_GetResult"]
    assert services["/robot/numbers/_action/cancel_goal"] == ["action_msgs/srv/CancelGoal"]
    topics = dict(client_node.get_topic_names_and_types())
    assert topics["/robot/numbers/_action/feedback"] == ["test_interfaces/action/Fibonacci_FeedbackMessage"]
    assert topics["/robot/numbers/_action/status"] == ["action_msgs/msg/GoalStatusArray"]
    status = server_node.get_publishers_info_by_topic("/robot/numbers/_action/status")[0].qos_profile
    assert (status.depth, status.durability) == (1, DurabilityPolicy.TRANSIENT_LOCAL)


def test_server_appears_and_disappears(make_node, count, wait_until, fibonacci):
    client = ActionClient(make_node("client"), fibonacci, "fibonacci")
    assert not client.wait_for_server(timeout_sec=0.05)
    server = ActionServer(make_node("server"), fibonacci, "fibonacci", count)
    assert client.wait_for_server(timeout_sec=10)
    server.destroy()
    server.destroy()
    wait_until(lambda: not client.server_is_ready())
    client.destroy()
    client.destroy()
    with pytest.raises(Exception, match="destruction was requested"):
        client.send_goal_async(fibonacci.Goal())


def test_destroyed_server_removes_its_goals(serve, connect, result_of, fibonacci):
    ended = []

    def end(goal_handle):
        goal_handle.publish_feedback(fibonacci.Feedback())
        goal_handle.succeed()
        ended.append(goal_handle)
        return fibonacci.Result()

    gate = Gate(end)
    server = serve(gate)
    client = connect()
    result_of(client, client.send_goal_async(fibonacci.Goal()))
    assert gate.reached.acquire(timeout=10)
    server.destroy()
    gate.opened.set()
    server._node.executor.shutdown(timeout_sec=10)
    assert ended[0].status == GoalStatus.STATUS_UNKNOWN
    assert not ended[0].is_active


def test_invalid_arguments(make_node, count, fibonacci):
    node = make_node()
    with pytest.raises(RuntimeError, match="The action type provided is not valid"):
        ActionClient(node, SetBool, "fibonacci")
    with pytest.raises(RuntimeError, match="The action type provided is not valid"):
        ActionServer(node, fibonacci.Goal, "fibonacci", count)
    with pytest.raises(ValueError, match="Failed to create action client due to invalid topic name 'no name'"):
        ActionClient(node, fibonacci, "no name")
    with pytest.raises(ValueError, match="Failed to create action server due to invalid topic name ''"):
        ActionServer(node, fibonacci, "", count)
    with pytest.raises(TypeError, match="Failed to register goal execution callback: not callable"):
        ActionServer(node, fibonacci, "fibonacci", None)
    client = ActionClient(node, fibonacci, "fibonacci")
    with pytest.raises(TypeError, match="Expected"):
        client.send_goal_async(fibonacci.Result())
    with pytest.raises(TypeError, match="Expected"):
        client.send_goal(fibonacci.Goal)
    with pytest.raises(TypeError, match="Expected type ClientGoalHandle but received"):
        client._get_result_async(None)


def test_wrong_feedback_and_results(serve, connect, fibonacci):
    errors = []

    def execute(goal_handle):
        for call in (goal_handle.publish_feedback, goal_handle.succeed):
            try:
                call(fibonacci.Goal())
            except TypeError as error:
                errors.append(str(error))
        assert goal_handle.is_active
        goal_handle.succeed()
        return fibonacci.Result()

    serve(execute)
    assert connect().send_goal(fibonacci.Goal()).status == GoalStatus.STATUS_SUCCEEDED
    assert ["Fibonacci_Feedback" in errors[0], "Fibonacci_Result" in errors[1]] == [True, True]


@pytest.mark.parametrize("number", [0, 1, 3])
def test_status_encoding_equals_that_of_the_codec(number):
    message = GoalStatusArray()
    for index in range(number):
        info = GoalInfo(goal_id=UUID(uuid=[index] * 16), stamp=Time(sec=-index, nanosec=2**32 - 1 - index))
        message.status_list.append(GoalStatus(goal_info=info, status=index))
    entries = [encode_entry(goal.goal_info, goal.status) for goal in message.status_list]
    assert encode_statuses(entries) == codec.serialize(message)


def test_late_joining_client_receives_the_status(serve, connect, count, make_node, context, wait_until, fibonacci):
    serve(count)
    client = connect()
    assert client.send_goal(fibonacci.Goal()).status == GoalStatus.STATUS_SUCCEEDED
    late, received = make_node("late"), []
    qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    late.create_subscription(GoalStatusArray, "fibonacci/_action/status", received.append, qos)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(late)
    wait_until(lambda: received, lambda: executor.spin_once(timeout_sec=0.1))
    assert [goal.status for goal in received[0].status_list] == [GoalStatus.STATUS_SUCCEEDED]
    executor.shutdown()


SERVER = """
import rclpy
from rclpy.action import ActionServer
from tf2_msgs.action import LookupTransform

def execute(goal_handle):
    goal_handle.publish_feedback(LookupTransform.Feedback())
    goal_handle.succeed()
    result = LookupTransform.Result()
    result.error.error_string = goal_handle.request.target_frame
    return result

rclpy.init()
node = rclpy.create_node("server")
server = ActionServer(node, LookupTransform, "look", execute)
rclpy.spin(node)
"""


def test_across_processes(run_script, make_node, result_of, wait_until):
    script = run_script(SERVER)
    client = ActionClient(make_node("client"), LookupTransform, "look")
    assert client.wait_for_server(timeout_sec=20)
    received = []
    goal = LookupTransform.Goal(target_frame="größer")
    goal_handle = result_of(client, client.send_goal_async(goal, feedback_callback=received.append))
    response = result_of(client, goal_handle.get_result_async())
    assert response.status == GoalStatus.STATUS_SUCCEEDED
    assert response.result.error.error_string == "größer"
    executor = spinner_of(client)
    wait_until(
        lambda: [message.goal_id for message in received] == [goal_handle.goal_id], lambda: executor.spin_once(0.1)
    )
    script.process.terminate()
    script.end()
    wait_until(lambda: not client.server_is_ready())
    assert not client.send_goal_async(goal).done()


CLIENT_OF_ANOTHER_LIBRARY = """
import threading, time
import rclpy, rosless
from rclpy.action import ActionClient, ActionServer
from tf2_msgs.action import LookupTransform

FEEDBACK = "/robot/look/_action/feedback"

def execute(goal_handle):
    goal_handle.publish_feedback(LookupTransform.Feedback())
    goal_handle.succeed()
    return LookupTransform.Result()

rosless.register_type("tf2_msgs/action/LookupTransform_Feedback", "uint8 structure_needs_at_least_one_member")
rosless.register_type(
    "tf2_msgs/action/LookupTransform_FeedbackMessage",
    "unique_identifier_msgs/UUID goal_id\\ntf2_msgs/action/LookupTransform_Feedback feedback",
)
with rclpy.init():
    node = rclpy.create_node("server", namespace="/robot")
    server = ActionServer(node, LookupTransform, "look", execute)
    peer = rosless.Node(node.context.get_domain_id())
    client = ActionClient(node, LookupTransform, "look")
    feedback = peer.subscribe(FEEDBACK, "tf2_msgs/action/LookupTransform_FeedbackMessage", reliability="reliable")
    thread = threading.Thread(target=rclpy.spin, args=(node,))
    thread.start()
    deadline = time.monotonic() + 15
    def both_found_each_other():
        published = {topic.name for topic in peer.graph().topics if topic.publishers}
        return server._ActionServer__feedback_publisher.get_subscription_count() == 2 and FEEDBACK in published

    while not both_found_each_other():
        assert time.monotonic() < deadline
        time.sleep(0.01)
    client.wait_for_server()
    ids = []
    for _ in range(2):
        goal_handle = client._Coframe__wait_for(client.send_goal_async(LookupTransform.Goal()))
        assert goal_handle.get_result().status == 4
        ids.append(bytes(goal_handle.goal_id.uuid))
    for goal_id in ids:
        assert bytes(feedback.read(timeout=10).goal_id.uuid) == goal_id
    status = peer.subscribe(
        "/robot/look/_action/status", "action_msgs/msg/GoalStatusArray", 15, "reliable", "transient_local"
    )
    goals = status.read(timeout=15).status_list
    assert [(bytes(goal.goal_info.goal_id.uuid), goal.status) for goal in goals] == [(id, 4) for id in ids]
    services = {service.name: service.type_name for service in peer.graph().services}
    assert services["/robot/look/_action/send_goalRequest"] == "tf2_msgs/action/LookupTransform_SendGoal_Request"
    assert services["/robot/look/_action/get_resultReply"] == "tf2_msgs/action/LookupTransform_GetResult_Response"
thread.join()
"""


@pytest.mark.dds_only("the other program is an RTPS program")
@pytest.mark.usefixtures("domain_id")
def test_interoperation_with_an_independent_library(network, tmp_path):
    pytest.importorskip("rosless", reason="an independent RTPS program")
    path = tmp_path / "beside_rosless.py"
    path.write_text(CLIENT_OF_ANOTHER_LIBRARY, encoding="utf-8")
    ended = subprocess.run(
        network.command(sys.executable, path), capture_output=True, text=True, timeout=60, check=False
    )
    assert ended.returncode == 0, ended.stderr
