# SPDX-License-Identifier: Apache-2.0
"""``coframe view --control``: lets pages publish, call services, set parameters, send goals and drive."""

from __future__ import annotations

import array
import json
import threading
import time
from typing import TYPE_CHECKING, Any

import numpy as np

import rclpy
from coframe.viewer.tools.control import ControlError, ControlField
from rclpy.action import ActionClient
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter, parameter_value_to_python
from rosidl_runtime_py import set_message_fields
from rosidl_runtime_py.utilities import get_action, get_message, get_service

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from coframe.viewer.protocol.common import ControlKind

__all__ = ["NodeControl"]

_SERVER_TIMEOUT, _ANSWER_TIMEOUT, _RESULT_TIMEOUT = 3.0, 10.0, 120.0  # seconds
_DRIVE_PERIOD, _DRIVE_TIMEOUT = 0.1, 0.5  # seconds
_MAX_FIELDS = 300
_MAX_PUBLISHERS = 16
_MAX_SPEED = 100.0


class NodeControl:
    """Acts on the graph with a node of its own.

    Args:
        domain: The ROS domain, or None for the one of the environment.
    """

    def __init__(self, domain: int | None) -> None:
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = rclpy.create_node("coframe_view_control", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._publishers: dict[tuple[str, str], Any] = {}
        self._lock = threading.Lock()
        self._is_closed = False
        self._command: tuple[str, str, tuple[float, float], float] | None = None
        self._commanded = 0.0
        self._node.create_timer(_DRIVE_PERIOD, self._drive_on)
        self._thread = threading.Thread(target=self._spin, name="coframe-view-control", daemon=True)
        self._thread.start()

    def names(self, kind: ControlKind) -> dict[str, str]:
        """Return the names of a kind with their types."""
        if kind == "node":
            found = self._node.get_node_names_and_namespaces()
            return {f"{space.rstrip('/')}/{name}": "" for name, space in found if name != self._node.get_name()}
        if kind == "action":
            return _first(rclpy.action.get_action_names_and_types(self._node))
        listed = self._node.get_topic_names_and_types if kind == "topic" else self._node.get_service_names_and_types
        return _first(listed())

    def form(self, kind: ControlKind, name: str, ros_type: str) -> tuple[str, list[ControlField]]:
        """Return the type, and the fields of the message, request or goal, or the parameters of a node."""
        if kind == "node":
            return "", self._parameters(name)
        ros_type = ros_type or self.names(kind).get(name, "")
        if not ros_type:
            raise ControlError(f"there is no {kind} {name!r}", "Enter its type.")
        made = {"topic": lambda t: t(), "service": lambda t: t.Request(), "action": lambda t: t.Goal()}[kind](
            _load(kind, ros_type)
        )
        return ros_type, list(_fields(made))

    def act(
        self, kind: ControlKind, name: str, ros_type: str, values: Mapping[str, Any]
    ) -> tuple[str, list[ControlField]]:
        """Publish a message, call a service, send a goal, or set parameters."""
        try:
            if kind == "node":
                return self._set_parameters(name, values), self._parameters(name)
            act = {"topic": self._publish, "service": self._call, "action": self._send_goal}[kind]
            return act(name, _load(kind, ros_type), values)
        except ControlError:
            raise
        except Exception as error:  # rclpy raises many types for invalid names and values.
            raise ControlError(f"{name}: {error}") from error

    def drive(self, topic: str, ros_type: str, linear: tuple[float, float], angular: float) -> None:
        """Publish a velocity from now on, until the page sends no more."""
        if max(map(abs, (*linear, angular))) > _MAX_SPEED:
            raise ControlError(f"a speed is larger than {_MAX_SPEED:g}")
        with self._lock:
            self._command, self._commanded = (topic, ros_type, linear, angular), time.monotonic()
        self._publish_velocity(topic, ros_type, linear, angular)

    def close(self) -> None:
        """Publish zero if the robot is driven, and leave the graph."""
        self._is_closed = True
        with self._lock:
            command, self._command = self._command, None
        if command is not None:
            self._publish_velocity(command[0], command[1], (0.0, 0.0), 0.0)
        self._executor.shutdown()
        self._thread.join(_SERVER_TIMEOUT)
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)

    def _spin(self) -> None:
        while self._context.ok():
            try:
                self._executor.spin_once(timeout_sec=_DRIVE_PERIOD)
            except Exception:  # noqa: BLE001 - the executor was shut down
                return

    def _drive_on(self) -> None:
        with self._lock:
            command = self._command
            ends = command is not None and time.monotonic() - self._commanded > _DRIVE_TIMEOUT
            if ends:
                self._command = None
        if command is not None:
            topic, ros_type, linear, angular = command
            self._publish_velocity(topic, ros_type, (0.0, 0.0) if ends else linear, 0.0 if ends else angular)

    def _publish_velocity(self, topic: str, ros_type: str, linear: tuple[float, float], angular: float) -> None:
        twist = {"linear": {"x": linear[0], "y": linear[1]}, "angular": {"z": angular}}
        stamped = ros_type.endswith("TwistStamped")
        values = {"header": {"stamp": "now"}, "twist": twist} if stamped else twist
        kind = "geometry_msgs/msg/TwistStamped" if stamped else "geometry_msgs/msg/Twist"
        self.act("topic", topic, kind, values)

    def _publish(self, topic: str, message_type: Any, values: Mapping[str, Any]) -> tuple[str, list[ControlField]]:
        message = self._fill_message(message_type(), values)
        key = (topic, message_type.__name__)
        with self._lock:
            publisher = self._publishers.get(key)
            is_new = publisher is None
            if publisher is None:
                while len(self._publishers) >= _MAX_PUBLISHERS:
                    self._node.destroy_publisher(self._publishers.pop(next(iter(self._publishers))))
                publisher = self._publishers[key] = self._node.create_publisher(message_type, topic, 10)
        if is_new and self._node.count_subscribers(topic):
            _wait(lambda: publisher.get_subscription_count() > 0, _SERVER_TIMEOUT)
        publisher.publish(message)
        count = publisher.get_subscription_count()
        return f"Published on {topic}: {count} {'subscription' if count == 1 else 'subscriptions'}", []

    def _call(self, service: str, service_type: Any, values: Mapping[str, Any]) -> tuple[str, list[ControlField]]:
        request = self._fill_message(service_type.Request(), values)
        response = self._response(service, service_type, request)
        return f"{service} has responded", list(_fields(response))

    def _response(self, service: str, service_type: Any, request: Any) -> Any:
        client = self._node.create_client(service_type, service)
        try:
            if not client.wait_for_service(_SERVER_TIMEOUT):
                raise ControlError(f"no node offers the service {service}")
            return self._result(client.call_async(request), _ANSWER_TIMEOUT, service)
        finally:
            self._node.destroy_client(client)

    def _send_goal(self, action: str, action_type: Any, values: Mapping[str, Any]) -> tuple[str, list[ControlField]]:
        goal = self._fill_message(action_type.Goal(), values)
        client = ActionClient(self._node, action_type, action)
        try:
            if not client.wait_for_server(_SERVER_TIMEOUT):
                raise ControlError(f"no node offers the action {action}")
            handle = self._result(client.send_goal_async(goal), _ANSWER_TIMEOUT, action)
            if not handle.accepted:
                raise ControlError(f"{action} has rejected the goal")
            found = self._result(handle.get_result_async(), _RESULT_TIMEOUT, action)
            return f"{action}: the goal has ended with status {found.status}", list(_fields(found.result))
        finally:
            client.destroy()

    def _parameters(self, node: str) -> list[ControlField]:
        from rcl_interfaces.srv import GetParameters, ListParameters  # noqa: PLC0415 - only parameters need them

        listed = self._response(f"{node}/list_parameters", ListParameters, ListParameters.Request())
        names = sorted(listed.result.names)[:_MAX_FIELDS]
        values = self._response(f"{node}/get_parameters", GetParameters, GetParameters.Request(names=names)).values
        found = [parameter_value_to_python(value) for value in values]
        return [ControlField(name, type(one).__name__, _json(one)) for name, one in zip(names, found, strict=True)]

    def _set_parameters(self, node: str, values: Mapping[str, Any]) -> str:
        from rcl_interfaces.srv import SetParameters  # noqa: PLC0415 - see above

        parameters = [Parameter(name, value=value).to_parameter_msg() for name, value in values.items()]
        request = SetParameters.Request(parameters=parameters)
        results = self._response(f"{node}/set_parameters", SetParameters, request).results
        for name, result in zip(values, results, strict=True):
            if not result.successful:
                raise ControlError(f"{node} has rejected {name}: {result.reason or 'without a reason'}")
        return f"{node}: set {', '.join(values)}"

    def _fill_message(self, message: Any, values: Mapping[str, Any]) -> Any:
        stamps = set_message_fields(message, dict(values), expand_header_auto=True, expand_time_now=True) or []
        now = self._node.get_clock().now().to_msg()
        for setter in stamps:
            setter(now)
        return message

    def _result(self, future: Any, timeout: float, name: str) -> Any:
        if not _wait(lambda: future.done() or self._is_closed, timeout) or not future.done():
            future.cancel()
            raise ControlError(f"{name} has not responded within {timeout:g} s")
        return future.result()


