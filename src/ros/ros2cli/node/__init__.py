# SPDX-License-Identifier: Apache-2.0
"""The nodes of commands."""

NODE_NAME_PREFIX = "_ros2cli"

__all__ = ["NODE_NAME_PREFIX"]
