# SPDX-License-Identifier: Apache-2.0
"""Implementation modules of rclpy. Users import them only for type annotations."""

from functools import partial

from rclpy import _absent

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
