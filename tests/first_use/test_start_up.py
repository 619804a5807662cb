# SPDX-License-Identifier: Apache-2.0
"""The help of the command line appears quickly, and misspelled commands and options are corrected."""

import subprocess
import sys
import time

import pytest
from click.testing import CliRunner

from coframe.cli.app import app


def seconds(*arguments):
    """Return the shortest of three durations of a Python process."""
    times = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
        times.append(time.perf_counter() - start)
    return min(times)


def test_help_starts_quickly():
    # A process that does nothing measures the load of the machine.
    assert seconds("-m", "coframe.cli", "--help") < 0.2 + 15 * seconds("-c", "pass")


def test_help_does_not_import_numpy():
    script = "import sys; sys.argv = ['coframe', '--help']\nimport coframe.cli\ntry: coframe.cli.main()\n"
    script += "except SystemExit: pass\nassert not {'numpy', 'cyclonedds', 'coframe._core'} & set(sys.modules)"
    output = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout
    for command in ("demo", "lookup", "bag"):
        assert f"\n  {command} " in output


@pytest.mark.parametrize(
    ("words", "correct"),
    [(["lokup"], "lookup"), (["lookup", "a", "b", "--jsno"], "--json"), (["bag", "fxi"], "fix")],
)
def test_misspelled_commands_and_options_are_corrected(words, correct):
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 2
    assert "Did you mean" in result.output
    assert correct in result.output
