# SPDX-License-Identifier: Apache-2.0
"""A node for the duration of a command."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any

import rclpy
from ros2cli.node import NODE_NAME_PREFIX

if TYPE_CHECKING:
    import argparse

    from typing_extensions import Self

__all__ = ["DEFAULT_TIMEOUT", "DirectNode", "add_arguments"]

DEFAULT_TIMEOUT = 0.5  # seconds for the discovery of other nodes


class DirectNode:
    """A context manager with a hidden node, whose attributes it has.

    Args:
        args: Arguments with `node_name_suffix`, `spin_time`, `use_sim_time` and `argv`, all of them optional.
        node_name: Name of the node; one with the process ID by default.
    """

    def __init__(self, args: Any, *, node_name: str | None = None) -> None:
        suffix = getattr(args, "node_name_suffix", None) or str(os.getpid())
        seconds = getattr(args, "spin_time", None)
        rclpy.init(args=getattr(args, "argv", None) or [])
        self.node = rclpy.create_node(node_name or f"{NODE_NAME_PREFIX}_{suffix}", start_parameter_services=False)
        if getattr(args, "use_sim_time", False):
            self.node.set_parameters([rclpy.parameter.Parameter("use_sim_time", value=True)])
        time.sleep(DEFAULT_TIMEOUT if seconds is None else seconds)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.node.destroy_node()
        rclpy.try_shutdown()

    def __getattr__(self, name: str) -> Any:
        if name == "node":
            raise AttributeError(name)
        return getattr(self.node, name)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of a direct node to a parser."""
    parser.add_argument("--spin-time", type=float, default=DEFAULT_TIMEOUT, help="seconds to wait for discovery")
    parser.add_argument("-s", "--use-sim-time", action="store_true", help="use the time of /clock")
