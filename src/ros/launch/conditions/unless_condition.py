# SPDX-License-Identifier: Apache-2.0
"""The condition UnlessCondition."""

from launch.conditions.if_condition import UnlessCondition

__all__ = ["UnlessCondition"]
