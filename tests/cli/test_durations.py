# SPDX-License-Identifier: Apache-2.0
"""Every option that is a duration accepts the same forms, and refuses others with the same sentence."""

import pytest
import typer
from typer.main import get_command
from typer.testing import CliRunner

from coframe.cli.app import app
from coframe.cli.options import DURATIONS, Duration, NonNegativeDuration, PositiveDuration
from coframe.time import duration_ns


def duration_options():
    """Yield the words of each command, and the names of its options that are durations."""
    pending = [((), get_command(app))]
    while pending:
        words, command = pending.pop()
        pending += [((*words, name), each) for name, each in getattr(command, "commands", {}).items()]
        for option in command.params:
            if option.metavar == "DURATION":
                yield words, option.opts[-1]
            assert option.metavar != "SECONDS" or option.name == "at", f"{words} {option.opts} is not a duration"


def test_the_same_sentence_in_every_command():
    options = list(duration_options())
    assert len(options) > 30
    for words, option in options:
        result = CliRunner().invoke(app, [*words, option, "3 parsecs"])
        assert result.exit_code == 2, (words, option)
        assert f"'3 parsecs' is not a duration. {DURATIONS}" in " ".join(result.output.split()), (words, option)


@pytest.mark.parametrize(
    ("text", "nanoseconds"),
    [
        ("3", 3_000_000_000),
        ("3s", 3_000_000_000),
        ("0.5", 500_000_000),
        ("500ms", 500_000_000),
        ("+1.5 h", 5400 * 10**9),
    ],
)
def test_the_forms_of_a_duration(text, nanoseconds):
    for kind in (Duration, NonNegativeDuration, PositiveDuration):
        assert kind(text) == duration_ns(kind(text)) == nanoseconds
        assert (str(kind(text)), kind(text).seconds) == (text, nanoseconds / 1e9)


def test_ranges():
    assert Duration("-10min") == -600 * 10**9
    for kind, text in ((NonNegativeDuration, "-1s"), (PositiveDuration, "0"), (PositiveDuration, "-1s")):
        with pytest.raises(typer.BadParameter, match=f"the duration must .*not '{text}'"):
            kind(text)
    for text in ("", "1e3", "3 s s", "-", "--1", "nan", "9" * 400, "3d"):
        with pytest.raises(typer.BadParameter, match="is not a duration"):
            Duration(text)
