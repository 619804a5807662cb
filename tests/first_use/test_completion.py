# SPDX-License-Identifier: Apache-2.0
"""Completion of commands, options, frame names and topics in a shell."""

import os
import subprocess
import sys

import pytest
import recordings

import coframe


@pytest.mark.parametrize(
    ("line", "expected"),
    [("coframe loo", "lookup"), ("coframe lookup --js", "--json"), ("coframe lookup walk.mcap od", "odom")],
)
def test_completion(tmp_path, line, expected):
    recordings.write_mcap(tmp_path / "walk.mcap")
    assert expected in completed(line, tmp_path)


@pytest.mark.usefixtures("domain_id")
def test_completion_of_live_topics(tmp_path, eventually):
    pytest.importorskip("dds_library", reason="topics are found over DDS")
    with coframe.connect(tf_topic="/robot1/tf"):
        # A busy machine may need longer than the command waits for the discovery of topics.
        eventually(lambda: completed("coframe echo a b --tf-topic /ro", tmp_path) == ["/robot1/tf"])
        eventually(lambda: completed("coframe record /robot1/", tmp_path) == ["/robot1/tf"])


def completed(line, folder):
    """Return what the shell offers for the last word of a command line."""
    environment = {
        **os.environ,
        "_COFRAME_COMPLETE": "complete_bash",
        "COMP_WORDS": line,
        "COMP_CWORD": str(len(line.split()) - 1),
    }
    script = "import sys; sys.argv = ['coframe']; import coframe.cli; coframe.cli.main()"
    result = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=environment, cwd=folder, check=False
    )
    assert result.stderr == ""
    return result.stdout.split()
