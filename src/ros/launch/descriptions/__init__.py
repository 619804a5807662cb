# SPDX-License-Identifier: Apache-2.0
"""Descriptions of processes that actions start."""

from launch.descriptions.executable import Executable

__all__ = ["Executable"]
