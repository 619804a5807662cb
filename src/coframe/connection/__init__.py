# SPDX-License-Identifier: Apache-2.0
"""The connection of a buffer to the ROS graph, and transforms that processes share."""

from coframe.connection.connection import Connection, connect

__all__ = ["Connection", "connect"]
