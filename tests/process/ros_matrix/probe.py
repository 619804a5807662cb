# SPDX-License-Identifier: Apache-2.0
"""The side of the matrix that uses what peer.py provides, with the rclpy of coframe or of ROS 2.

Prints a line of JSON for each row: its name, "ok" or what is wrong, and the time in seconds. "no server" means that the
service did not appear.
"""

import json
import os
import threading
import time

from contents import (
    BEST_EFFORT,
    LATCHED,
    LIFECYCLE_NODE,
    LOG_LINE,
    NODE,
    STATIC,
    TYPES,
    message_class,
    message_of,
    plain,
    topic_of,
)

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from lifecycle_msgs.msg import Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.msg import Log
from rclpy.action import ActionClient
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

try:
    from rclpy.event_handler import SubscriptionEventCallbacks
except ImportError:  # Humble
    from rclpy.qos_event import SubscriptionEventCallbacks

NO_SERVER = "no server"
PATIENCE = 10.0  # seconds, for what must come
SERVER_PATIENCE = 3.0  # seconds, for services, which may be refused


class WrongError(Exception):
    """A row is wrong."""


def require(condition, text):
    """Raise WrongError unless the condition holds."""
    if not condition:
        raise WrongError(text)


def wait(condition, text, patience=PATIENCE):
    """Wait for a condition and return its result; raise WrongError with the text after the timeout."""
    deadline = time.monotonic() + patience
    while not (result := condition()):
        require(time.monotonic() < deadline, text)
        time.sleep(0.005)
    return result


def answer(future):
    """Return the result of a future."""
    wait(future.done, "no answer")
    return future.result()


def call(kind, name, request):
    """Call a service."""
    client = node.create_client(kind, name)
    require(client.wait_for_service(timeout_sec=SERVER_PATIENCE), NO_SERVER)
    return answer(client.call_async(request))


def subscribe(kind, topic, qos=10, **keywords):
    """Subscribe to a topic and return the list of received messages."""
    received = []
    node.create_subscription(kind, topic, received.append, qos, **keywords)
    return received


def topics():
    """Receive a message of each type."""
    received = {name: subscribe(message_class(name), topic_of(name), 5) for name in TYPES}
    wait(lambda: all(received.values()), "missing types")
    for name, messages in received.items():
        require(plain(messages[0]) == plain(message_of(name)), f"{name} has other values")


def latched():
    """Receive what was published before this process started."""
    qos = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    text, static = subscribe(String, LATCHED, qos), subscribe(TFMessage, STATIC, qos)
    wait(lambda: text and static, "nothing arrived")
    require(static[0].transforms[0].child_frame_id == "camera", "another transform")


def graph():
    """Find the nodes, topics, services and endpoints of the peer."""
    nodes = {NODE, LIFECYCLE_NODE}
    wait(lambda: nodes <= set(node.get_node_names()), "missing nodes")
    topic = topic_of(TYPES[0])
    wait(lambda: dict(node.get_topic_names_and_types()).get(topic) == ["std_msgs/msg/String"], "missing topic")
    wait(lambda: node.count_publishers(topic) == 1, "not one publisher")
    own = dict(node.get_publisher_names_and_types_by_node(NODE, "/"))
    require(topic in own, "missing publisher of the node")
    served = dict(node.get_service_names_and_types_by_node(NODE, "/"))
    require(served.get(f"/{NODE}/add") == ["example_interfaces/srv/AddTwoInts"], "missing service of the node")


def endpoints():
    """Find the node of an endpoint."""
    topic = topic_of(TYPES[0])
    wait(lambda: [info.node_name for info in node.get_publishers_info_by_topic(topic)] == [NODE], "no name of the node")
    (info,) = node.get_publishers_info_by_topic(topic)
    require(info.qos_profile.reliability == ReliabilityPolicy.RELIABLE, "another reliability")


def rosout():
    """Receive the log of the peer."""
    received = subscribe(Log, "/rosout", QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL))
    wait(lambda: any((log.name, log.msg) == (NODE, LOG_LINE) for log in received), "no line of the peer")


def mismatch():
    """Request reliable messages of a best-effort publisher."""
    events = []
    callbacks = SubscriptionEventCallbacks(incompatible_qos=events.append)
    received = subscribe(String, BEST_EFFORT, 10, event_callbacks=callbacks)
    wait(lambda: events, "no event")
    best_effort = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
    accepted = subscribe(String, BEST_EFFORT, best_effort)
    wait(lambda: accepted, "best-effort messages do not arrive")
    require(not received, "messages arrive in spite of the mismatch")


def services():
    """Call a service."""
    for number in range(20):
        require(call(AddTwoInts, f"/{NODE}/add", AddTwoInts.Request(a=number, b=2)).sum == number + 2, "another sum")


def parameters():
    """Get and set a parameter."""
    client = AsyncParameterClient(node, NODE)
    require(client.wait_for_services(timeout_sec=SERVER_PATIENCE), NO_SERVER)
    require(answer(client.get_parameters(["speed"])).values[0].double_value == 1.5, "another value")
    answer(client.set_parameters([Parameter("speed", value=2.5)]))
    require(answer(client.get_parameters(["speed"])).values[0].double_value == 2.5, "the value did not change")
    answer(client.set_parameters([Parameter("speed", value=1.5)]))


def actions():
    """Execute a goal with feedback, and cancel another one."""
    client, feedback = ActionClient(node, Fibonacci, f"/{NODE}/count"), []
    require(client.wait_for_server(timeout_sec=SERVER_PATIENCE), NO_SERVER)
    goal = answer(client.send_goal_async(Fibonacci.Goal(order=4), feedback_callback=feedback.append))
    require(goal.accepted, "the goal was rejected")
    require(list(answer(goal.get_result_async()).result.sequence) == [0, 1, 1, 2, 3, 5], "another result")
    require(feedback, "no feedback")
    goal = answer(client.send_goal_async(Fibonacci.Goal(order=500)))
    require(answer(goal.cancel_goal_async()).goals_canceling, "the goal was not canceled")
    require(answer(goal.get_result_async()).status == 5, "another status than canceled")


def lifecycle():
    """Configure and clean up a lifecycle node."""
    events = subscribe(TransitionEvent, f"/{LIFECYCLE_NODE}/transition_event")
    request = ChangeState.Request(transition=Transition(id=Transition.TRANSITION_CONFIGURE))
    require(call(ChangeState, f"/{LIFECYCLE_NODE}/change_state", request).success, "the transition failed")
    state = call(GetState, f"/{LIFECYCLE_NODE}/get_state", GetState.Request()).current_state.label
    require(state == "inactive", f"the state {state}")
    wait(lambda: events, "no event")


ROWS = (topics, latched, graph, endpoints, rosout, mismatch, services, parameters, actions, lifecycle)

rclpy.init()
node = Node("probe")
executor = MultiThreadedExecutor(2)
executor.add_node(node)
threading.Thread(target=executor.spin, daemon=True).start()
for row in ROWS:
    begun = time.monotonic()
    try:
        row()
        outcome = "ok"
    except WrongError as wrong:
        outcome = str(wrong)
    except Exception as error:  # noqa: BLE001 - every outcome is a row of the table
        outcome = f"{type(error).__name__}: {error}"
    print(json.dumps([row.__name__, outcome, round(time.monotonic() - begun, 2)]), flush=True)
os._exit(0)  # Ending the middleware is not part of the test.
