# SPDX-License-Identifier: Apache-2.0
import asyncio
import datetime
from types import SimpleNamespace

import numpy as np
import pytest

import coframe
from coframe.time import SECOND, duration_ns, stamp_ns


@pytest.mark.parametrize(
    ("written", "nanoseconds"),
    [
        ("100ms", 100_000_000),
        ("1.5 s", 1_500_000_000),
        ("3us", 3_000),
        ("2min", 120_000_000_000),
        ("7ns", 7),
        (0, 0),
        (-7, -7),
        (100_000, 100_000),
        (np.int64(700_000), 700_000),
        (np.timedelta64(7, "ns"), 7),
        (SimpleNamespace(nanoseconds=7), 7),
        (SimpleNamespace(sec=0, nanosec=7), 7),
        (datetime.timedelta(milliseconds=2), 2_000_000),
        (np.timedelta64(5, "ms"), 5_000_000),
    ],
)
def test_durations(written, nanoseconds):
    assert duration_ns(written) == nanoseconds


@pytest.mark.parametrize("written", ["100", "ms", "1 fortnight", "", "-1s"])
def test_text_that_is_not_a_duration(written):
    with pytest.raises(ValueError, match="is not a duration"):
        duration_ns(written)


def test_float_seconds_are_refused():
    with pytest.raises(TypeError, match=r'not float. For 0.1 seconds, write "0.1s".'):
        duration_ns(0.1)
    with pytest.raises(TypeError, match=r"float of seconds.*1_500_000_000"):
        stamp_ns(0.1)


@pytest.mark.parametrize(
    ("seconds", "written"), [(2.0, "2s"), (1e-6, "0.000001s"), (0.25, "0.25s"), (3600.5, "3600.5s")]
)
def test_the_spelling_for_float_seconds_is_the_same_duration(seconds, written):
    with pytest.raises(TypeError, match=f'write "{written}"'):
        duration_ns(seconds)
    assert duration_ns(written) == round(seconds * SECOND)


@pytest.mark.parametrize("number", [float("nan"), float("inf")])
def test_floats_that_are_no_duration(number):
    with pytest.raises(TypeError, match="is not a duration"):
        duration_ns(number)


@pytest.mark.parametrize("number", [1, 2, 999, 86_400, np.int64(10)])
def test_small_ints_are_refused_with_the_right_spellings(number):
    with pytest.raises(ValueError, match="has no unit") as caught:
        duration_ns(number)
    assert f'"{number}s" or {int(number):_}_000_000_000' in str(caught.value)
    assert f'"{number}ns"' in str(caught.value)


@pytest.mark.parametrize(
    "call",
    [
        lambda _: coframe.Buffer(cache=10),
        lambda buffer: buffer.lookup("odom", "base", timeout=10),
        lambda buffer: buffer.lookup("odom", "base", extrapolate=10),
        lambda buffer: buffer.lookup_many("odom", "base", [5], extrapolate=10),
        lambda buffer: buffer.can_transform("odom", "base", timeout=10),
        lambda buffer: buffer.wait("odom", "base", timeout=10),
        lambda buffer: asyncio.run(buffer.wait_async("odom", "base", timeout=10)),
    ],
)
def test_the_buffer_refuses_small_ints_as_durations(call):
    with pytest.raises(ValueError, match='"10s" or 10_000_000_000'):
        call(coframe.Buffer())


def test_stamps():
    moment = datetime.datetime(2026, 1, 2, 3, 4, 5, 678901, tzinfo=datetime.timezone.utc)
    nanoseconds = 1_767_323_045_678_901_000
    assert stamp_ns(moment) == nanoseconds
    assert stamp_ns(np.datetime64("2026-01-02T03:04:05.678901")) == nanoseconds
    with pytest.raises(ValueError, match="time zone"):
        stamp_ns(moment.replace(tzinfo=None))


@pytest.mark.parametrize("read", [stamp_ns, duration_ns])
def test_values_that_do_not_fit_64_bits(read):
    assert read(2**63 - 1) == 2**63 - 1
    with pytest.raises(ValueError, match="does not fit into 64 bits"):
        read(2**63)


def test_text_that_does_not_fit_64_bits():
    with pytest.raises(ValueError, match="does not fit into 64 bits"):
        duration_ns("9999999h")
