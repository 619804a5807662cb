# SPDX-License-Identifier: Apache-2.0
"""The command `coframe frames`: recordings, files, live trees and changes with --watch."""

import dataclasses
import io
import json
import re
import sys
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner
from recordings import START
from rich.console import Console
from runs import Run

from coframe.cli import frames_screen
from coframe.cli.app import app
from coframe.cli.frames_screen import _fitting, tree, tree_tables
from coframe.doctor import observe_recording
from coframe.tree_drawing import build_forest


def frames(*arguments):
    return CliRunner().invoke(app, ["frames", *map(str, arguments)])


def test_recording_in_the_terminal(shared):
    result = frames(shared / "recordings" / "tb3_tf_missing_static")
    assert result.exit_code == 0
    lines = [line.split() for line in result.stdout.splitlines()]
    assert lines[0] == ["frame", "Hz", "jitter", "ms"], "columns without values are omitted"
    assert ["base_link", "root"] in lines
    assert ["├─", "wheel_left_link", "19.4", "17.1"] in lines
    assert ["odom", "root"] in lines
    assert "5 frames in 2 separate trees: base_link (3), odom (2)" in result.stdout


def test_chosen_topics_are_those_of_one_robot(tmp_path):
    run = Run()
    run.tf("odom", "base", START, topic="/robot1/tf")
    run.tf("base", "lidar", START, static=True)
    bag = run.write(tmp_path)
    apart = frames(bag, "-o", tmp_path / "apart.json")
    assert (apart.exit_code, "several namespaces" in apart.stderr) == (2, True)
    result = frames(bag, "-o", tmp_path / "one.json", "--tf-topic", "robot1/tf")
    assert result.exit_code == 0, result.output
    printed = frames(bag, "--json", "--tf-topic", "robot1/tf").stdout
    assert list(json.loads(printed)["namespaces"]) == ["/robot1"]
    assert "3 frames in 1 tree" in frames(bag, "--tf-topic", "robot1/tf").stdout


def test_every_format_of_a_recording(shared, tmp_path):
    paths = [tmp_path / f"frames{suffix}" for suffix in (".gv", ".svg", ".pdf", ".json", ".mmd", ".md")]
    options = [part for path in paths for part in ("-o", path)]
    result = frames(shared / "recordings" / "tb3_tf_missing_static", *options)
    assert result.exit_code == 0
    assert result.stdout == ""
    assert result.stderr.count("5 frames in 2 separate trees") == len(paths)
    gv, svg, pdf, data, mmd, md = paths
    assert '"odom" -> "base_footprint"' in gv.read_text()
    assert ElementTree.parse(svg).getroot().tag.endswith("svg")
    assert pdf.read_bytes().startswith(b"%PDF-")
    assert [tree["root"] for tree in json.loads(data.read_text())["trees"]] == ["base_link", "odom"]
    assert mmd.read_text() in md.read_text()


def test_namespaces_are_drawn_separately(tmp_path):
    run = Run()
    for robot in ("/r1", "/r2"):
        run.tf("odom", "base", START, static=True, topic=f"{robot}/tf_static")
    bag = run.write(tmp_path)
    assert sorted(json.loads(frames(bag, "--json").stdout)["namespaces"]) == ["/r1", "/r2"]
    refused = frames(bag, "-o", tmp_path / "x.svg")
    assert refused.exit_code == 2
    assert "in several namespaces: /r1, /r2\n  Choose one with --namespace." in refused.output
    assert frames(bag, "-o", tmp_path / "x.svg", "--namespace", "/r1").exit_code == 0
    data = json.loads(frames(bag, "--namespace", "r2", "--prefix", "r2/", "--keep", "odom", "--json").stdout)
    data = data["namespaces"]["/r2"] if "namespaces" in data else data
    assert [frame["name"] for frame in data["frames"]] == ["odom", "r2/base"]


@pytest.mark.parametrize(
    ("arguments", "code", "text"),
    [
        (["-o", "frames.gif"], 2, "unknown suffix '.gif'. Suffixes: .gv"),
        (["--watch", "-o", "frames.svg"], 2, "--watch cannot be combined with --output"),
        (["--duration", "0s"], 2, "greater than 0"),
        (["nowhere.mcap"], 1, "nowhere.mcap"),
    ],
)
def test_wrong_usage_gives_a_message(arguments, code, text):
    result = frames(*arguments)
    assert result.exit_code == code
    assert text in result.output
    assert "Traceback" not in result.output


def test_failed_output_gives_a_message(tmp_path, monkeypatch):
    run = Run()
    run.tf("a", "b", START, static=True)
    bag = run.write(tmp_path)
    result = frames(bag, "-o", tmp_path / "no" / "x.svg")
    assert (result.exit_code, "cannot be written: No such file" in result.output) == (1, True)
    monkeypatch.setitem(sys.modules, "pydyf", None)
    result = frames(bag, "-o", tmp_path / "x.pdf")
    assert (result.exit_code, "pip install 'coframe[pdf]'" in result.output) == (1, True)
    empty = tmp_path / "empty"
    empty.mkdir()
    other = Run()
    other.scan(START)
    result = frames(other.write(empty), "--json")
    assert (result.exit_code, result.stdout, "no transforms" in result.stderr) == (1, "", True)


