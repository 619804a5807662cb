# SPDX-License-Identifier: Apache-2.0
"""A buffer that is connected to the ROS graph, the transforms that it publishes and those that processes share."""

from coframe.connection.connection import Connection, connect

__all__ = ["Connection", "connect"]
