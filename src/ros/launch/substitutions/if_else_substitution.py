# SPDX-License-Identifier: Apache-2.0
"""The substitution IfElseSubstitution."""

from launch.substitutions.boolean_substitution import IfElseSubstitution

__all__ = ["IfElseSubstitution"]
