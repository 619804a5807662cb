# SPDX-License-Identifier: Apache-2.0
"""Names of upstream's modules that are defined elsewhere here, or that coframe does not have on purpose.

Each module of rclpy that upstream has as well ends with `find` as its `__getattr__`. A name that an upstream module
merely imports is found in every module, a name that upstream uses in annotations only is `typing.Any`, and a name that
does not exist raises an error with the reason and what to use instead.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from typing_extensions import Self

# Where the names are defined that upstream's modules import from each other.
_ORIGINS: Final = {
    "builtin_interfaces.msg": ("Time",),
    "rcl_interfaces.msg": (
        *("FloatingPointRange", "IntegerRange", "ListParametersResult", "ParameterDescriptor", "ParameterEvent"),
        *("ParameterType", "ParameterValue", "SetParametersResult"),
    ),
    "rcl_interfaces.srv": ("ListParameters",),
    "rclpy.callback_groups": ("CallbackGroup",),
    "rclpy.client": ("Client",),
    "rclpy.clock": ("Clock", "ClockType", "ROSClock"),
    "rclpy.constants": ("S_TO_NS",),
    "rclpy.context": ("Context",),
    "rclpy.duration": ("Duration",),
    "rclpy.destroyable": ("DestroyableType",),
    "rclpy.event_handler": (
        *("EventHandler", "IncompatibleTypeInfo", "PublisherEventCallbacks", "QoSPublisherMatchedInfo"),
        *("QoSSubscriptionMatchedInfo", "SubscriptionEventCallbacks"),
    ),
    "rclpy.exceptions": (
        *("InvalidHandle", "InvalidParameterTypeException", "InvalidParameterValueException"),
        *("InvalidTopicNameException", "NodeNameNonExistentError", "ParameterAlreadyDeclaredException"),
        *("ParameterImmutableException", "ParameterNotDeclaredException", "ParameterUninitializedException"),
        "TimerCancelledError",
    ),
    "rclpy.executors": ("Executor", "await_or_execute"),
    "rclpy.expand_topic_name": ("expand_topic_name",),
    "rclpy.guard_condition": ("GuardCondition",),
    "rclpy.impl.rcutils_logger": ("RcutilsLogger",),
    "rclpy.logging": ("get_logger",),
    "rclpy.logging_service": ("LoggingService",),
    "rclpy.node": ("Node",),
    "rclpy.parameter": ("PARAMETER_SEPARATOR_STRING", "Parameter", "ParameterMsg"),
    "rclpy.publisher": ("Publisher",),
    "rclpy.qos": (
        *("QoSDurabilityPolicy", "QoSHistoryPolicy", "QoSLivelinessPolicy", "QoSProfile", "QoSReliabilityPolicy"),
        *("qos_policy_name_from_kind", "qos_profile_parameter_events"),
    ),
    "rclpy.qos_event": ("QoSEventHandler",),
    "rclpy.qos_overriding_options": ("QoSOverridingOptions",),
    "rclpy.service": ("Service",),
    "rclpy.service_introspection": ("ServiceIntrospectionState",),
    "rclpy.signals": ("SignalHandlerGuardCondition",),
    "rclpy.subscription": ("MessageInfo", "Subscription"),
    "rclpy.subscription_content_filter_options": ("ContentFilterOptions",),
    "rclpy.task": ("Future", "FutureState", "Task"),
    "rclpy.timer": ("Timer", "TimerInfo"),
    "rclpy.topic_endpoint_info": ("TopicEndpointInfo",),
    "rclpy.type_support": (
        *("Action", "ActionT", "EventMessage", "FeedbackMessage", "FeedbackT", "GetResultService"),
        *("GetResultServiceRequest", "GetResultServiceResponse", "GoalT", "Msg", "MsgT", "MsgType", "ResultT"),
        *("SendGoalService", "SendGoalServiceRequest", "SendGoalServiceResponse", "Srv", "SrvRequestT"),
        *("SrvResponseT", "SrvT", "SrvType", "SrvTypeRequest", "SrvTypeResponse"),
        *("check_for_type_support", "check_is_valid_msg_type", "check_is_valid_srv_type"),
    ),
    "rclpy.utilities": ("timeout_sec_to_nsec",),
    "rclpy.validate_full_topic_name": ("validate_full_topic_name",),
    "rclpy.validate_parameter_name": ("validate_parameter_name",),
    "rclpy.validate_topic_name": ("TOPIC_SEPARATOR_STRING", "validate_topic_name"),
    "rclpy.waitable": ("NumberOfEntities", "Waitable"),
    "service_msgs.msg": ("ServiceEventInfo",),
    "type_description_interfaces.srv": ("GetTypeDescription",),
    "unique_identifier_msgs.msg": ("UUID",),
}
_ORIGIN_OF: Final = {name: module for module, names in _ORIGINS.items() for name in names}

# Types that upstream's annotations name: typed dictionaries, unions, and protocols of C objects.
_IN_ANNOTATIONS: Final = frozenset(
    {
        *("AllowableParameterValue", "AllowableParameterValueT", "CallbackNames", "ClientGoalHandleDict"),
        *("ClockHandle", "CommonMsgSrvMetaClass", "ContextHandle", "CreateLifecyclePublisherArgs", "DurationType"),
        *("EventHandlerData", "JumpHandlePreCallbackType", "LifecycleNodeArgs", "LoggingArgs", "LoggingFilterArgs"),
        *("LoggingFilterParams", "MsgMetaClass", "OnceContext", "ProtocolType", "PyCapsule", "QoSProfileAttributes"),
        *("RcutilsLoggerContext", "SendGoalKWargs", "ServerGoalHandleDict", "SkipFirstContext"),
        *("SupportedFiltersKeys", "ThrottleContext", "TimeHandle", "TimeJumpDictionary", "TypeHashDictionary"),
        "YieldedCallback",
    }
)

_LOCKS = "Contexts and logging need no global lock or counter here. Use rclpy.utilities.get_default_context()."
_FILTERS = (
    "The filters of log messages are part of RcutilsLogger. Pass once=True, skip_first=True or throttle_duration_sec= "
    "to the call."
)
_WAIT_SETS = (
    "This is a part of upstream's executors. Override wait_for_ready_callbacks of an executor, or create a task with "
    "Executor.create_task."
)
_HANDLES = "coframe has no C objects. Use the methods of the Python object."
_TYPES = "It is used in annotations only. Use typing.Any."
_ACTIONS = "Executors run actions without these methods of a waitable. Use the methods with `goal` in their names."

# What upstream has and coframe does not have, with the sentence that the user gets.
ABSENT: Final = {
    "rclpy.context.g_logging_configure_lock": _LOCKS,
    "rclpy.context.g_logging_ref_count": _LOCKS,
    "rclpy.utilities.g_context_lock": _LOCKS,
    "rclpy.utilities.g_default_context": _LOCKS,
    "rclpy.executors.TimeoutObject": _WAIT_SETS,
    "rclpy.executors.WaitableEntityType": _WAIT_SETS,
    "rclpy.impl.implementation_singleton.import_c_library": _HANDLES,
    "rclpy.impl.rcutils_logger.CallerId": _FILTERS,
    "rclpy.impl.rcutils_logger.LoggingFilter": _FILTERS,
    "rclpy.impl.rcutils_logger.Once": _FILTERS,
    "rclpy.impl.rcutils_logger.SkipFirst": _FILTERS,
    "rclpy.impl.rcutils_logger.Throttle": _FILTERS,
    "rclpy.impl.rcutils_logger.get_filters_from_kwargs": _FILTERS,
    "rclpy.impl.rcutils_logger.supported_filters": _FILTERS,
}
# The same for the attributes of classes.
ABSENT_ATTRIBUTES: Final = {
    "ActionClient": ({"add_future", "add_to_wait_set", "execute", "get_num_entities", "is_ready"}, _ACTIONS),
    "ActionServer": ({"add_future", "add_to_wait_set", "execute", "get_num_entities", "is_ready"}, _ACTIONS),
}
for _attributes, _ in ABSENT_ATTRIBUTES.values():
    _attributes.update({"notify_goal_done", "remove_future", "take_data"})
ABSENT_ATTRIBUTES.update(
    {
        "InvalidParameterTypeException": ({"Parameter"}, "Use rclpy.parameter.Parameter."),
        "LifecycleNode": ({"ParameterInput"}, _TYPES),
        "Node": ({"ParameterInput"}, _TYPES),
        "ParameterEventHandler": ({"Callbacks"}, "Use the methods of the handler that add and remove callbacks."),
        "Subscription": ({"CallbackType"}, "Pass a function with one argument, or with two for the MessageInfo."),
    }
)


class EntityHandle:
    """The value of the attribute `handle` of an entity, which is a C object in upstream's rclpy.

    It is a context manager, can be passed to a wait set, and says in an error that other attributes do not exist.
    """

    def __init__(self, entity: Any) -> None:
        self._entity = entity

    @property
    def pointer(self) -> int:
        """A number that identifies the entity while it exists."""
        return id(self._entity)

    def destroy_when_not_in_use(self) -> None:
        """Destroy the entity."""
        (getattr(self._entity, "destroy", None) or self._entity.destroy_node)()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Do nothing with the entity."""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, EntityHandle) and other.pointer == self.pointer

    def __hash__(self) -> int:
        return id(self._entity)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"The handle of a {type(self._entity).__name__} has no attribute {name!r}. {_HANDLES}")


class Handle:
    """Property `handle` of the entities."""

    def __get__(self, entity: object, owner: type[object]) -> Any:
        return self if entity is None else EntityHandle(entity)


def entity_of(handle: Any) -> Any:
    """Return the entity of a handle, and any other object itself."""
    return handle._entity if isinstance(handle, EntityHandle) else handle  # noqa: SLF001 - the class is above


def find(module: str, name: str) -> Any:
    """Return a name that a module does not define itself.

    Raises:
        ImportError: coframe does not have it on purpose.
        AttributeError: There is no such name.
    """
    if (reason := ABSENT.get(f"{module}.{name}")) is not None:
        # An AttributeError would lose its text in `from module import name`.
        raise ImportError(f"{module}.{name} does not exist in coframe. {reason}", name=module)
    if name in _IN_ANNOTATIONS:
        return Any
    origin = _ORIGIN_OF.get(name)
    if origin is None or origin == module:
        raise AttributeError(f"module {module!r} has no attribute {name!r}")
    return getattr(import_module(origin), name)
