# SPDX-License-Identifier: Apache-2.0
"""Commands where the packages of an extra are not installed: one sentence says what to install."""

import json
import os
import subprocess
import sys

import pytest

from coframe.bags import Writer
from coframe.messages import serialize
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

# Hides packages as if they were not installed.
HIDE = """\
import sys

class Hide:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {hidden!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Hide())
"""
# Runs commands one after the other in one process, which is faster than a process for each.
RUN_ALL = """\
import contextlib, io, json, sys, traceback
import coframe.cli

results = []
for words in json.loads(sys.argv[1]):
    sys.argv = ["coframe", *words]
    output = io.StringIO()
    code = None
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
        try:
            coframe.cli.main()
        except SystemExit as end:
            code = end.code
        except BaseException:
            traceback.print_exc()
    if isinstance(code, str):
        code, text = 1, output.getvalue() + code
    else:
        text = output.getvalue()
    results.append((code or 0, text))
print(json.dumps(results))
"""


@pytest.fixture
def run(tmp_path):
    """Return a function that runs commands with some packages hidden, and returns their exit codes and outputs."""

    def run(hidden, *commands, **environment):
        script = HIDE.format(hidden=set(hidden)) + RUN_ALL
        result = subprocess.run(
            [sys.executable, "-c", script, json.dumps([[str(word) for word in words] for words in commands])],
            capture_output=True,
            check=True,
            text=True,
            timeout=120,
            env={**os.environ, "COLUMNS": "80", **environment},
            cwd=tmp_path,
        )
        return [(code, text) for code, text in json.loads(result.stdout)]

    return run


@pytest.mark.parametrize("hidden", ["click", "rich"])
def test_without_the_extra_cli(run, hidden):
    # The list of the commands needs only click.
    general = [["--help"]] if hidden == "click" else []
    for code, text in run([hidden], *general, ["doctor"], ["demo", "--help"]):
        assert (code, text) == (1, "The command line needs the packages click and rich: pip install 'coframe[cli]'")


def test_help_needs_only_the_extra_cli(run):
    optional = [
        "yaml",
        "mcap",
        "zstandard",
        "lz4",
        "rosbags",
        "websockets",
        "xacro",
        "pydyf",
        "pyarrow",
        "matplotlib",
    ]
    commands = [
        "demo",
        "doctor",
        "echo",
        "why",
        "view",
        "play",
        "record",
        "robot",
        "joints",
        "static",
        "bag",
        "cloud",
        "plot",
        "compare",
    ]
    for code, text in run(optional, ["--help"], *([command, "--help"] for command in commands)):
        assert (code, "Example: coframe" in text) == (0, True), text


def test_live_commands_without_a_dds_library(run, tmp_path):
    commands = [
        ["demo", "--duration", "1", "--no-browser"],
        ["demo", "--robots", "2", "--duration", "1", "--no-browser"],
        ["doctor"],
        ["echo", "a", "b"],
        ["frames"],
        ["monitor"],
        ["why", "a", "b"],
        ["view", "--no-browser"],
        ["relay", "--robots", "a,b"],
        ["record"],
        ["static", "--frame-id", "a", "--child-frame-id", "b"],
    ]
    absent = str(tmp_path / "libddsc.so")
    results = run([], *commands, COFRAME_DDS_LIBRARY=absent)
    for words, (code, text) in zip(commands, results, strict=True):
        assert code == 1, (words, text)
        assert "libddsc" in text, (words, text)
        assert "Use one of these options: " in text, (words, text)
        assert "Traceback" not in text, (words, text)


@pytest.fixture
def bag(tmp_path):
    """A compressed recording with one static transform."""
    message = TransformStamped(child_frame_id="b")
    message.header.frame_id = "a"
    with Writer(tmp_path / "run", compression="zstd") as writer:
        topic = writer.add_topic("/tf_static", "tf2_msgs/msg/TFMessage")
        writer.write(topic, serialize(TFMessage(transforms=[message])), 1)
    return tmp_path / "run"


@pytest.mark.parametrize(
    ("hidden", "extra", "words"),
    [
        ("zstandard", "bags", ["lookup", "run", "a", "b"]),
        ("yaml", "bags", ["bag", "fix", "run", "new"]),
        ("lz4", "bags", ["bag", "fix", "run", "new", "--compression", "lz4"]),
        ("pyarrow", "parquet", ["trajectory", "run", "a", "b", "-o", "run.parquet"]),
        ("pydyf", "pdf", ["frames", "run", "-o", "frames.pdf"]),
        ("matplotlib", "plot", ["frames", "run", "-o", "frames.png"]),
        ("matplotlib", "plot", ["plot", "run", "/tf_static.rate", "-o", "a.svg"]),
        ("websockets", "viewer", ["view", "run", "--no-browser"]),
        ("xacro", "robots", ["robot", "arm.urdf.xacro"]),
    ],
    ids=lambda value: value if isinstance(value, str) else value[0],
)
@pytest.mark.usefixtures("bag")
def test_without_another_extra(run, tmp_path, hidden, extra, words):
    xacro = '<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro"><link name="base"/></robot>'
    (tmp_path / "arm.urdf.xacro").write_text(xacro)
    before = sorted(tmp_path.iterdir())
    ((code, text),) = run([hidden], words)
    assert code == 1, text
    assert f"pip install 'coframe[{extra}]'" in text
    assert "Traceback" not in text
    assert sorted(tmp_path.iterdir()) == before
