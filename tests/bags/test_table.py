# SPDX-License-Identifier: Apache-2.0
"""All transforms of a recording as one table."""

import sys

import numpy as np
import pytest
import recordings
from recordings import COUNT, START, walk

import coframe

pytest.importorskip("pyarrow")


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    with coframe.open_bag(recordings.write_mcap(tmp_path_factory.mktemp("bag") / "walk.mcap")) as recording:
        yield recording


def rows_of(columns):
    """Return (topic, stamp, parent, child, seven numbers) of each row."""
    poses = zip(*(columns[name] for name in ("x", "y", "z", "qx", "qy", "qz", "qw")), strict=True)
    names = (columns[name] for name in ("topic", "stamp_ns", "parent", "child"))
    return [(*facts, pose) for *facts, pose in zip(*names, poses, strict=True)]


def assert_is_the_walk(columns):
    expected = [(topic, 0 if topic == "/tf_static" else at, *rest) for topic, at, *rest in walk()]
    found = sorted(rows_of(columns), key=lambda row: row[1])
    assert [row[:4] for row in found] == [row[:4] for row in expected]
    ours, theirs = np.array([row[4] for row in found]), np.array([row[4].values for row in expected])
    theirs[:, 3:] *= np.sign((ours[:, 3:] * theirs[:, 3:]).sum(axis=1, keepdims=True))  # the same rotations
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-15)
    assert columns["static"] == [row[0] == "/tf_static" for row in rows_of(columns)]


def test_arrow_table(recording):
    table = recording.table()
    assert table.num_rows == COUNT + 1
    assert_is_the_walk(table.to_pydict())


def test_pandas_data_frame(recording):
    pytest.importorskip("pandas")
    frame = recording.table("pandas")
    assert frame["stamp_ns"].dtype == np.int64
    assert_is_the_walk({name: frame[name].tolist() for name in frame})


def test_a_frame_with_two_parents_and_a_frame_in_another_namespace(tmp_path):
    rows = []
    for topic, shift in (("/a/tf", 0), ("/b/tf", 10)):
        for i, parent in enumerate(["map", "odom", "map"]):
            at = START + i
            rows.append((topic, at, recordings.cdr(parent, "box", coframe.Transform([i + shift, 0, 0]), at)))
    with coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows)) as recording:
        columns = recording.table().to_pydict()
    assert columns["parent"] == ["map", "odom", "map"] * 2
    assert columns["x"] == [0, 1, 2, 10, 11, 12]
    assert columns["topic"] == ["/a/tf"] * 3 + ["/b/tf"] * 3


def test_an_empty_recording(tmp_path):
    with coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=[])) as recording:
        assert recording.table().num_rows == 0


@pytest.mark.parametrize(("format_", "package"), [("arrow", "pyarrow"), ("pandas", "pandas")])
def test_a_missing_package_is_an_error(recording, monkeypatch, format_, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(coframe.RecordingError, match=f"needs the package {package}") as caught:
        recording.table(format_)
    assert caught.value.hint.startswith("pip install ")
    with pytest.raises(ValueError, match="'excel'"):
        recording.table("excel")
