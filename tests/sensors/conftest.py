# SPDX-License-Identifier: Apache-2.0
"""Fixtures: a moving sensor and its points."""

import numpy as np
import pytest
from sensor_data import Motion

import coframe


@pytest.fixture
def buffer():
    return coframe.Buffer(None)


@pytest.fixture
def motion(buffer):
    return Motion().fill(buffer)


@pytest.fixture
def random():
    return np.random.default_rng(1)