def _wait(condition: Callable[[], bool], timeout: float) -> bool:
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.01)
    return True


def _first(found: list[tuple[str, list[str]]]) -> dict[str, str]:
    return {name: types[0] for name, types in found}


def _load(kind: ControlKind, ros_type: str) -> Any:
    load = {"topic": get_message, "service": get_service, "action": get_action}[kind]
    try:
        return load(ros_type)
    except Exception as error:
        raise ControlError(f"there is no type {ros_type!r} of a {kind}", "Write it as package/msg/Name.") from error


def _fields(message: Any, prefix: str = "") -> Iterator[ControlField]:
    """Yield the fields of a message that are values; sequences are one field with a JSON array."""
    for name, kind in message.get_fields_and_field_types().items():
        value = getattr(message, name)
        if hasattr(value, "get_fields_and_field_types"):
            yield from _fields(value, f"{prefix}{name}.")
        else:
            yield ControlField(prefix + name, kind, _json(value))


def _json(value: Any) -> str:
    return json.dumps(_to_builtin(value))


def _to_builtin(value: Any) -> Any:
    if isinstance(value, np.ndarray | array.array):
        return value.tolist()
    if isinstance(value, bytes | bytearray):
        return list(value)
    if isinstance(value, list | tuple):
        return [_to_builtin(one) for one in value]
    if hasattr(value, "get_fields_and_field_types"):
        return {name: _to_builtin(getattr(value, name)) for name in value.get_fields_and_field_types()}
    return value
