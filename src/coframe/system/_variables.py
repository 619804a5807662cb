# SPDX-License-Identifier: Apache-2.0
"""The environment variables of ROS 2 and its middlewares, and their effect in coframe."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

_EFFECTS: Final = {
    "AMENT_PREFIX_PATH": "folders of a sourced ROS 2, with its packages, interfaces and DDS library",
    "COFRAME_DDS_LIBRARY": "the DDS library file; no other place is searched",
    "COFRAME_DISTRO": "selects the ROS 2 distribution that coframe follows, with priority over ROS_DISTRO",
    "COFRAME_ROS2_WIRE": "how coframe.ros2 receives transforms in a sourced ROS 2: native or rclpy",
    "COFRAME_SHARED": "1: listeners of tf2_ros share the transforms with the other processes of this user",
    "COFRAME_WIRE": "the middleware: dds, zenoh, or fastdds where coframe-fastdds is installed",
    "COFRAME_PACKAGE_PATH": "folders with the sources of ROS packages",
    "CYCLONEDDS_HOME": "an installation of Cyclone DDS, which is searched for the DDS library together with the "
    "system's",
    "CYCLONEDDS_URI": "configuration of Cyclone DDS; it overrides what coframe derives from the other variables",
    "RMW_IMPLEMENTATION": "selects the middleware of ROS 2's own nodes; rmw_zenoh_cpp also selects Zenoh for coframe, "
    "and rmw_fastrtps_cpp Fast DDS where coframe-fastdds is installed",
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "the range of discovery: OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT",
    "ROS_DISCOVERY_SERVER": "nodes on Fast DDS announce themselves only at this server; coframe uses it on Fast DDS, "
    "and otherwise does not find them",
    "ROS_DISTRO": "selects the ROS 2 distribution whose message definitions and behavior coframe follows",
    "ROS_DOMAIN_ID": "the domain; only processes in the same domain find each other",
    "ROS_HOME": "the folder of ROS's files, such as log files",
    "ROS_LOCALHOST_ONLY": "1: communicate only on this machine, with priority over ROS_AUTOMATIC_DISCOVERY_RANGE; 0: "
    "on the local network",
    "ROS_LOG_DIR": "the folder of log files",
    "ROS_PYTHON_CHECK_FIELDS": "whether the types of message fields are checked when they are set",
    "ROS_STATIC_PEERS": "hosts that are contacted without multicast",
    "ZENOH_CONFIG_OVERRIDE": "individual values of the configuration of Zenoh sessions and routers",
    "ZENOH_ROUTER_CHECK_ATTEMPTS": "how often a starting process checks for a Zenoh router",
    "ZENOH_ROUTER_CONFIG_URI": "the configuration file of coframe router",
    "ZENOH_SESSION_CONFIG_URI": "the configuration file of Zenoh sessions",
}
_PREFIXES: Final = {
    "FASTRTPS_": "configures nodes on Fast DDS, including those of coframe",
    "FASTDDS_": "configures nodes on Fast DDS, including those of coframe",
    "RMW_FASTRTPS_": "configures nodes on Fast DDS, including those of coframe",
    "ROS_SECURITY_": "the security of DDS, which coframe has on Fast DDS only; elsewhere, Enforce is refused",
    "ZENOH_": "no effect on coframe",
    "COFRAME_": "unknown to coframe",
    "CYCLONEDDS_": "no effect on coframe",
    "RMW_": "no effect on coframe",
    "ROS_": "no effect on coframe",
}


@dataclass(frozen=True)
class Variable:
    """An environment variable that is set.

    Attributes:
        name: The name of the variable, such as ``ROS_DOMAIN_ID``.
        value: The value as text.
        effect: Its effect in coframe.
    """

    name: str
    value: str
    effect: str


def variables(environment: Mapping[str, str]) -> list[Variable]:
    """Return the variables of ROS 2, its middlewares and coframe that are set, sorted by name."""
    found = []
    for name in sorted(environment):
        effect = _EFFECTS.get(name) or next((text for start, text in _PREFIXES.items() if name.startswith(start)), None)
        if effect and environment[name]:
            found.append(Variable(name, environment[name], effect))
    return found
