# SPDX-License-Identifier: Apache-2.0
"""What `coframe echo` prints about names that other nodes chose."""

import click
import pytest

import coframe
from coframe.cli import echo

_NAME = "\x1b[2Jbase"


def test_escape_sequences_in_frame_names_do_not_reach_the_terminal(capsys):
    buffer = coframe.Buffer(None)
    buffer.set(_NAME, "lidar", coframe.Transform(), 1)
    assert not echo._print_answer(buffer, _NAME, "camera", 0, echo.as_json_line)
    assert echo._print_answer(buffer, _NAME, "lidar", 0, echo.as_json_line)

    class StopError(Exception):
        pass

    class Connection:
        def __init__(self):
            self.buffer = buffer

        def awaited_statics(self):
            if self.asked:
                raise StopError
            self.asked = True
            return [_NAME]

        asked = False

    with pytest.raises(StopError):
        echo._wait_for_transform(Connection(), _NAME, "camera", 1)
    printed, errors = capsys.readouterr()
    for text in (printed, errors):
        assert "\x1b" not in text
        assert "[2Jbase" in text


def test_a_number_that_no_float_can_hold_is_refused(capsys):
    with pytest.raises(click.exceptions.Exit):
        echo._check_positive("Precision", 10**400, echo.MAX_DIGITS)
    assert "Precision must be at most 17, not 10000000000000000000\n" in capsys.readouterr().err
