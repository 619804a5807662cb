# SPDX-License-Identifier: Apache-2.0
"""The error of a substitution that cannot be performed."""

__all__ = ["SubstitutionFailure"]


class SubstitutionFailure(RuntimeError):
    """A substitution cannot be performed."""
