"""Quality of service: how a publisher and a subscription want their messages delivered."""

from __future__ import annotations

from enum import Enum, IntEnum
from typing import TYPE_CHECKING, Any, Final

from rclpy.duration import Duration
from rclpy.exceptions import RCLError

if TYPE_CHECKING:
    from coframe.wire import QoS as WireQoS
    from typing_extensions import Self


class InvalidQoSProfileException(Exception):
    """A profile is incomplete or contradicts itself."""

    def __init__(self, *args: object) -> None:
        super().__init__("Invalid QoSProfile", *args)


class QoSPolicyKind(IntEnum):
    """Names of the policies."""

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
    """Base of the policies: values have short names such as `keep_last`."""

    @classmethod
    def short_keys(cls) -> list[str]:
        """Returns the short names of all values."""
        return [key.lower() for key in cls.__members__ if not key.startswith("RMW")]

    @classmethod
    def get_from_short_key(cls, name: str) -> int:
        """Returns the value of a short name, in any case.

        Raises:
            KeyError: There is none of this name.
        """
        return cls[name.upper()].value

    @property
    def short_key(self) -> str:
        """The short name."""
        return self.name.lower()


class HistoryPolicy(QoSPolicyEnum):
    """How many messages wait to be sent or taken."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3
    RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT = SYSTEM_DEFAULT
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = KEEP_LAST
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = KEEP_ALL
    RMW_QOS_POLICY_HISTORY_UNKNOWN = UNKNOWN


class ReliabilityPolicy(QoSPolicyEnum):
    """Whether lost messages are sent again."""

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
    """Whether late subscriptions get what was published before."""

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
    """How a publisher shows that it is alive."""

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


class QoSProfile:
    """All policies together; profiles with equal policies are equal.

    History, depth, reliability and durability shape the delivery. Deadline, lifespan and liveliness are kept and
    shown, but nothing is monitored by them.

    Args:
        **kwargs: `history` and/or `depth` (a queue size; needed with KEEP_LAST), `reliability`, `durability`,
            `lifespan`, `deadline`, `liveliness`, `liveliness_lease_duration` (Durations),
            `avoid_ros_namespace_conventions`.

    Raises:
        InvalidQoSProfileException: Neither history nor depth is given, or KEEP_LAST without depth.
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

    def __init__(self, **kwargs: Any) -> None:
        unknown = kwargs.keys() - _POLICIES.keys()
        assert not unknown, f"Invalid arguments passed to constructor: {unknown}"
        if "history" not in kwargs:
            if "depth" not in kwargs:
                raise InvalidQoSProfileException("History and/or depth settings are required.")
            kwargs["history"] = HistoryPolicy.KEEP_LAST
        if kwargs["history"] == HistoryPolicy.KEEP_LAST and "depth" not in kwargs:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        defaults = {
            "depth": 0,
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

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, QoSProfile):
            return False
        return all(getattr(self, policy) == getattr(other, policy) for policy in _POLICIES)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={getattr(self, name)!s}' for name in _POLICIES)})"

    def get_c_qos_profile(self) -> Self:
        """Returns the profile itself; there is no C below."""
        return self

    def _to_wire(self) -> WireQoS:
        from coframe.wire import QoS  # noqa: PLC0415 - profiles work without DDS

        return QoS(
            depth=max(self.depth, 1),
            reliable=self.reliability is not ReliabilityPolicy.BEST_EFFORT,
            transient_local=self.durability is DurabilityPolicy.TRANSIENT_LOCAL,
            keep_all=self.history is HistoryPolicy.KEEP_ALL,
        )


def _checked_property(policy: str, kind: type[Any]) -> property:
    def get(self: QoSProfile) -> Any:
        return getattr(self, f"_{policy}")

    def set_(self: QoSProfile, value: Any) -> None:
        accepted = int if issubclass(kind, IntEnum) else kind
        assert isinstance(value, accepted), f"{policy} must be of type {kind.__name__}, not {type(value).__name__}"
        assert policy != "depth" or value >= 0, f"depth must not be negative, got {value}"
        object.__setattr__(self, f"_{policy}", kind(value) if issubclass(kind, IntEnum) else value)

    return property(get, set_, doc=f"The policy `{policy}`.")


for _policy, _kind in _POLICIES.items():
    setattr(QoSProfile, _policy, _checked_property(_policy, _kind))


def qos_from(qos: QoSProfile | int) -> QoSProfile:
    """Returns the profile, or KEEP_LAST with the given depth.

    Raises:
        TypeError: It is neither a profile nor a number.
        ValueError: The depth is negative.
    """
    if isinstance(qos, QoSProfile):
        return qos
    if not isinstance(qos, int) or isinstance(qos, bool):
        raise TypeError(f"Expected QoSProfile or int, but received {type(qos)!r}")
    if qos < 0:
        raise ValueError("history depth must be greater than or equal to zero")
    return QoSProfile(depth=qos)


qos_profile_default: Final = QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=10)
qos_profile_unknown: Final = QoSProfile(
    history=HistoryPolicy.UNKNOWN,
    reliability=ReliabilityPolicy.UNKNOWN,
    durability=DurabilityPolicy.UNKNOWN,
    liveliness=LivelinessPolicy.UNKNOWN,
)
qos_profile_system_default: Final = QoSProfile(
    history=HistoryPolicy.SYSTEM_DEFAULT,
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
)


class QoSPresetProfiles(Enum):
    """The profiles with a name of their own."""

    UNKNOWN = qos_profile_unknown
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available

    @classmethod
    def short_keys(cls) -> list[str]:
        """Returns the short names of all profiles."""
        return [key.lower() for key in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile:
        """Returns the profile of a short name, in any case.

        Raises:
            KeyError: There is none of this name.
        """
        return cls[name.upper()].value


class QoSCompatibility(IntEnum):
    """Whether a publisher and a subscription will meet."""

    OK = 0
    WARNING = 1
    ERROR = 2


def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> tuple[QoSCompatibility, str]:
    """Returns whether messages can flow, and if not, why.

    Args:
        publisher_qos: What the publisher offers.
        subscription_qos: What the subscription requests.

    Raises:
        RCLError: An argument is no QoSProfile.
    """
    if not isinstance(publisher_qos, QoSProfile) or not isinstance(subscription_qos, QoSProfile):
        raise RCLError("qos_check_compatible() needs two QoSProfiles")
    reasons = []
    if (
        publisher_qos.reliability is ReliabilityPolicy.BEST_EFFORT
        and subscription_qos.reliability is ReliabilityPolicy.RELIABLE
    ):
        reasons.append("ERROR: Best effort publisher and reliable subscription;")
    if (
        publisher_qos.durability is DurabilityPolicy.VOLATILE
        and subscription_qos.durability is DurabilityPolicy.TRANSIENT_LOCAL
    ):
        reasons.append("ERROR: Volatile publisher and transient local subscription;")
    return (QoSCompatibility.ERROR if reasons else QoSCompatibility.OK), "".join(reasons)
