# SPDX-License-Identifier: Apache-2.0
"""Random operations on coframe and on the real tf2 of ROS 1, in one sequence per buffer, with all answers compared.

ROS 1 differs from ROS 2 by rules, which are data (rules.py); script.py describes how buffers that differ are
compared.
"""

import time

import pytest
from real_tf2.coframe_side import CoframeSide
from real_tf2.comparison import Debian, run
from real_tf2.rules import REASONS


@pytest.fixture(scope="module")
def debian():
    if not Debian.is_there():
        pytest.skip("Debian's tf2 is not installed (apt-get install python3-tf2-ros)")
    debian = Debian()
    yield debian
    debian.close()


@pytest.mark.timeout(600)
def test_coframe_answers_as_the_real_tf2(debian):
    explained, finding = run(debian, seed="coframe", operations=60_000)
    assert finding is None, finding
    assert [reason for reason in REASONS if not explained[reason]] == [], "rules that have explained nothing"


@pytest.mark.long
@pytest.mark.timeout(3 * 3600)
def test_coframe_answers_as_the_real_tf2_for_long(debian):
    seed = time.time_ns()
    print("seed", seed)
    explained, finding = run(debian, seed, operations=10_000_000)
    assert finding is None, finding
    assert [reason for reason in REASONS if not explained[reason]] == [], "rules that have explained nothing"


class FaultySide(CoframeSide):
    """coframe with a small error."""

    def __init__(self, cache):
        super().__init__(cache)
        self.cache = cache
        self.stamps = {}  # of the dynamic samples of each child


class PrunesAfter(FaultySide):
    def set(self, *operation):
        answer = super().set(*operation)
        super().set(*operation)  # a repetition: only prunes
        return answer


class RefusesTheEdge(FaultySide):
    def set(self, parent, child, stamp, values, static, authority):
        newest = max(self.stamps.setdefault(child, []), default=stamp)
        if not static and self.cache and stamp == newest - self.cache:
            stamp -= 1
        elif not static:
            self.stamps[child].append(stamp)
        return super().set(parent, child, stamp, values, static, authority)


class KeepsTheFirstOfEqualStamps(FaultySide):
    def set(self, parent, child, stamp, values, static, authority):
        if not static and stamp in self.stamps.setdefault(child, []):
            return "log", ()
        self.stamps[child] = [] if static else [*self.stamps.get(child, []), stamp]
        return super().set(parent, child, stamp, values, static, authority)


class ForgetsNothingOnFlips(FaultySide):
    def set(self, *operation):
        *values, _, authority = operation
        return super().set(*values, False, authority)


class IsOff(FaultySide):
    def lookup(self, *asked):
        tag, stamp, (x, *others) = super().lookup(*asked)
        return tag, stamp, (x + 1e-9, *others)


class TurnsQuaternions(FaultySide):
    def lookup_full(self, *asked):
        tag, stamp, (x, y, z, *q) = super().lookup_full(*asked)
        return tag, stamp, (x, y, z, q[1], q[0], *q[2:])


class HasAnotherStamp(FaultySide):
    def latest_common_time(self, *asked):
        tag, stamp = super().latest_common_time(*asked)
        return tag, stamp + 1


class TruncatesErrorTexts(FaultySide):
    def answer(self, operation):
        tag, *details = super().answer(operation)
        return (tag, details[0], details[1].rstrip()) if tag == "raises" else (tag, *details)


class NamesInOrder(FaultySide):
    def frame_names(self):
        tag, names = super().frame_names()
        return tag, sorted(names)


@pytest.mark.parametrize("make_side", FaultySide.__subclasses__())
def test_small_errors_are_detected(debian, make_side):
    _, finding = run(debian, seed="coframe", operations=20_000, make_side=make_side)
    assert finding
