# SPDX-License-Identifier: Apache-2.0
"""Which clock stamps are on, and the periods and limits of edges."""

import numpy as np

from coframe.analysis.clocks import clock_of, current_time_for, group_by_clock, is_same_clock
from coframe.analysis.liveness import stale_limit, usual_gap, usual_period
from coframe.time import DAY, HOUR, MILLISECOND, MINUTE, SECOND


def test_stamps_close_to_the_system_time_are_on_the_system_clock():
    assert clock_of(HOUR - MINUTE - 1) == clock_of(MINUTE - HOUR + 1) == "wall"
    assert clock_of(HOUR) == clock_of(-DAY) == "other"


def test_messages_of_a_clock_that_is_an_hour_ahead_arrive_less_than_an_hour_before_their_stamps():
    assert clock_of(-HOUR + 5 * MILLISECOND) == "other"


def test_stamps_close_to_simulated_time_are_simulated():
    assert clock_of(1.7e18, MINUTE - 1) == "simulated"
    assert clock_of(1.7e18, MINUTE) == "other"
    assert clock_of(0.0, MINUTE) == "wall"


def test_spans_are_grouped_by_clock():
    spans = [(DAY, DAY + SECOND), (0, SECOND), (30 * MINUTE, HOUR), (90 * MINUTE, 2 * HOUR), (9 * HOUR, 9 * HOUR)]
    assert group_by_clock(spans) == [[1, 2, 3], [4], [0]]
    assert group_by_clock([]) == []


def test_present_is_known_only_on_the_system_clock():
    now = 1_700_000_000 * SECOND
    assert current_time_for(now - MINUTE, now) == now
    assert current_time_for(5 * SECOND, now) is None
    assert is_same_clock(now, now + MINUTE)


def test_usual_period_is_the_median_between_different_stamps():
    assert usual_period(np.array([], np.int64)) == usual_period(np.array([5])) == usual_period(np.array([5, 5])) == 0.0
    assert usual_period(np.array([30, 10, 20, 20, 1000])) == 10.0


def test_limits_are_vectorized():
    periods = np.array([0.0, 0.02, 0.5, 2.0]) * SECOND
    assert stale_limit(periods).tolist() == [stale_limit(period) for period in periods.tolist()]
    assert (usual_gap(0.02 * SECOND), usual_gap(2.0 * SECOND)) == (SECOND // 2, 20 * SECOND)
