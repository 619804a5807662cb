# SPDX-License-Identifier: Apache-2.0
"""Run the node of a container until shutdown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.nodes.program import initialize_rclpy
from rclpy.executors import ExternalShutdownException
from rclpy_components.component_manager import ComponentManager

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.executors import Executor

__all__ = ["run_container"]


def run_container(make_executor: Callable[[], Executor], args: list[str]) -> None:
    """Run a container whose nodes share an executor.

    Args:
        make_executor: Creates the executor.
        args: Command line with ``--ros-args``.
    """
    try:
        with initialize_rclpy(args, None):
            executor = make_executor()
            ComponentManager.in_executor(executor)
            executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
