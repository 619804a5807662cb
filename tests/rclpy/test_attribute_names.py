# SPDX-License-Identifier: Apache-2.0
"""The attributes of user-facing classes: a user's subclass may give its own attributes any name that rclpy leaves free.

Allowed are the attributes that the classes of ROS 2 have as well, and mangled names.
"""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import rclpy
import tf2_ros
from rclpy.action import ActionClient, ActionServer
from rclpy.action.client import ClientGoalHandle
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.clock import Clock, ROSClock
from rclpy.context import Context
from rclpy.executors import Executor, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.task import Future, Task
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform

# Attributes of instances of ROS 2's classes, which its list of class attributes does not contain.
_OF_FUTURES = {
    *("_callbacks", "_cancelled", "_done", "_exception", "_exception_fetched", "_executor", "_lock", "_result"),
    *("_set_executor", "_is_protocol"),
}
_OF_CALLBACK_ENTITIES = {"callback", "callback_group"}
_OF_EXECUTORS = {"_context", "_nodes", "_wait_for_ready_callbacks"}
_OF_LISTENERS = {"buffer", "group", "node", "tf_static_sub", "tf_sub"}
_IN_ROS = {
    "Publisher": {"event_handlers", "msg_type", "qos_profile", "topic"},
    "Subscription": {*_OF_CALLBACK_ENTITIES, "event_handlers", "msg_type", "qos_profile", "raw", "topic"},
    "Client": {"callback_group", "context", "qos_profile", "srv_name", "srv_type"},
    "Service": {*_OF_CALLBACK_ENTITIES, "qos_profile", "srv_name", "srv_type"},
    "Timer": _OF_CALLBACK_ENTITIES,
    "GuardCondition": _OF_CALLBACK_ENTITIES,
    "Executor": _OF_EXECUTORS,
    "SingleThreadedExecutor": _OF_EXECUTORS,
    "MultiThreadedExecutor": _OF_EXECUTORS,
    "Context": {"_lock"},
    "Clock": {"_clock_type"},
    "ROSClock": {"_clock_type", "_set_ros_time_is_active"},
    "Parameter": {"_name", "_type_", "_value", "_is_protocol"},
    "ReentrantCallbackGroup": {"entities"},
    "MutuallyExclusiveCallbackGroup": {"_lock", "entities"},
    "ActionClient": {
        *("_action_name", "_action_type", "_cancel_goal", "_cancel_goal_async", "_feedback_callbacks", "_get_result"),
        *("_get_result_async", "_node"),
    },
    "ActionServer": {"_action_type", "_lock", "_node"},
    "ServerGoalHandle": {"_action_server", "_goal_info", "_goal_request", "_update_state"},
    "ClientGoalHandle": {"_action_client", "_goal_id", "_goal_response", "_status"},
    "Future": _OF_FUTURES,
    "Task": {*_OF_FUTURES, "_args", "_executing", "_handler", "_kwargs"},
    "QoSProfile": {
        *("_avoid_ros_namespace_conventions", "_deadline", "_depth", "_durability", "_history", "_lifespan"),
        *("_liveliness", "_liveliness_lease_duration", "_reliability"),
    },
    "RcutilsLogger": {"name"},
    "Buffer": {"_allFramesAsDot", "_chain", "_frameExists", "_getFrameStrings", "registration", "srv"},
    "TransformListener": _OF_LISTENERS,
    "TransformBroadcaster": {"pub_tf"},
    "StaticTransformBroadcaster": {"_child_frame_ids", "net_message", "pub_tf"},
    "StaticTransformListener": {*_OF_LISTENERS, "callback", "static_callback", "unregister"},
    "BufferClient": {"action_client", "check_frequency", "node", "registration", "timeout_padding"},
    "BufferServer": {"action_server", "buffer", "destroy"},
}
# Public names of newer distributions than the one that was listed, and documented additions.
_LATER = {
    "Node": {
        *("add_post_set_parameters_callback", "add_pre_set_parameters_callback", "get_fully_qualified_node_names"),
        *("count_clients", "count_services", "list_parameters", "wait_for_node"),
        *("remove_post_set_parameters_callback", "remove_pre_set_parameters_callback"),
        *("get_clients_info_by_service", "get_servers_info_by_service", "_parameters"),
        *("get_action_client_names_and_types_by_node", "get_action_names_and_types"),
        "get_action_server_names_and_types_by_node",
    },
    "Subscription": {"get_publisher_count"},
    "Timer": {"callback"},
    "Buffer": {"clock", "jump_handle", "time_jump_callback"},
    "BufferClient": {"lookup_transform_async", "lookup_transform_full_async"},
}
_MANGLED = re.compile(r"_[A-Za-z][A-Za-z0-9]*__\w+")


