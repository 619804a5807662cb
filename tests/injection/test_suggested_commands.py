# SPDX-License-Identifier: Apache-2.0
"""A command that a line suggests runs nothing that a name contains, also if the line is too long to be shown."""

import shlex
import subprocess

import pytest

from coframe._output.escaping import MAX_LINE_LENGTH, one_line
from coframe.analysis.static_command import static_command


@pytest.mark.parametrize("after", range(950, 980))
def test_a_shortened_command_is_still_quoted(tmp_path, after):
    name = f"{'A' * 1400}'{'B' * after};touch hacked;#"
    line = one_line(static_command("base", name))
    assert len(line) == MAX_LINE_LENGTH
    # The shell gets another program with the same arguments.
    subprocess.run(["sh", "-c", line.replace("coframe", "true", 1)], cwd=tmp_path, capture_output=True, check=False)
    assert list(tmp_path.iterdir()) == []


def test_a_command_that_fits_can_be_pasted():
    name = "it's $(x) `y`; z"
    assert shlex.split(one_line(static_command("base", name)))[5] == name