def test_live_trees_name_their_publishers(inside, tmp_path, eventually):
    output_path = tmp_path / "output"

    def frames():
        whole = output_path.read_text().rpartition("\n")[0].splitlines()[-1:]
        return {frame["name"]: frame for line in whole for frame in json.loads(line)["frames"]}

    with output_path.open("w") as output:
        inside.start("-m", "coframe.cli", "frames", "--watch", "--json", stdout=output)
        inside.start("-m", "coframe.lab.complete_tf_tree")
        # The rate of 50 Hz is tested on recordings: on a busy machine, the node itself publishes more slowly.
        eventually(lambda: len(frames()) == 11 and (frames()["link1"]["edges"][-1]["rate"] or 0.0) > 1.0)
        eventually(lambda: frames()["link1"]["edges"][-1]["publisher"] == "/complete_tf_tree")
    found = frames()
    # Transforms that arrive before the discovery of their publisher have no publisher name.
    assert {edge["publisher"] for frame in found.values() for edge in frame["edges"]} - {""} == {"/complete_tf_tree"}
    assert found["link1"]["parent"] == "base_link"
    assert found["link1"]["edges"][-1]["age"] is not None
    assert found["lidar_link"]["static"]


@pytest.mark.slow
def test_watch_prints_changes(inside, tmp_path, eventually):
    output_path = tmp_path / "output"
    with output_path.open("w") as output:
        node = inside.start("-m", "coframe.lab.complete_tf_tree")
        inside.start("-m", "coframe.cli", "frames", "--watch", "--duration", "2s", stdout=output)
        eventually(
            lambda: "11 frames in 1 tree" in output_path.read_text() or "end_effector is new" in output_path.read_text()
        )
        inside.start("-m", "coframe.cli", "static", "--frame-id", "base_link", "--child-frame-id", "mug")
        eventually(lambda: "mug is new: below base_link" in output_path.read_text())
        node.kill()
        eventually(lambda: "link1 is stale: no transform for" in output_path.read_text())
        eventually(lambda: "link1 is gone; it was below base_link" in output_path.read_text())


def test_changes_are_highlighted_and_omitted_rows_are_counted(tmp_path):
    run = Run.healthy(seconds=2, skip={"scan"})
    for number in range(40):
        run.tf("base_link", f"sensor{number}", START, static=True)
    (seen,) = observe_recording(run.write(tmp_path)).values()
    console = Console(record=True, width=80, force_terminal=True, file=io.StringIO())
    console.print(tree(build_forest(seen), {"base_link": "moved"}, limit=20))
    text = console.export_text(styles=True)
    assert re.search(r"\x1b\[7;33mbase_link", text)
    assert "... and 24 more rows" in text
    assert "43 frames in 1 tree" in text


def test_narrow_screen_shortens_publishers_first(tmp_path):
    (seen,) = observe_recording(Run.healthy(seconds=2, skip={"scan"}).write(tmp_path)).values()
    transforms = dataclasses.replace(
        seen.transforms, publishers=("/a_node_with_a_name_that_is_longer_than_it_should_be",)
    )
    console = Console(record=True, width=70, file=io.StringIO())
    console.print(tree(build_forest(dataclasses.replace(seen, transforms=transforms))))
    base, lidar = (line.split() for line in console.export_text().splitlines()[2:4])
    assert base[1:2] + base[3:] == ["base_link", "50.0", "0.0", "1.0", "1.0", "1.0"]
    assert base[2].startswith("/a_node")
    assert lidar[-1] == "static"


@pytest.mark.parametrize("width", [200, 60])
def test_long_tables_are_printed_in_parts_that_look_like_one(tmp_path, monkeypatch, width):
    run = Run()
    for number in range(500):
        run.tf("map", f"frame_{number * 37}", START, static=number % 3 > 0)
    (seen,) = observe_recording(run.write(tmp_path)).values()
    forest = build_forest(seen)
    whole, parts = (Console(file=io.StringIO(), width=width) for _ in range(2))
    whole.print(tree(forest))
    monkeypatch.setattr(frames_screen, "_MAX_TABLE_ROWS", 100)
    for part in tree_tables(forest):
        parts.print(part)
    assert len(list(tree_tables(forest))) == 7
    assert parts.file.getvalue() == whole.file.getvalue()


def test_names_are_complete_in_a_narrow_table_and_the_last_numbers_are_omitted():
    wide = {0: 27, 1: 30, 2: 5, 3: 9, 4: 8}
    assert list(_fitting(wide, 100)) == [0, 1, 2, 3, 4]
    assert list(_fitting(wide, 60)) == [0, 1, 2, 3]
    assert list(_fitting(wide, 20)) == [0]
