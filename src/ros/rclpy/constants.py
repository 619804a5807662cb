# SPDX-License-Identifier: Apache-2.0
"""Unit conversion factors."""

from functools import partial

from coframe.time import SECOND
from rclpy import _absent

S_TO_NS = SECOND

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
