# SPDX-License-Identifier: Apache-2.0
"""Errors of the operating system are shown without their numbers."""

import errno
import os

import pytest
from click.testing import CliRunner

from coframe._files.os_errors import explain, reason
from coframe._files.regular_files import open_regular
from coframe.cli.command_line import CommandLine


def test_the_texts_of_errors(tmp_path):
    with pytest.raises(FileNotFoundError) as raised:
        (tmp_path / "a b").stat()
    assert reason(raised.value) == os.strerror(errno.ENOENT)
    assert explain(raised.value) == f"{tmp_path / 'a b'}: {os.strerror(errno.ENOENT)}"
    with pytest.raises(OSError, match="directory") as raised:
        (tmp_path / "a").rename(tmp_path / "b")
    assert explain(raised.value).startswith(f"{tmp_path / 'a'}: {tmp_path / 'b'}: ")
    with pytest.raises(OSError, match="folder") as raised:
        open_regular(tmp_path)
    assert explain(raised.value) == f"{tmp_path} cannot be read: {reason(raised.value)}"
    assert explain(OSError()) == "OSError"
    assert explain(ValueError("a")) == "a"


@pytest.mark.parametrize(
    "words",
    [
        ("bag", "convert", "-i", "run", "-o", "{file}"),
        ("bag", "convert", "{file}", "out.mcap"),
        ("bag", "reindex", "{file}"),
        ("param", "load", "/node", "{file}"),
        ("launch", "{file}"),
        ("topic", "pub", "/a", "std_msgs/msg/String", "--yaml-file", "{file}"),
        ("robot", "{file}"),
        ("view", "-d", "{file}"),
    ],
)
def test_commands_print_the_reason_and_no_number(words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "empty").touch()
    for name in ("missing", "loop", "empty/below"):
        result = CliRunner().invoke(CommandLine("coframe", None), [word.replace("{file}", name) for word in words])
        assert result.exit_code, result.output
        assert name in result.output
        assert "Errno" not in result.output
