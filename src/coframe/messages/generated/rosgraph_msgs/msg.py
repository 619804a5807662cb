# Written by scripts/generate_messages.py from interfaces/rosgraph_msgs/msg; do not edit.
"""Messages of rosgraph_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import coframe.lazy_numpy as np
from coframe.messages.definition import Array, BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.builtin_interfaces.msg import Duration, Time
from coframe.messages.generated.rcl_interfaces.msg import ParameterDescriptor, ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberArray


class TypeHash(Message):
    """Message rosgraph_msgs/msg/TypeHash."""

    ROS_TYPE = "rosgraph_msgs/msg/TypeHash"
    SLOT_TYPES = (
        BasicType('uint8'),
        Array(BasicType('uint8'), 32),
    )

    if TYPE_CHECKING:
        version: int
        value = NumberArray[np.uint8]()
        def __init__(self, *, version: int = ..., value: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_version", "_value"]

        def __init__(self, **fields: Any) -> None:
            self._version = 0
            self._value = np.zeros(32, np.uint8)
            if fields:
                set_fields(self, fields)


class InterfaceType(Message):
    """Message rosgraph_msgs/msg/InterfaceType."""

    ROS_TYPE = "rosgraph_msgs/msg/InterfaceType"
    SLOT_TYPES = (
        UnboundedString(),
        NamespacedType(('rosgraph_msgs', 'msg'), 'TypeHash'),
    )

    if TYPE_CHECKING:
        name: str
        hash: TypeHash
        def __init__(self, *, name: str = ..., hash: TypeHash = ...) -> None: ...
    else:
        __slots__ = ["_name", "_hash"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._hash = fields.get("hash") or TypeHash()
            if fields:
                set_fields(self, fields)


class QoSProfile(Message):
    """Message rosgraph_msgs/msg/QoSProfile."""

    ROS_TYPE = "rosgraph_msgs/msg/QoSProfile"
    SLOT_TYPES = (
        BasicType('uint32'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Duration'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Duration'),
        BasicType('uint8'),
        BasicType('uint8'),
        BasicType('uint8'),
        BasicType('uint8'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Duration'),
    )
    HISTORY_SYSTEM_DEFAULT: Final = 0
    HISTORY_KEEP_LAST: Final = 1
    HISTORY_KEEP_ALL: Final = 2
    HISTORY_UNKNOWN: Final = 3
    RELIABILITY_SYSTEM_DEFAULT: Final = 0
    RELIABILITY_RELIABLE: Final = 1
    RELIABILITY_BEST_EFFORT: Final = 2
    RELIABILITY_UNKNOWN: Final = 3
    RELIABILITY_BEST_AVAILABLE: Final = 4
    DURABILITY_SYSTEM_DEFAULT: Final = 0
    DURABILITY_TRANSIENT_LOCAL: Final = 1
    DURABILITY_VOLATILE: Final = 2
    DURABILITY_UNKNOWN: Final = 3
    DURABILITY_BEST_AVAILABLE: Final = 4
    LIVELINESS_SYSTEM_DEFAULT: Final = 0
    LIVELINESS_AUTOMATIC: Final = 1
    LIVELINESS_MANUAL_BY_TOPIC: Final = 3
    LIVELINESS_UNKNOWN: Final = 4
    LIVELINESS_BEST_AVAILABLE: Final = 5

    if TYPE_CHECKING:
        depth: int
        deadline: Duration
        lifespan: Duration
        history: int
        reliability: int
        durability: int
        liveliness: int
        liveliness_lease_duration: Duration
        def __init__(self, *, depth: int = ..., deadline: Duration = ..., lifespan: Duration = ..., history: int = ..., reliability: int = ..., durability: int = ..., liveliness: int = ..., liveliness_lease_duration: Duration = ...) -> None: ...
    else:
        __slots__ = ["_depth", "_deadline", "_lifespan", "_history", "_reliability", "_durability", "_liveliness", "_liveliness_lease_duration"]

        def __init__(self, **fields: Any) -> None:
            self._depth = 0
            self._deadline = fields.get("deadline") or Duration()
            self._lifespan = fields.get("lifespan") or Duration()
            self._history = 0
            self._reliability = 0
            self._durability = 0
            self._liveliness = 0
            self._liveliness_lease_duration = fields.get("liveliness_lease_duration") or Duration()
            if fields:
                set_fields(self, fields)


class Service(Message):
    """Message rosgraph_msgs/msg/Service."""

    ROS_TYPE = "rosgraph_msgs/msg/Service"
    SLOT_TYPES = (
        UnboundedString(),
        NamespacedType(('rosgraph_msgs', 'msg'), 'InterfaceType'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'QoSProfile'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'InterfaceType'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'QoSProfile'),
    )

    if TYPE_CHECKING:
        name: str
        request_type: InterfaceType
        request_qos: QoSProfile
        response_type: InterfaceType
        response_qos: QoSProfile
        def __init__(self, *, name: str = ..., request_type: InterfaceType = ..., request_qos: QoSProfile = ..., response_type: InterfaceType = ..., response_qos: QoSProfile = ...) -> None: ...
    else:
        __slots__ = ["_name", "_request_type", "_request_qos", "_response_type", "_response_qos"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._request_type = fields.get("request_type") or InterfaceType()
            self._request_qos = fields.get("request_qos") or QoSProfile()
            self._response_type = fields.get("response_type") or InterfaceType()
            self._response_qos = fields.get("response_qos") or QoSProfile()
            if fields:
                set_fields(self, fields)


class Topic(Message):
    """Message rosgraph_msgs/msg/Topic."""

    ROS_TYPE = "rosgraph_msgs/msg/Topic"
    SLOT_TYPES = (
        UnboundedString(),
        NamespacedType(('rosgraph_msgs', 'msg'), 'InterfaceType'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'QoSProfile'),
    )

    if TYPE_CHECKING:
        name: str
        type: InterfaceType
        qos: QoSProfile
        def __init__(self, *, name: str = ..., type: InterfaceType = ..., qos: QoSProfile = ...) -> None: ...
    else:
        __slots__ = ["_name", "_type", "_qos"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._type = fields.get("type") or InterfaceType()
            self._qos = fields.get("qos") or QoSProfile()
            if fields:
                set_fields(self, fields)


class Action(Message):
    """Message rosgraph_msgs/msg/Action."""

    ROS_TYPE = "rosgraph_msgs/msg/Action"
    SLOT_TYPES = (
        UnboundedString(),
        NamespacedType(('rosgraph_msgs', 'msg'), 'Service'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'Service'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'Service'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'Topic'),
        NamespacedType(('rosgraph_msgs', 'msg'), 'Topic'),
    )

    if TYPE_CHECKING:
        name: str
        send_goal: Service
        get_result: Service
        cancel_goal: Service
        feedback: Topic
        status: Topic
        def __init__(self, *, name: str = ..., send_goal: Service = ..., get_result: Service = ..., cancel_goal: Service = ..., feedback: Topic = ..., status: Topic = ...) -> None: ...
    else:
        __slots__ = ["_name", "_send_goal", "_get_result", "_cancel_goal", "_feedback", "_status"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._send_goal = fields.get("send_goal") or Service()
            self._get_result = fields.get("get_result") or Service()
            self._cancel_goal = fields.get("cancel_goal") or Service()
            self._feedback = fields.get("feedback") or Topic()
            self._status = fields.get("status") or Topic()
            if fields:
                set_fields(self, fields)


class Clock(Message):
    """The time that nodes with use_sim_time take as now."""

    ROS_TYPE = "rosgraph_msgs/msg/Clock"
    SLOT_TYPES = (
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
    )

    if TYPE_CHECKING:
        clock: Time
        def __init__(self, *, clock: Time = ...) -> None: ...
    else:
        __slots__ = ["_clock"]

        def __init__(self, **fields: Any) -> None:
            self._clock = fields.get("clock") or Time()
            if fields:
                set_fields(self, fields)


class Node(Message):
    """Message rosgraph_msgs/msg/Node."""

    ROS_TYPE = "rosgraph_msgs/msg/Node"
    SLOT_TYPES = (
        UnboundedString(),
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'ParameterDescriptor')),
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'ParameterValue')),
        UnboundedSequence(NamespacedType(('rosgraph_msgs', 'msg'), 'Topic')),
        UnboundedSequence(NamespacedType(('rosgraph_msgs', 'msg'), 'Topic')),
        UnboundedSequence(NamespacedType(('rosgraph_msgs', 'msg'), 'Service')),
        UnboundedSequence(NamespacedType(('rosgraph_msgs', 'msg'), 'Service')),
        UnboundedSequence(NamespacedType(('rosgraph_msgs', 'msg'), 'Action')),
        UnboundedSequence(NamespacedType(('rosgraph_msgs', 'msg'), 'Action')),
    )

    if TYPE_CHECKING:
        name: str
        parameters: list[ParameterDescriptor]
        parameter_values: list[ParameterValue]
        publishers: list[Topic]
        subscriptions: list[Topic]
        service_clients: list[Service]
        service_servers: list[Service]
        action_clients: list[Action]
        action_servers: list[Action]
        def __init__(self, *, name: str = ..., parameters: list[ParameterDescriptor] = ..., parameter_values: list[ParameterValue] = ..., publishers: list[Topic] = ..., subscriptions: list[Topic] = ..., service_clients: list[Service] = ..., service_servers: list[Service] = ..., action_clients: list[Action] = ..., action_servers: list[Action] = ...) -> None: ...
    else:
        __slots__ = ["_name", "_parameters", "_parameter_values", "_publishers", "_subscriptions", "_service_clients", "_service_servers", "_action_clients", "_action_servers"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._parameters = []
            self._parameter_values = []
            self._publishers = []
            self._subscriptions = []
            self._service_clients = []
            self._service_servers = []
            self._action_clients = []
            self._action_servers = []
            if fields:
                set_fields(self, fields)


class Graph(Message):
    """Message rosgraph_msgs/msg/Graph."""

    ROS_TYPE = "rosgraph_msgs/msg/Graph"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rosgraph_msgs', 'msg'), 'Node')),
    )

    if TYPE_CHECKING:
        nodes: list[Node]
        def __init__(self, *, nodes: list[Node] = ...) -> None: ...
    else:
        __slots__ = ["_nodes"]

        def __init__(self, **fields: Any) -> None:
            self._nodes = []
            if fields:
                set_fields(self, fields)
