# SPDX-License-Identifier: Apache-2.0
"""The distributions of ROS 2: which one this process follows, and every difference between them that coframe has.

`docs/reference/distributions.md` is generated from the tables of this module by ``scripts/generate_distributions.py``.
"""

from __future__ import annotations

import os
import sys
from enum import IntEnum
from functools import cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = [
    "BEHAVIORS",
    "DEFAULT",
    "DEFINITIONS",
    "NAMES",
    "REMOVED",
    "VARIABLES",
    "Behavior",
    "Definition",
    "Distribution",
    "RemovedInterface",
    "current",
    "follows",
    "hide_removed_types",
    "removal",
    "selected",
    "since",
]


class Distribution(IntEnum):
    """A distribution of ROS 2. Later ones are greater."""

    HUMBLE = 1
    JAZZY = 2
    KILTED = 3
    LYRICAL = 4

    @property
    def title(self) -> str:
        """The name as in a text: "Jazzy"."""
        return self.name.capitalize()


_HUMBLE, _JAZZY, _KILTED, _LYRICAL = Distribution
DEFAULT: Final = _JAZZY
VARIABLES: Final = ("COFRAME_DISTRO", "ROS_DISTRO")
"""The environment variables that select the distribution; the first one that is set applies."""

# Other names that ROS_DISTRO may have, with the distribution that is closest to each.
_CLOSEST_SUPPORTED = {"foxy": _HUMBLE, "galactic": _HUMBLE, "iron": _JAZZY, "rolling": _LYRICAL}
NAMES: Final[Mapping[str, Distribution]] = {each.name.lower(): each for each in Distribution} | _CLOSEST_SUPPORTED
"""The distributions by all names that the environment variables may have."""


class Definition(NamedTuple):
    """A definition of an interface that differs between distributions.

    Attributes:
        since: The first distribution that has it in its newer form.
        what: What the newer form adds or changes.
    """

    since: Distribution
    what: str


class RemovedInterface(NamedTuple):
    """An interface that a distribution no longer has.

    Attributes:
        since: The first distribution without it.
        instead: What to use in its place, as a sentence.
    """

    since: Distribution
    instead: str


class Behavior(NamedTuple):
    """A behavior that differs between distributions.

    Attributes:
        what: What differs.
        since: The first distribution with the newer behavior.
        before: The behavior of the distributions before it.
        after: The behavior from then on.
    """

    what: str
    since: Distribution
    before: str
    after: str


DEFINITIONS: Final[Mapping[str, Definition]] = {
    "controller_manager_msgs/msg/ControllerState": Definition(_JAZZY, "`exported_state_interfaces`"),
    "controller_manager_msgs/msg/HardwareComponentState": Definition(_JAZZY, "`plugin_name`"),
    "controller_manager_msgs/srv/SwitchController": Definition(
        _JAZZY, "without `start_controllers`, `stop_controllers` and `start_asap`"
    ),
    "rcl_interfaces/msg/Log": Definition(_JAZZY, "the constants are `uint8`, not `byte`: 10 instead of `b'\\n'`"),
    "rmw_dds_common/msg/Gid": Definition(_JAZZY, "16 bytes instead of 24"),
    "rosbag2_interfaces/msg/ReadSplitEvent": Definition(_JAZZY, "`node_name`"),
    "rosbag2_interfaces/msg/WriteSplitEvent": Definition(_JAZZY, "`node_name`"),
    "sensor_msgs/msg/BatteryState": Definition(
        _JAZZY, "`POWER_SUPPLY_TECHNOLOGY_TERNARY`, `POWER_SUPPLY_TECHNOLOGY_VRLA`"
    ),
    "sensor_msgs/msg/NavSatStatus": Definition(
        _JAZZY, "`STATUS_UNKNOWN`, `SERVICE_UNKNOWN`; the default of `status` is -2 instead of 0"
    ),
    "sensor_msgs/msg/Range": Definition(_JAZZY, "`variance`"),
    "visualization_msgs/msg/Marker": Definition(_JAZZY, "`ARROW_STRIP`"),
    "lifecycle_msgs/msg/TransitionEvent": Definition(
        _LYRICAL, "`stamp` (`builtin_interfaces/Time`) instead of `timestamp` (`uint64`)"
    ),
    "sensor_msgs/msg/PointField": Definition(_LYRICAL, "`INT64`, `UINT64`, `BOOL`"),
}
"""The definitions that differ, by type. `interfaces` has those of the default distribution."""

REMOVED: Final[Mapping[str, RemovedInterface]] = {
    "turtlesim/": RemovedInterface(_KILTED, "They are in the package turtlesim_msgs."),
    "actionlib_msgs/": RemovedInterface(_LYRICAL, "Use action_msgs."),
    "geometry_msgs/msg/Pose2D": RemovedInterface(_LYRICAL, "Use geometry_msgs/msg/Pose, or define your own message."),
}
"""What distributions no longer have, by type, or by package with a slash at its end."""

