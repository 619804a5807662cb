# SPDX-License-Identifier: Apache-2.0
"""Unit conversion factors."""

from coframe.time import SECOND

S_TO_NS = SECOND
