# SPDX-License-Identifier: Apache-2.0
"""Containers that load composable nodes in Python into one process."""

from rclpy_components.component_manager import ComponentManager

__all__ = ["ComponentManager"]
