# SPDX-License-Identifier: Apache-2.0
"""Poses: the class `Transform`, covariances, and resampling of poses over time."""

from coframe.transform._covariance import Ellipsoid
from coframe.transform.transform import Transform

__all__ = ["Ellipsoid", "Transform"]
