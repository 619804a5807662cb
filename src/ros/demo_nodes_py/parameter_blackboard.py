# SPDX-License-Identifier: Apache-2.0
"""A node that stores any parameter which is given to it."""

from __future__ import annotations

from coframe.nodes.program import program, spin_until_shutdown
from rclpy.node import Node

__all__ = ["ParameterBlackboard", "main"]


class ParameterBlackboard(Node):
    """Has all parameters that its arguments or other nodes set."""

    def __init__(self) -> None:
        super().__init__(
            "parameter_blackboard",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
        count = len(self.list_parameters([], 0).names)
        self.get_logger().info(
            f"Parameter blackboard node named '{self.get_fully_qualified_name()}' ready, "
            f"and serving '{count}' parameters already!"
        )


def main(args: list[str] | None = None) -> None:
    """Run the node until shutdown."""
    program("parameter_blackboard", args, lambda words, _: spin_until_shutdown(ParameterBlackboard, words, None))


if __name__ == "__main__":
    main()
