# SPDX-License-Identifier: Apache-2.0
"""Poses: the class `Transform`, rotations of covariances and resampling of poses over time."""

from coframe.transform.transform import Transform

__all__ = ["Transform"]
