# SPDX-License-Identifier: Apache-2.0
"""A container whose nodes share an executor with several threads."""

from __future__ import annotations

from coframe.nodes.program import program
from rclpy.executors import MultiThreadedExecutor
from rclpy_components._running import run_container

__all__ = ["main"]


def main(args: list[str] | None = None) -> None:
    """Run the container until shutdown."""
    program("component_container_mt", args, lambda words, _: run_container(MultiThreadedExecutor, words))


if __name__ == "__main__":
    main()
