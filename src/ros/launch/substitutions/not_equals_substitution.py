# SPDX-License-Identifier: Apache-2.0
"""The substitution NotEqualsSubstitution."""

from launch.substitutions.equals_substitution import NotEqualsSubstitution

__all__ = ["NotEqualsSubstitution"]
