# SPDX-License-Identifier: Apache-2.0
"""Name under which libraries import upstream's native module. See `rclpy._rclpy_pybind11`."""

from functools import partial

from rclpy import _absent
from rclpy import _rclpy_pybind11 as rclpy_implementation

package = "rclpy"

__all__ = ["package", "rclpy_implementation"]

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
