# SPDX-License-Identifier: Apache-2.0
"""Completion of commands, options and frame names in a shell."""

import os
import subprocess
import sys

import pytest
import recordings


@pytest.mark.parametrize(
    ("line", "expected"),
    [("coframe loo", "lookup"), ("coframe lookup --js", "--json"), ("coframe lookup walk.mcap od", "odom")],
)
def test_completion(tmp_path, line, expected):
    recordings.write_mcap(tmp_path / "walk.mcap")
    environment = {
        **os.environ,
        "_COFRAME_COMPLETE": "complete_bash",
        "COMP_WORDS": line,
        "COMP_CWORD": str(len(line.split()) - 1),
    }
    script = "import sys; sys.argv = ['coframe']; import coframe.cli; coframe.cli.main()"
    result = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=environment, cwd=tmp_path, check=False
    )
    assert expected in result.stdout.split(), result.stderr
