# SPDX-License-Identifier: Apache-2.0
"""Quality of service (QoS) profiles and policies."""

from __future__ import annotations

import warnings
from enum import Enum, IntEnum
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from rclpy import _absent
from rclpy._qos_compatibility import QoSCompatibility, qos_check_compatible
from rclpy.duration import Duration, Infinite

if TYPE_CHECKING:
    from typing_extensions import Self

    from coframe.wire.qos import QoS as WireQoS


__all__ = [
    "DurabilityPolicy",
    "Duration",
    "HistoryPolicy",
    "InvalidQoSProfileException",
    "LivelinessPolicy",
    "QoSCompatibility",
    "QoSDurabilityPolicy",
    "QoSHistoryPolicy",
    "QoSLivelinessPolicy",
    "QoSPolicyEnum",
    "QoSPolicyKind",
    "QoSPresetProfiles",
    "QoSProfile",
    "QoSReliabilityPolicy",
    "ReliabilityPolicy",
    "as_qos_profile",
    "qos_check_compatible",
    "qos_policy_name_from_kind",
    "qos_profile_action_status_default",
    "qos_profile_best_available",
    "qos_profile_default",
    "qos_profile_parameter_events",
    "qos_profile_parameters",
    "qos_profile_rosout_default",
    "qos_profile_sensor_data",
    "qos_profile_services_default",
    "qos_profile_system_default",
    "qos_profile_unknown",
]


class InvalidQoSProfileException(Exception):
    """A QoS profile is incomplete or inconsistent."""

    def __init__(self, *args: object) -> None:
        super().__init__("Invalid QoSProfile", *args)


class QoSPolicyKind(IntEnum):
    """Kinds of QoS policies."""

    INVALID = 1 << 0
    DURABILITY = 1 << 1
    DEADLINE = 1 << 2
    LIVELINESS = 1 << 3
    RELIABILITY = 1 << 4
    HISTORY = 1 << 5
    LIFESPAN = 1 << 6
    DEPTH = 1 << 7
    LIVELINESS_LEASE_DURATION = 1 << 8
    AVOID_ROS_NAMESPACE_CONVENTIONS = 1 << 9


class QoSPolicyEnum(IntEnum):
    """Base class of the policies, whose values have short names such as `keep_last`."""

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the short names of all values."""
        return [key.lower() for key in cls.__members__ if not key.startswith("RMW")]

    @classmethod
    def get_from_short_key(cls, name: str) -> int:
        """Return the value with a short name, case-insensitively.

        Raises:
            KeyError: No value has this name.
        """
        return cls[name.upper()].value

    @property
    def short_key(self) -> str:
        """The short name of the value."""
        return self.name.lower()


class HistoryPolicy(QoSPolicyEnum):
    """Policy for the number of queued messages."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3
    RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = KEEP_LAST
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = KEEP_ALL
    RMW_QOS_POLICY_HISTORY_UNKNOWN = UNKNOWN


class ReliabilityPolicy(QoSPolicyEnum):
    """Policy for the retransmission of lost messages."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_RELIABILITY_RELIABLE = RELIABLE
    RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = BEST_EFFORT
    RMW_QOS_POLICY_RELIABILITY_UNKNOWN = UNKNOWN


class DurabilityPolicy(QoSPolicyEnum):
    """Policy for the delivery of earlier messages to late-joining subscriptions."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = TRANSIENT_LOCAL
    RMW_QOS_POLICY_DURABILITY_VOLATILE = VOLATILE
    RMW_QOS_POLICY_DURABILITY_UNKNOWN = UNKNOWN


