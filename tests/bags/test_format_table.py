# SPDX-License-Identifier: Apache-2.0
"""Each file format of recordings is one class, and all lists of formats follow it."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
import recordings

import coframe
import rosbag2_py
from coframe.bags.formats import BUILT_IN, formats, is_recording, recording_name, storage_formats, suffixes

WRITERS = {
    "MCAP": (".mcap", recordings.write_mcap),
    "SQLite": (".db3", lambda path: recordings.write_sqlite(path, 4)),
    "ROS 1 bag": (".bag", recordings.write_rosbag1),
}
COFRAME = Path(sys.executable).with_name("coframe")


def named(name):
    found = {each.name: each for each in formats()}
    assert name in found, f"the format {name} has no class in coframe.bags.formats"
    return found[name]


@pytest.mark.parametrize("name", WRITERS)
def test_the_format_is_read_and_has_its_suffix_everywhere(tmp_path, monkeypatch, name):
    suffix, write = WRITERS[name]
    write(tmp_path / f"run{suffix}")
    assert suffix in named(name).suffixes
    with coframe.open_bag(tmp_path / f"run{suffix}") as recording:
        assert recording.format == name
        assert recording.formats == [named(name)]
        recordings.assert_same(recording.buffer)
    help_text = subprocess.run([COFRAME, "bag", "info", "--help"], capture_output=True, text=True, check=True).stdout
    assert re.search(rf"\{suffix}[\s,]", help_text)
    with pytest.raises(coframe.RecordingError) as caught:
        coframe.open_bag(tmp_path / "runs")
    assert f"run{suffix}" in caught.value.hint
    (tmp_path / "text").write_text("no recording")
    with pytest.raises(coframe.RecordingError) as caught:
        coframe.open_bag(tmp_path / "text")
    assert name in str(caught.value)
    assert f"{suffix}" in caught.value.hint
    from coframe.cli.completion import complete_recordings

    monkeypatch.chdir(tmp_path)
    assert f"run{suffix}" in complete_recordings(None, None, "run")


def test_every_format_is_tested_here():
    assert {each.name for each in BUILT_IN} == set(WRITERS)


@pytest.mark.parametrize("name", WRITERS)
def test_the_format_has_a_row_in_the_documentation(name):
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "recordings.md").read_text("utf-8")
    table = page.partition("## Supported formats")[2].partition("\n\n")[2].partition("\n\n")[0]
    assert all(f"`{suffix}`" in table for suffix in named(name).suffixes)


@pytest.mark.parametrize("name", WRITERS)
def test_the_first_bytes_decide_and_not_the_name(tmp_path, name):
    suffix, write = WRITERS[name]
    write(tmp_path / f"run{suffix}")
    (tmp_path / f"run{suffix}").rename(tmp_path / "data")
    with coframe.open_bag(tmp_path / "data") as recording:
        assert recording.format == name


@pytest.mark.parametrize(("storage", "name"), [("mcap", "MCAP"), ("sqlite3", "SQLite")])
def test_the_format_is_written_and_rosbag2_knows_it(tmp_path, storage, name):
    assert storage_formats(written=True)[storage] is named(name)
    assert storage in rosbag2_py.get_registered_readers()
    assert storage in rosbag2_py.get_registered_writers()
    with coframe.bags.Writer(tmp_path / "run", storage=storage) as writer:
        topics = {topic: writer.add_topic(topic, recordings.TF) for topic in ("/tf", "/tf_static")}
        for topic, at, data in recordings.messages():
            writer.write(topics[topic], data, at)
    with coframe.open_bag(tmp_path / "run") as recording:
        assert recording.format == name
        recordings.assert_same(recording.buffer)
    assert rosbag2_py.Info().read_metadata(str(tmp_path / "run"), "").storage_identifier == storage


def test_what_is_only_read_cannot_be_written(tmp_path):
    assert not named("ROS 1 bag").is_written
    with pytest.raises(coframe.CoframeError, match="are only read"):
        named("ROS 1 bag").create(tmp_path / "a.bag", "none")
    with pytest.raises(ValueError, match="Known storages: mcap, sqlite3"):
        coframe.bags.Writer(tmp_path / "run", storage="bag")


@pytest.mark.parametrize(
    ("file", "name", "recording"),
    [
        ("run_0.mcap", "MCAP", "run"),
        ("run_12.db3", "SQLite", "run"),
        ("run_12.db3.zstd", "SQLite", "run"),
        ("run.mcap", "MCAP", "run"),
        ("left_arm.mcap", "MCAP", "left_arm"),
        ("run_2024-05-01-10-00-00_0.bag", "ROS 1 bag", "run"),
        ("2024-05-01-10-00-00_3.bag", "ROS 1 bag", ""),
        ("2024-05-01-10-00-00.bag", "ROS 1 bag", "2024-05-01-10-00-00"),
    ],
)
def test_the_files_of_one_recording_have_a_name_in_common(file, name, recording):
    assert recording_name(Path(file), named(name)) == recording


def test_recordings_are_recognized_by_their_names(tmp_path):
    for name in ("a.mcap", "B.DB3", "c.db3.zstd", "d.txt"):
        (tmp_path / name).touch()
    (tmp_path / "folder.bag").mkdir()
    (tmp_path / "rosbag2").mkdir()
    (tmp_path / "rosbag2" / "metadata.yaml").touch()
    assert sorted(path.name for path in tmp_path.iterdir() if is_recording(path)) == [
        "B.DB3",
        "a.mcap",
        "c.db3.zstd",
        "rosbag2",
    ]


def test_suffixes_are_known_without_numpy():
    """Help texts and completions need them at every start of a command."""
    program = "import sys, coframe.bags.formats as f; print(*f.suffixes(), 'numpy' in sys.modules)"
    shown = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert shown.stdout.split() == [*suffixes(), "False"]


@pytest.mark.parametrize("name", coframe.bags.__all__)
def test_each_public_name_can_be_imported(name):
    assert getattr(coframe.bags, name) is not None
    assert name in dir(coframe.bags)
