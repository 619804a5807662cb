# SPDX-License-Identifier: Apache-2.0
"""Warnings that other nodes can cause at any rate."""

from coframe.wire.counted_warning import REPEAT_AFTER, CountedWarning


def test_the_first_warning_is_issued_at_once_and_the_others_are_counted():
    now, lines = 100.0, []
    warn = CountedWarning(lines.append, clock=lambda: now)
    for number in range(1000):
        warn(f"Message {number} is invalid.")
    assert lines == ["Message 0 is invalid."]
    now += REPEAT_AFTER
    warn("Message 1000 is invalid.")
    warn("Message 1001 is invalid.")
    now += REPEAT_AFTER
    warn("Message 1002 is invalid.")
    assert lines[1:] == [
        "Message 1000 is invalid. 999 more since the last warning.",
        "Message 1002 is invalid. 1 more since the last warning.",
    ]
