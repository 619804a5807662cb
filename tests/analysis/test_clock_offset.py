# SPDX-License-Identifier: Apache-2.0
"""The offset of a clock, its spread and its drift; SciPy is the judge of the drift."""

import numpy as np
import pytest

from coframe.analysis.clock_offset import clock_offset

MS = 1_000_000
SECOND = 1_000_000_000
START = 1_700_000_000_000_000_000


def lags(seconds, rate, offset, drift, spread, seed=0):
    """Return delays in nanoseconds with latency that varies upward, as in networks, and the times of arrival."""
    random = np.random.default_rng(seed)
    arrived = START + (np.arange(int(seconds * rate)) * (SECOND / rate)).astype(np.int64)
    noise = random.exponential(spread, len(arrived))
    return (offset + noise + (arrived - START) * drift * 1e-6).astype(np.int64), arrived


@pytest.mark.parametrize("drift", [12.0, -40.0, 150.0])
@pytest.mark.parametrize(("seconds", "rate"), [(60, 50), (120, 20), (600, 10)])
def test_the_drift_is_that_of_scipy(drift, seconds, rate):
    delays, arrived = lags(seconds, rate, 3600.003 * SECOND, drift, 0.2 * MS)
    found = clock_offset(delays, arrived)
    some = slice(None, None, -(-len(delays) // 1000))
    stats = pytest.importorskip("scipy.stats")  # Imported here because that takes a second.
    slope = stats.theilslopes((delays[some] - delays[0]).astype(float), (arrived[some] - START).astype(float))[0]
    assert found.drift == pytest.approx(slope * 1e6, rel=0.1)
    assert found.drift == pytest.approx(drift, rel=0.1)
    assert found.offset == pytest.approx(np.median(delays), abs=1)
    assert f", drift {found.drift:.3g} ppm" in found.size


@pytest.mark.parametrize("seed", range(20))
def test_noise_is_no_drift(seed):
    """Also a recording that is too short to show a drift has none."""
    assert clock_offset(*lags(60, 50, 5 * SECOND, 0.0, 0.5 * MS, seed)).drift is None
    assert clock_offset(*lags(3, 50, 5 * SECOND, 12.0, 0.5 * MS, seed)).drift is None


def test_a_step_of_the_clock_is_no_drift():
    delays, arrived = lags(60, 50, 5 * SECOND, 0.0, 0.1 * MS)
    delays[1500:] += 10 * MS
    assert clock_offset(delays, arrived).drift is None


def test_outliers_do_not_change_offset_and_spread():
    delays, arrived = lags(60, 50, 5 * SECOND, 0.0, 0.2 * MS)
    right = clock_offset(delays, arrived)
    delays[::7] += 3 * SECOND
    found = clock_offset(delays, arrived)
    assert found.offset == pytest.approx(right.offset, abs=0.1 * MS)
    assert found.spread < 2 * right.spread


def test_few_delays_and_directions():
    one = clock_offset(np.array([-20 * MS]), np.array([START]))
    assert (one.size, one.direction, one.drift) == ("20 ms +-0 ns", "ahead of", None)
    same = clock_offset(np.full(100, SECOND), np.full(100, START))
    assert (same.size, same.direction) == ("1.000 s +-0 ns", "behind")