class LivelinessPolicy(QoSPolicyEnum):
    """Policy for how a publisher asserts that it is alive."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5
    RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_LIVELINESS_AUTOMATIC = AUTOMATIC
    RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC = MANUAL_BY_TOPIC
    RMW_QOS_POLICY_LIVELINESS_UNKNOWN = UNKNOWN


QoSHistoryPolicy = HistoryPolicy
QoSReliabilityPolicy = ReliabilityPolicy
QoSDurabilityPolicy = DurabilityPolicy
QoSLivelinessPolicy = LivelinessPolicy

_POLICIES: Final[dict[str, Any]] = {
    "history": HistoryPolicy,
    "depth": int,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "lifespan": Duration,
    "deadline": Duration,
    "liveliness": LivelinessPolicy,
    "liveliness_lease_duration": Duration,
    "avoid_ros_namespace_conventions": bool,
}


# The durations with which an endpoint matches all others, like the policies BEST_AVAILABLE.
DeadlineBestAvailable: Final = Duration(nanoseconds=Infinite.nanoseconds - 1)
LivelinessLeaseDurationeBestAvailable: Final = DeadlineBestAvailable

# The depth of profiles whose history does not use it, as in upstream.
_DEFAULT_DEPTH: Final = 10


class QoSProfile:
    """A complete set of QoS policies. Profiles with equal policies are equal.

    A policy that is None has its default value.

    Args:
        history: Whether the last messages are kept, or all; KEEP_LAST if only `depth` is given.
        depth: Size of the queue, required with KEEP_LAST.
        reliability: RELIABLE by default.
        durability: VOLATILE by default.
        lifespan: Duration after which messages are dropped.
        deadline: Expected maximum duration between messages.
        liveliness: How publishers show that they are alive.
        liveliness_lease_duration: Duration in which they must do so.
        avoid_ros_namespace_conventions: Whether the name of the topic is used without ROS's prefix.
        unknown: Other names, which are an AssertionError.

    Raises:
        InvalidQoSProfileException: Neither history nor depth is given, or KEEP_LAST is given without depth.
    """

    history: HistoryPolicy
    depth: int
    reliability: ReliabilityPolicy
    durability: DurabilityPolicy
    lifespan: Duration
    deadline: Duration
    liveliness: LivelinessPolicy
    liveliness_lease_duration: Duration
    avoid_ros_namespace_conventions: bool

    __slots__ = tuple(f"_{policy}" for policy in _POLICIES)

    def __init__(
        self,
        history: HistoryPolicy | int | None = None,
        depth: int | None = None,
        reliability: ReliabilityPolicy | int | None = None,
        durability: DurabilityPolicy | int | None = None,
        lifespan: Duration | None = None,
        deadline: Duration | None = None,
        liveliness: LivelinessPolicy | int | None = None,
        liveliness_lease_duration: Duration | None = None,
        avoid_ros_namespace_conventions: bool | None = None,
        **unknown: Any,
    ) -> None:
        values = (
            *(history, depth, reliability, durability, lifespan, deadline),
            *(liveliness, liveliness_lease_duration, avoid_ros_namespace_conventions),
        )
        kwargs = {name: value for name, value in zip(_POLICIES, values, strict=True) if value is not None}
        assert not unknown, f"Invalid arguments passed to constructor: {unknown.keys()}"
        if "history" not in kwargs:
            if "depth" not in kwargs:
                raise InvalidQoSProfileException("History and/or depth settings are required.")
            kwargs["history"] = HistoryPolicy.KEEP_LAST
        if kwargs["history"] == HistoryPolicy.KEEP_LAST and "depth" not in kwargs:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        defaults = {
            "depth": _DEFAULT_DEPTH,
            "reliability": ReliabilityPolicy.RELIABLE,
            "durability": DurabilityPolicy.VOLATILE,
            "lifespan": Duration(),
            "deadline": Duration(),
            "liveliness": LivelinessPolicy.SYSTEM_DEFAULT,
            "liveliness_lease_duration": Duration(),
            "avoid_ros_namespace_conventions": False,
        }
        for policy, value in (defaults | kwargs).items():
            setattr(self, policy, value)
        if self.depth == 0 and self.history is HistoryPolicy.KEEP_LAST:
            warnings.warn(
                "A zero depth with KEEP_LAST doesn't make sense; no data could be stored. "
                "This will be interpreted as SYSTEM_DEFAULT",
                stacklevel=2,
            )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, QoSProfile):
            return False
        return all(getattr(self, policy) == getattr(other, policy) for policy in _POLICIES)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={getattr(self, name)!s}' for name in _POLICIES)})"

    def get_c_qos_profile(self) -> Self:
        """Return the profile itself, since there is no C implementation."""
        return self

    def _Coframe__to_wire(self) -> WireQoS:
        from coframe.wire.qos import QoS  # noqa: PLC0415 - profiles need no middleware

        return QoS(
            depth=max(self.depth, 1),
            reliable=self.reliability is not ReliabilityPolicy.BEST_EFFORT,
            transient_local=self.durability is DurabilityPolicy.TRANSIENT_LOCAL,
            keep_all=self.history is HistoryPolicy.KEEP_ALL,
            manual_liveliness=self.liveliness is LivelinessPolicy.MANUAL_BY_TOPIC,
            deadline=_or_infinite(self.deadline),
            lifespan=_or_infinite(self.lifespan),
            lease=_or_infinite(self.liveliness_lease_duration),
        )


def _or_infinite(duration: Duration) -> int:
    """Return a duration in nanoseconds. Zero means that the policy is not set, and the best available is infinite."""
    return (
        duration.nanoseconds if 0 < duration.nanoseconds < DeadlineBestAvailable.nanoseconds else Infinite.nanoseconds
    )


def _checked_property(policy: str, kind: type[Any]) -> property:
    def get(self: QoSProfile) -> Any:
        return getattr(self, f"_{policy}")

    def set_(self: QoSProfile, value: Any) -> None:
        accepted = int if issubclass(kind, IntEnum) else kind
        assert isinstance(value, accepted), f"{policy} must be of type {kind.__name__}, not {type(value).__name__}."
        object.__setattr__(self, f"_{policy}", kind(value) if issubclass(kind, IntEnum) else value)

    return property(get, set_, doc=f"The QoS policy `{policy}`.")


for _policy, _kind in _POLICIES.items():
    setattr(QoSProfile, _policy, _checked_property(_policy, _kind))


def as_qos_profile(qos: QoSProfile | int) -> QoSProfile:
    """Return the profile, or a KEEP_LAST profile with the given depth.

    Raises:
        TypeError: `qos` is neither a profile nor an int.
        ValueError: The depth is negative.
    """
    if isinstance(qos, QoSProfile):
        return qos
    if type(qos) is bool or not isinstance(qos, int):
        raise TypeError(f"Expected QoSProfile or int, but received {type(qos)!r}")
    if qos < 0:
        raise ValueError("history depth must be greater than or equal to zero")
    return QoSProfile(depth=qos)


qos_profile_default: Final = QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=10)
qos_profile_unknown: Final = QoSProfile(
    history=HistoryPolicy.UNKNOWN,
    depth=0,
    reliability=ReliabilityPolicy.UNKNOWN,
    durability=DurabilityPolicy.UNKNOWN,
    liveliness=LivelinessPolicy.UNKNOWN,
)
qos_profile_system_default: Final = QoSProfile(
    history=HistoryPolicy.SYSTEM_DEFAULT,
    depth=0,
    reliability=ReliabilityPolicy.SYSTEM_DEFAULT,
    durability=DurabilityPolicy.SYSTEM_DEFAULT,
)
qos_profile_sensor_data: Final = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
qos_profile_services_default: Final = QoSProfile(depth=10)
qos_profile_parameters: Final = QoSProfile(depth=1000)
qos_profile_parameter_events: Final = QoSProfile(depth=1000)
qos_profile_rosout_default: Final = QoSProfile(
    depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=Duration(seconds=10)
)
qos_profile_action_status_default: Final = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
qos_profile_best_available: Final = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_AVAILABLE,
    durability=DurabilityPolicy.BEST_AVAILABLE,
    liveliness=LivelinessPolicy.BEST_AVAILABLE,
    deadline=DeadlineBestAvailable,
    liveliness_lease_duration=DeadlineBestAvailable,
)


class QoSPresetProfiles(Enum):
    """Predefined profiles."""

    UNKNOWN = qos_profile_unknown
    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available
    ROSOUT_DEFAULT = qos_profile_rosout_default

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the short names of all profiles."""
        return [key.lower() for key in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile:
        """Return the profile with a short name, case-insensitively.

        Raises:
            KeyError: No value has this name.
        """
        return cls[name.upper()].value


def qos_policy_name_from_kind(policy_kind: QoSPolicyKind | int) -> str:
    """Return the name of a policy, for example `DURABILITY`.

    Raises:
        ValueError: There is no such policy.
    """
    return QoSPolicyKind(policy_kind).name


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