def test_no_attribute_can_collide_with_those_of_a_subclass(
    shared: Path, context: Context, make_node: Callable[..., Node]
) -> None:
    node = make_node()
    in_ros: dict[str, set[str]] = {}
    for distribution in ("humble", "jazzy", "kilted"):
        names = json.loads((shared / "interop" / f"api_{distribution}.json").read_text(encoding="utf-8"))
        for kind, attributes in _class_attributes(names).items():
            in_ros.setdefault(kind, set()).update(attributes)
    collisions = {}
    for thing in [*_objects(node, context), ServerGoalHandle, ClientGoalHandle, Executor]:
        name = (thing if isinstance(thing, type) else type(thing)).__name__
        allowed = in_ros.get(name, set()) | _IN_ROS.get(name, set()) | _LATER.get(name, set())
        added = {attribute for attribute in dir(thing) if not attribute.startswith("__")} - allowed
        if found := sorted(attribute for attribute in added if not _MANGLED.fullmatch(attribute)):
            collisions[name] = found
    assert collisions == {}


@pytest.mark.parametrize("name", ["_wire", "_participant", "_waitables", "_take", "_adopt", "_executables", "_timer"])
def test_a_node_with_its_own_attribute_works(context: Context, make_node: Callable[..., Node], name: str) -> None:
    received = []
    node = make_node()
    setattr(node, name, None)
    node.create_subscription(String, "chatter", received.append, 1)
    publisher = node.create_publisher(String, "chatter", 1)
    setattr(publisher, name, None)
    executor = SingleThreadedExecutor(context=context)
    setattr(executor, name, None)
    publisher.publish(String(data="hello"))
    rclpy.spin_once(node, executor=executor, timeout_sec=5)
    assert received == [String(data="hello")]


def _objects(node: Node, context: Context) -> list[Any]:
    buffer = tf2_ros.Buffer(node=node)
    return [
        node,
        node.create_publisher(String, "topic", 1),
        node.create_subscription(String, "topic", lambda _: None, 1),
        node.create_client(Trigger, "service"),
        node.create_service(Trigger, "service", lambda _, response: response),
        node.create_timer(1, lambda: None),
        node.create_rate(1),
        node.create_guard_condition(lambda: None),
        SingleThreadedExecutor(context=context),
        MultiThreadedExecutor(context=context),
        context,
        Clock(),
        ROSClock(),
        rclpy.Parameter("parameter", value=1),
        ReentrantCallbackGroup(),
        MutuallyExclusiveCallbackGroup(),
        ActionClient(node, LookupTransform, "action"),
        ActionServer(node, LookupTransform, "action", lambda _: LookupTransform.Result()),
        Future(),
        Task(lambda: None),
        QoSProfile(depth=1),
        node.get_logger(),
        buffer,
        tf2_ros.TransformListener(buffer, node),
        tf2_ros.StaticTransformListener(buffer, node),
        tf2_ros.TransformBroadcaster(node),
        tf2_ros.StaticTransformBroadcaster(node),
        tf2_ros.BufferClient(node, "tf2_buffer_server"),
        tf2_ros.BufferServer(buffer, node, "tf2_buffer_server"),
    ]


def _class_attributes(api: dict[str, Any]) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for names in api.values():
        for name, (attributes, _) in names.items() if isinstance(names, dict) else ():
            found.setdefault(name, set()).update(attributes or ())
    return found
