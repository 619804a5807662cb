# SPDX-License-Identifier: Apache-2.0
"""The commands coframe bag convert, merge and slice."""

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from recordings import COUNT, SECOND, START

import coframe
from coframe.cli.app import app


def run(*arguments):
    """Run a command; return (exit code, output)."""
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.output


@pytest.mark.parametrize("source", ["sqlite", "ros1", "mcap"])
def test_convert(tmp_path, source):
    if source == "sqlite":
        bag = recordings.write_sqlite(tmp_path / "a.db3", 3)
    elif source == "ros1":
        bag = recordings.write_rosbag1(tmp_path / "a.bag")
    else:
        bag = recordings.write_mcap(tmp_path / "a.mcap")
    code, out = run("bag", "convert", bag, tmp_path / "new", "--compression", "lz4")
    assert (code, out) == (0, f"{tmp_path / 'new'}: {COUNT + 1} messages\n")
    with coframe.open_bag(tmp_path / "new") as recording:
        recordings.assert_same(recording.buffer)
        assert (recording.format, recording.compression) == ("MCAP", "lz4")
        assert recording.topics["/tf"].encoding == "cdr"


def test_merge_is_in_the_order_of_receipt(tmp_path):
    rows = recordings.messages()
    one = recordings.write_mcap(tmp_path / "one.mcap", rows=rows[::2])
    two = recordings.write_mcap(tmp_path / "two.mcap", rows=rows[1::2])
    code, out = run("bag", "merge", one, two, "-o", tmp_path / "both", "--join")
    assert code == 0, out
    with coframe.open_bag(tmp_path / "both") as recording:
        recordings.assert_same(recording.buffer)
        assert [data for _, _, data in recording.in_order()] == [data for _, _, data in rows]


def test_slice_keeps_the_static_transforms(tmp_path):
    bag = recordings.write_mcap(tmp_path / "a.mcap")
    code, out = run("bag", "slice", bag, tmp_path / "part", "--start", "1s", "--end", "2s")
    assert code == 0, out
    with coframe.open_bag(tmp_path / "part") as recording:
        received = recording.received("/tf")
        assert received[0] >= START + SECOND
        assert received[-1] <= START + 2 * SECOND + 1000
        assert np.isfinite(recording.buffer.lookup("odom", "lidar").values).all()


def test_slice_by_topics(tmp_path):
    bag = recordings.write_mcap(tmp_path / "a.mcap")
    assert run("bag", "slice", bag, tmp_path / "part", "--topics", "tf_static") == (
        0,
        f"{tmp_path / 'part'}: 1 message\n",
    )
    code, out = run("bag", "slice", bag, tmp_path / "other", "--topics", "/tff")
    assert code == 1
    assert "Did you mean '/tf'?" in out
    assert not (tmp_path / "other").exists()
