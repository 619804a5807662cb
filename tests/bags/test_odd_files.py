# SPDX-License-Identifier: Apache-2.0
"""Odd recordings, as people have them: each is read right, or it is said what was not read and why."""

import gzip
import json

import pytest
import recordings
from recordings import COUNT, SECOND, START

import coframe

CRLF = b"\r\n"


def test_files_whose_line_ends_were_changed_are_named_so(tmp_path):
    for path in (recordings.write_mcap(tmp_path / "a.mcap"), recordings.write_rosbag1(tmp_path / "a.bag")):
        path.write_bytes(path.read_bytes().replace(b"\n", CRLF))
        with pytest.raises(coframe.RecordingError, match="a transfer in text mode, or Git, has changed the line ends"):
            coframe.open_bag(path)


@pytest.mark.parametrize(("write", "name"), [(recordings.write_mcap, "mcap"), (recordings.write_rosbag1, "bag")])
def test_the_second_of_two_files_in_one_is_reported(tmp_path, write, name):
    content = write(tmp_path / f"one.{name}").read_bytes()
    path = tmp_path / f"two.{name}"
    path.write_bytes(content + content)
    recording = coframe.open_bag(path)
    recordings.assert_same(recording.buffer)
    assert recording.topics["/tf"].messages == COUNT
    problems = " ".join(recording.problems)
    assert f"the last {len(content)} bytes were not read" in problems or "another MCAP file begins there" in problems
    assert "begins there" in problems


@pytest.mark.parametrize("type_", ["foxglove.FrameTransform", "foxglove.FrameTransforms", "tf2_msgs/msg/TFMessage"])
def test_transforms_in_an_unknown_encoding_are_reported(tmp_path, type_):
    rows = [("/tf", START + i, b"\x81\xa1a\x01") for i in range(5)]
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/tf": (type_, "", b"", "msgpack")})
    recording = coframe.open_bag(path)
    assert f"/tf: its transforms, {type_}, are in the encoding 'msgpack', which is not known" in recording.problems


@pytest.mark.parametrize("suffix", ["mcap", "db3", "bag"])
@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n", "Git LFS pointer"),
        (gzip.compress(b"x" * 100, mtime=0), "compressed with gzip"),
        (b"\x04\x22\x4d\x18\x64\x40\xa7", "compressed with LZ4"),
        (b"", "the file is empty"),
        (b"%PDF-1.7 abcdefghij", "a PDF document"),
    ],
)
def test_other_files_are_named_for_what_they_are(tmp_path, suffix, content, what):
    path = tmp_path / f"run.{suffix}"
    path.write_bytes(content)
    with pytest.raises(coframe.RecordingError, match=what):
        coframe.open_bag(path)


@pytest.mark.parametrize(
    "stamp",
    ["2023-11-14T22:13:20.000", START / SECOND, START, str(START), START // 10**6, {"sec": 0, "nsec": START}, None],
)
def test_a_time_in_an_unknown_form_is_never_zero(tmp_path, stamp):
    facts = json.loads(recordings.foxglove_json("odom", "base", coframe.Transform(), START))
    body = json.dumps(facts | {"timestamp": stamp}).encode()
    types = {"/tf": ("foxglove.FrameTransform", "jsonschema", b"{}", "json")}
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=[("/tf", START, body)], types=types))
    assert recording.buffer.frame_names() == []
    assert "timestamp" in " ".join(recording.problems)


def test_messages_of_a_database_without_its_first_page_are_read(tmp_path):
    path = recordings.write_sqlite(tmp_path / "a.db3", 3)
    path.write_bytes(bytes(4096) + path.read_bytes()[4096:])
    recording = coframe.open_bag(path)
    recordings.assert_same(recording.buffer)
    assert "the database is damaged" in " ".join(recording.problems)
