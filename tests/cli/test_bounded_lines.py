# SPDX-License-Identifier: Apache-2.0
"""A terminal gets a limited number of lines per second, and a sentence about the others; a file gets all."""

import os
import subprocess
import sys

import pytest

from coframe._files.bounded_lines import MAX_LINES, LineLimit
from coframe._output.warn_once import LAST_WARNING, MAX_WARNINGS, WarnOnce

REPORT = "... {} more lines not shown, because more than 2000 arrived in a second"
FLOOD = r"""
from coframe.cli.output import warn
warn("\n".join(map(str, range(5_000))))
"""


class Clock:
    now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def limited():
    shown, clock = [], Clock()
    return LineLimit(shown.append, clock), shown, clock


def test_lines_beyond_the_limit_of_a_second_are_counted(limited):
    limit, shown, clock = limited
    for number in range(MAX_LINES + 1234):
        limit(f"line {number}")
    assert shown == [f"line {number}" for number in range(MAX_LINES)]
    clock.now += 1.0
    limit("later")
    assert shown[MAX_LINES:] == [REPORT.format(1234), "later"]
    limit.close()
    assert shown[-1] == "later"


def test_a_message_is_shown_as_a_whole_or_not_at_all(limited):
    limit, shown, _ = limited
    message = "\n".join(["a line"] * 300)
    for _ in range(7):
        limit(message)
    limit("fits")
    assert shown == [message] * 6 + ["fits"]
    limit.close()
    assert shown[-1] == REPORT.format(300)


def test_a_message_that_never_fits_is_cut(limited):
    limit, shown, clock = limited
    limit("\n".join(map(str, range(250_000))))
    assert shown == ["\n".join(map(str, range(MAX_LINES)))]
    clock.now += 1.0
    limit("x" * 1_000_000)
    limit("y" * 1_500_000)
    assert shown[1:] == [REPORT.format(250_000 - MAX_LINES), "x" * 1_000_000]
    limit.close()
    assert shown[-1] == REPORT.format(1)


@pytest.mark.skipif(os.name != "posix", reason="Windows has no pseudo-terminals in Python")
def test_a_flood_of_warnings_in_a_terminal_ends_with_the_number_of_lines_that_are_missing():
    assert run_flood(terminal=True)[-1] == REPORT.format(5_000 - MAX_LINES)
    assert len(run_flood(terminal=False)) == 5_000


def run_flood(*, terminal):
    """Return the lines that a program prints on its standard error, a terminal or a pipe."""
    reader, writer = os.openpty() if terminal else os.pipe()
    with subprocess.Popen([sys.executable, "-c", FLOOD], stderr=writer) as process:
        os.close(writer)
        received = b""
        while part := read(reader):
            received += part
        assert process.wait() == 0
    os.close(reader)
    return received.decode().splitlines()


def read(descriptor):
    try:
        return os.read(descriptor, 65536)
    except OSError:  # Linux reports the end of a terminal as an error.
        return b""


def test_warnings_with_names_of_the_network_end_after_a_limit_with_a_sentence():
    shown = []
    warn = WarnOnce(shown.append)
    for number in range(3 * MAX_WARNINGS):
        warn(f"a warning about node {number}", f"key {number}")
    assert shown[MAX_WARNINGS - 1 :] == [f"a warning about node {MAX_WARNINGS - 1}", LAST_WARNING]
