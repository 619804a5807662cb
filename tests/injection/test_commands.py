# SPDX-License-Identifier: Apache-2.0
"""Commands print hostile names of a recording without control characters."""

import pytest
from hostile_names import NAMES
from typer.testing import CliRunner

import coframe
from coframe.bags import Writer
from coframe.cli.app import app


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("hostile") / "run.mcap"
    with Writer(path) as writer:
        topic = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for second in range(1, 4):
            moment = coframe.Buffer()
            for name in NAMES:
                moment.set("map", name, coframe.Transform(), second * 10**9)
            writer.write(topic, moment.encode(static=False), received=second * 10**9)
    return str(path)


@pytest.mark.parametrize(
    "words",
    [
        ["frames"],
        ["frames", "--json"],
        ["doctor"],
        ["doctor", "--json"],
        ["doctor", "--sarif"],
        ["bag", "info"],
        *[["why", "{bag}", "map", name] for name in NAMES[:-1]],
        *[["lookup", "{bag}", "map", name] for name in [*NAMES[:-1], "nothing\x1b[2J"]],
        ["why", "{bag}", "map", "nothing\x1b[2J\u202e"],
    ],
)
def test_no_control_characters(bag, words):
    words = [bag if word == "{bag}" else word for word in words]
    result = CliRunner().invoke(app, words if bag in words else [*words, bag])
    assert result.exit_code in {0, 1, 2}, result.exception
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert not {c for c in result.output if not c.isprintable()} - {"\n", "\t"}
