# SPDX-License-Identifier: Apache-2.0
"""The command line of the demo nodes for quality of service."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

import rclpy
from coframe.nodes.program import initialize_rclpy, program
from rclpy.executors import ExternalShutdownException
from rclpy.qos import QoSProfile, ReliabilityPolicy, qos_profile_sensor_data

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

__all__ = ["is_reliable", "run"]


def is_reliable(profile: QoSProfile) -> bool:
    """Return whether messages are sent again until they arrive."""
    return profile.reliability is ReliabilityPolicy.RELIABLE


def run(name: str, make_node: Callable[[QoSProfile], Node], args: list[str] | None) -> None:
    """Run a node for a number of cycles.

    Args:
        name: Name of the program.
        make_node: Creates the node.
        args: Command line without the name, or None for that of the process.
    """
    program(name, args, lambda words, arguments: _run(name, make_node, words, arguments))


def _run(name: str, make_node: Callable[[QoSProfile], Node], words: list[str], arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(name, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
    parser.add_argument("--reliable", action="store_true", help="set the reliability to reliable")
    parser.add_argument("-n", "--number_of_cycles", type=int, default=20, help="number of callbacks until the end")
    given = parser.parse_args(arguments)
    profile = QoSProfile(depth=10) if given.reliable else qos_profile_sensor_data
    try:
        with initialize_rclpy(words, None):
            node = make_node(profile)
            for _ in range(given.number_of_cycles):
                rclpy.spin_once(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
