# SPDX-License-Identifier: Apache-2.0
"""Every option that is a duration accepts the same forms, and refuses others with the same sentence."""

import pickle

import click
import pytest

from coframe.cli.app import app
from coframe.cli.options import DURATIONS, Duration, NonNegativeDuration, PositiveDuration
from coframe.time import duration_ns


def duration_options(command):
    """Yield the words of each command, and the names of its options that are durations."""
    pending = [((), command)]
    while pending:
        words, command = pending.pop()
        pending += [((*words, name), each) for name, each in getattr(command, "commands", {}).items()]
        for option in command.params:
            if option.metavar == "DURATION":
                yield words, option.opts[-1]
            assert option.metavar != "SECONDS" or option.name == "at", f"{words} {option.opts} is not a duration"


def test_the_same_sentence_in_every_command(capsys):
    command = app
    options = list(duration_options(command))
    assert len(options) > 30
    for words, option in options:
        with pytest.raises(SystemExit) as ended:
            command.main([*words, option, "3 parsecs"], prog_name="coframe")
        assert ended.value.code == 2, (words, option)
        assert f"'3 parsecs' is not a duration. {DURATIONS}" in " ".join(capsys.readouterr().err.split())


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
        with pytest.raises(click.BadParameter, match=f"the duration must .*not '{text}'"):
            kind(text)
    for text in ("", "1e3", "3 s s", "-", "--1", "nan", "9" * 400, "3d"):
        with pytest.raises(click.BadParameter, match="is not a duration"):
            Duration(text)


def test_a_duration_survives_the_way_to_a_worker_process():
    for kind, text in ((Duration, "-1min"), (NonNegativeDuration, "20ms"), (PositiveDuration, "3")):
        copied = pickle.loads(pickle.dumps(kind(text)))
        assert (type(copied), copied, str(copied)) == (kind, kind(text), text)
