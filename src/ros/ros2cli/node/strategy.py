# SPDX-License-Identifier: Apache-2.0
"""The node that a command uses. ros2cli asks its daemon if there is one. coframe has no daemon."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.node.direct import DirectNode
from ros2cli.node.direct import add_arguments as add_direct_arguments

if TYPE_CHECKING:
    import argparse

__all__ = ["NodeStrategy", "add_arguments"]


class NodeStrategy(DirectNode):
    """A context manager with a node. See `DirectNode`."""

    @property
    def direct_node(self) -> NodeStrategy:
        """The node itself."""
        return self


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of a node to a parser."""
    add_direct_arguments(parser)
    parser.add_argument("--no-daemon", action="store_true", help="has no effect")