BEHAVIORS: Final[Mapping[str, Behavior]] = {
    "short_identifiers": Behavior(
        "identifiers in `ros_discovery_info`, if no other participant or both forms are in the domain",
        _JAZZY,
        "24 bytes",
        "16 bytes",
    ),
    "comparisons": Behavior(
        "`Time` or `Duration` compared with an object of another class (`== None`)", _JAZZY, "`TypeError`", "not equal"
    ),
    "exception_texts": Behavior(
        "texts of `ParameterException`, its subclasses and `NotInitializedException`",
        _JAZZY,
        "`('Invalid access to undeclared parameter(s)', 'rate')`",
        "`Invalid access to undeclared parameter(s): rate`",
    ),
    "message_numbers": Behavior(
        "information on a message for a callback with two arguments",
        _JAZZY,
        "two timestamps",
        "also `publication_sequence_number` and `reception_sequence_number`, which are None",
    ),
    "message_publisher": Behavior(
        "`publisher_gid` in this information", _KILTED, "absent", "the identifier of the publisher"
    ),
    "type_descriptions": Behavior(
        "the service `~/get_type_description` of nodes, and their parameter `start_type_description_service`",
        _JAZZY,
        "absent",
        "present",
    ),
    "field_conversions": Behavior(
        "NumPy's arrays and numbers, integers for `float32` and `float64`, and iterables as values of message fields",
        _JAZZY,
        "`AssertionError`",
        "converted; `ROS_PYTHON_CHECK_FIELDS=1` makes them an `AssertionError`",
    ),
    "endpoint_information": Behavior(
        "information on publishers and subscriptions, including that of `topic info --verbose`",
        _JAZZY,
        "no type hash in the text; identifiers of 24 bytes",
        "the type hash in the text; identifiers of 16 bytes",
    ),
    "bag_filter": Behavior(
        "positional arguments of `rosbag2_py.StorageFilter`",
        _JAZZY,
        "`topics`, `topics_regex`, `topics_regex_to_exclude`",
        "`topics`, `services_events`, `regex`, `exclude_topics`, `exclude_service_events`, `regex_to_exclude`",
    ),
    "bag_storage": Behavior(
        "storage of recordings that `rosbag2_py` writes without a `storage_id`", _JAZZY, "`sqlite3`", "`mcap`"
    ),
    "call_timeout": Behavior(
        "no response to `Client.call(request, timeout_sec=...)` in time", _KILTED, "returns None", "`TimeoutError`"
    ),
}
"""The behaviors that differ, by the key that :func:`since` takes."""


def selected(environment: Mapping[str, str]) -> Distribution:
    """Return the distribution that environment variables select, the default if none does.

    A name that is unknown is ignored, with a warning on stderr.
    """
    for variable in VARIABLES:
        name = environment.get(variable, "").strip().lower()
        if name in NAMES:
            return NAMES[name]
        if name:
            sys.stderr.write(f"{_unknown_name_text(variable, name)}\n")
    return DEFAULT


def _unknown_name_text(variable: str, name: str) -> str:
    known = ", ".join(sorted(NAMES))
    return f"{variable}={name[:40]!r} is not a known distribution of ROS 2, and is ignored. Known names: {known}."


@cache
def current() -> Distribution:
    """Return the distribution that this process follows. The environment is read once."""
    return selected(os.environ)


def follows(variant: str) -> bool:
    """Return whether this process has the definitions in the folder of a distribution, in place of the default ones.

    Args:
        variant: The name of a folder in `distributions`, such as ``humble``. The folder of a distribution before the
            default one is also for all before it, the folder of a later one also for all after it.
    """
    distribution = NAMES[variant]
    return current() <= distribution if distribution < DEFAULT else current() >= distribution


def since(key: str) -> bool:
    """Return whether this process has the newer form of a behavior of `BEHAVIORS`."""
    return current() >= BEHAVIORS[key].since


def removal(ros_type: str) -> str:
    """Return why this process does not have a type that other distributions have, or "" if it has it."""
    package = ros_type.partition("/")[0] + "/"
    for name, kind in ((ros_type, ""), (package, "interfaces of ")):
        removed = REMOVED.get(name)
        if removed is not None and current() >= removed.since:
            return (
                f"ROS 2 {removed.since.title} and later do not have {kind}{name.rstrip('/')}, and this process follows "
                f"{current().title}. {removed.instead} To follow another distribution, set COFRAME_DISTRO."
            )
    return ""


def hide_removed_types(module: dict[str, Any], package: str, kind: str) -> None:
    """Remove the types that this distribution does not have from the module of a ROS package.

    Args:
        module: The names of the module, which `__all__` lists; importing one of those removed raises `ImportError`.
        package: The name of the ROS package, such as ``geometry_msgs``.
        kind: ``msg``, ``srv`` or ``action``.
    """
    reasons = {name: reason for name in module["__all__"] if (reason := removal(f"{package}/{kind}/{name}"))}
    if not reasons:
        return

    def get(name: str) -> Any:
        if name in reasons:
            raise ImportError(reasons[name])
        raise AttributeError(f"module {module['__name__']!r} has no attribute {name!r}")

    for name in reasons:
        module["__all__"].remove(name)
        del module[name]
    module["__getattr__"] = get
