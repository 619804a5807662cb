# SPDX-License-Identifier: Apache-2.0
"""The programs print what they print on ROS 2 Humble, line by line, except for the intended differences."""

import json

import pytest
from programs import EXPECTED, differences, expected, expected_change

from coframe.distributions import Distribution

PROGRAMS = sorted(json.loads(EXPECTED.read_text(encoding="utf-8")))


def test_each_recorded_program_is_compared(with_ros):
    assert sorted(with_ros) == PROGRAMS


@pytest.mark.parametrize("program", PROGRAMS)
def test_output(with_ros, with_coframe, run_again, program):
    listed, sometimes = expected(program)
    found = differences(with_ros[program], with_coframe[program])
    if not listed.keys() >= set(found):
        found = differences(with_ros[program], run_again(program))
    unlisted = [difference for difference in found if difference not in listed]
    assert not unlisted, "\n\n".join(f"ROS 2:   {ros}\ncoframe: {coframe}" for ros, coframe in unlisted)
    gone = [difference.ros for difference in listed if difference not in {*found, *sometimes}]
    assert not gone, f"these differences no longer occur, remove them from {EXPECTED.name}: {gone}"
    assert all(reason for reason in listed.values())


# Lines that say whether a timer kept its period, and in which order callbacks ran that were ready at the same time.
UNSTEADY = ("ticks ", "rate 10x at ", "['waited', 'async']", "['async', 'waited']")


@pytest.mark.parametrize(
    "distribution",
    [pytest.param(each, marks=pytest.mark.slow) for each in list(Distribution)[1:]],
    ids=lambda each: each.name.lower(),
)
def test_distributions_differ_only_where_the_table_says_so(with_coframe, with_distribution, distribution):
    outputs = with_distribution(distribution.name.lower())
    for program in PROGRAMS:
        found = differences(with_coframe[program], outputs[program])
        assert {each for each in found if not each.ros.startswith(UNSTEADY)} == expected_change(
            program, distribution
        ), program
