# SPDX-License-Identifier: Apache-2.0
"""Poses across a dropout of transforms: reported, refused, filled with NaN or omitted."""

import json
import warnings

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from recordings import SECOND, START

import coframe
from coframe.bags import TrajectoryQuery, query_recording
from coframe.cli.app import app
from coframe.trajectories import read_trajectory

PERIOD = SECOND // 100
GAP = (100, 300)  # the first and the last sample before and after the dropout


def robot(cache=None):
    """Return a buffer whose edge odom <- base has no samples for two seconds; map <- odom has all."""
    buffer = coframe.Buffer(cache)
    for i in range(401):
        at = START + i * PERIOD
        buffer.set("map", "odom", coframe.Transform([0.0, i / 1000, 0.0]), at)
        if not GAP[0] < i < GAP[1]:
            moved = coframe.Transform([i / 100, 0.0, 0.0])
            buffer.set("odom", "base", moved, at)
    buffer.set("base", "lidar", coframe.Transform([0.1, 0.0, 0.3]), static=True)
    return buffer


def at(*indices):
    return START + np.round(np.array(indices) * PERIOD).astype(np.int64)


TIMES = at(0, 50.5, 99.5, 100, 100.5, 200, 299, 300, 300.5, 400)
IN_GAP = [False] * 4 + [True] * 3 + [False] * 3


def test_each_pose_says_over_which_gap_it_is_interpolated():
    found = robot().validity("map", "lidar", [*TIMES, START - 7, START + 400 * PERIOD + 9])
    in_ms = (found.gaps / 1e6).tolist()
    assert in_ms == [0, 10, 10, 0, 2000, 2000, 2000, 0, 10, 0, 0, 0]
    assert found.outside.tolist() == [0] * 10 + [7, 9]
    assert found.edges[4:7].tolist() == ["base"] * 3
    assert robot().validity("base", "lidar", [1, 2]).gaps.tolist() == [0, 0]
    with pytest.raises(coframe.LookupException, match="attic"):
        robot().validity("map", "attic", [1])


@pytest.mark.parametrize("names", [("map", "lidar"), ("lidar", "map"), ("odom", "base")])
@pytest.mark.parametrize("cache", ["10s", None])
def test_gaps_are_refused_filled_or_omitted(names, cache):
    buffer = robot(cache)
    with pytest.raises(coframe.ExtrapolationException, match=r"of 3 such times.*lies in a gap of 2 s .* 'base'") as e:
        buffer.lookup_many(*names, TIMES, max_gap="200ms")
    assert (e.value.requested, e.value.target) == (TIMES[4], names[0])
    filled, twists = buffer.lookup_many(*names, TIMES, max_gap="200ms", on_gap="nan", twist=True)
    assert np.isnan(filled.translation).all(axis=1).tolist() == IN_GAP
    assert np.isnan(twists).all(axis=1).tolist() == IN_GAP
    kept = buffer.lookup_many(*names, TIMES, max_gap="200ms", on_gap="omit")
    assert kept.stamps.tolist() == TIMES[~np.array(IN_GAP)].tolist()
    assert np.array_equal(kept.translation, filled.translation[~np.array(IN_GAP)])
    assert len(buffer.lookup_many(*names, TIMES, max_gap="2s")) == 10


def test_one_lookup_refuses_a_gap():
    buffer = robot()
    good, bad = (int(stamp) for stamp in at(50.5, 200))
    assert buffer.lookup("map", "lidar", good, max_gap="200ms") == buffer.lookup("map", "lidar", good)
    with pytest.raises(coframe.ExtrapolationException, match="lies in a gap of 2 s"):
        buffer.lookup("map", "lidar", bad, max_gap="200ms")
    assert buffer.lookup("map", "lidar", bad, max_gap="3s").translation[0] == pytest.approx(2.1)
    assert buffer.lookup("map", "lidar", max_gap="20ms").stamp == at(400)[0]
    assert buffer.lookup("base", "lidar", bad, max_gap="20ms").stamp == bad
    with pytest.raises(coframe.LookupException):
        buffer.lookup("map", "attic", bad, max_gap="20ms")
    for value, error in ((0, ValueError), ("-1s", ValueError), (0.2, TypeError)):
        with pytest.raises(error):
            buffer.lookup("map", "lidar", good, max_gap=value)


def test_a_trajectory_has_no_poses_in_a_gap_on_request():
    buffer = robot()
    whole = {"max_gap": "3s"}
    assert len(buffer.trajectory("map", "base", **whole)) == 401
    kept = buffer.trajectory("map", "base", max_gap="200ms", on_gap="omit")
    assert len(kept) == 401 - 199
    fine = buffer.trajectory("map", "base", max_translation=0.001, max_gap="200ms", on_gap="omit")
    inside = (fine.stamps > at(GAP[0])[0]) & (fine.stamps < at(GAP[1])[0])
    assert len(fine) > 1000
    assert not inside.any()
    with pytest.raises(coframe.ExtrapolationException, match="lies in a gap"):
        buffer.trajectory("map", "base", max_gap="200ms")


def test_unusual_gaps_in_a_recording_are_said_once_per_call():
    buffer = robot()
    text = r"3 of 10 poses of 'lidar' in 'map' are interpolated over gaps of up to 2 s without a sample of 'base'"
    with pytest.warns(coframe.CoframeWarning, match=text) as caught:
        buffer.lookup_many("map", "lidar", TIMES)
    assert [each.filename for each in caught] == [__file__]
    with pytest.warns(coframe.CoframeWarning, match="199 of 401 poses"):
        buffer.trajectory("map", "base")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        buffer.lookup_many("map", "lidar", TIMES[:4])
        robot("10s").lookup_many("map", "lidar", TIMES)
    buffer.set("odom", "base", coframe.Transform(), int(at(200)[0]))
    with pytest.warns(coframe.CoframeWarning, match="gaps of up to 1 s"):
        buffer.lookup_many("map", "lidar", TIMES)


@pytest.mark.parametrize(
    ("options", "error"),
    [({"on_gap": "clip"}, ValueError), ({"max_gap": "2"}, ValueError), ({"max_gap": 0.2}, TypeError)],
)
def test_invalid_arguments_are_refused(options, error):
    with pytest.raises(error):
        robot().lookup_many("map", "lidar", TIMES, **options)
    with pytest.raises(error):
        robot().trajectory("map", "lidar", max_translation=1.0, **options)


def test_rows_cannot_be_omitted_from_a_given_array():
    with pytest.raises(ValueError, match="omit"):
        robot().lookup_many("map", "lidar", TIMES, out=np.empty((10, 7)), max_gap="1s", on_gap="omit")


@pytest.fixture
def bag(tmp_path):
    rows, buffer = [], robot()
    for i in range(401):
        stamp = int(at(i)[0])
        rows.append(("/tf", stamp, recordings.cdr("map", "odom", coframe.Transform([0.0, i / 1000, 0.0]), stamp)))
        if not GAP[0] < i < GAP[1]:
            moved = buffer.lookup("odom", "base", stamp)
            rows.append(("/tf", stamp, recordings.cdr("odom", "base", moved, stamp)))
    return recordings.write_mcap(tmp_path / "run.mcap", rows=rows)


def test_queries_omit_fill_or_refuse_gaps(bag):
    with coframe.open_bag(bag) as recording:
        for on_gap, expected in (("omit", (22, 19)), ("nan", (41, 0))):
            poses, missing = TrajectoryQuery("map", "base", rate=10, max_gap="200ms", on_gap=on_gap).run(recording)
            assert (len(poses), missing) == expected
        with pytest.raises(coframe.ExtrapolationException, match="lies in a gap"):
            TrajectoryQuery("map", "base", rate=10, max_gap="200ms", on_gap="raise").run(recording)
    with pytest.raises(ValueError, match="on_gap"):
        TrajectoryQuery("map", "base", on_gap="skip")


def run(*words):
    ended = CliRunner().invoke(app, [str(word) for word in words])
    return ended.exit_code, ended.stdout, ended.stderr


def test_commands_report_gaps_and_have_an_option_for_them(bag):
    skipped = "19 of 41 poses of 'base' in 'map' lie between samples of 'base' that are up to 2 s apart, which is more"
    code, text, errors = run("trajectory", bag, "map", "base", "--rate", 10)
    assert (code, len(text.splitlines())) == (0, 22)
    assert f"{skipped} than 500 ms; they are omitted (--max-gap changes this limit)" in errors
    code, text, errors = run("trajectory", bag, "map", "base", "--rate", 10, "--max-gap", "2s")
    assert (code, len(text.splitlines()), errors) == (0, 41, "")
    code, text, errors = run("trajectory", bag, "map", "base", "--rate", 10, "--max-gap", "200ms")
    assert (code, len(text.splitlines())) == (0, 22)
    assert errors == f"coframe: {skipped} than 200 ms; they are omitted (--max-gap changes this limit)\n"
    assert run("trajectory", bag, "map", "base", "--max-gap", "200ms", "--on-gap", "raise")[0] == 1
    assert run("trajectory", bag, "map", "base", "--max-gap", "200ms", "--on-gap", "skip")[0] == 2

    code, _, errors = run("table", bag, "map:base")
    assert (code, "Give a topic, such as --at /camera/image, or --rate 10." in errors) == (1, True)

    code, text, errors = run("lookup", bag, "map", "base", "--at", "2s")
    assert (code, "without a sample of 'base'; use --max-gap 200ms to get an error instead" in errors) == (0, True)
    code, text, errors = run("lookup", bag, "map", "base", "--at", "2s", "--max-gap", "200ms")
    assert (code, text, "lies in a gap of 2 s" in errors) == (1, "", True)
    assert run("lookup", bag, "map", "base", "--at", "3.5s", "--max-gap", "200ms")[::2] == (0, "")
    _, text, _ = run("lookup", bag, "map", "base", "--at", "2s", "--validity")
    assert text.splitlines()[-1] == "- Interpolated over: 2 s between two samples of base"
    _, text, _ = run("lookup", bag, "map", "base", "--at", "2s", "--validity", "--json")
    assert (json.loads(text)["gap_ns"], json.loads(text)["outside_ns"]) == (2 * SECOND, 0)


def test_poses_between_sparse_detections_are_not_invented(tmp_path):
    """A tag that is seen once a second has one pose per detection; a sentence describes the others."""
    rows = []
    for i in range(101):
        stamp = int(at(5 * i)[0])
        rows.append(("/tf", stamp, recordings.cdr("map", "base", coframe.Transform([i / 100, 0.0, 0.0]), stamp)))
        if i % 20 == 0:
            rows.append(("/tf", stamp, recordings.cdr("base", "tag36h11:0", coframe.Transform([1.0, 0, 0]), stamp)))
    bag = recordings.write_mcap(tmp_path / "tags.mcap", rows=rows)
    code, text, errors = run("trajectory", bag, "map", "tag36h11:0")
    assert (code, len(text.splitlines())) == (0, 6)
    assert "95 of 101 poses of 'tag36h11:0' in 'map' lie between samples of 'tag36h11:0' that are up to 1 s" in errors
    code, text, errors = run("table", bag, "tag=map:tag36h11:0.x", "base=map:base.x", "--rate", "20")
    values = [line.split(",")[1] for line in text.splitlines()[1:]]
    assert (code, len(values), sum(bool(value) and value != "nan" for value in values)) == (0, 101, 6)
    assert "95 poses of tag lie between transforms that are more than 500 ms apart; they are NaN" in errors
    assert "base" not in errors
    code, text, errors = run("table", bag, "tag=map:tag36h11:0.x", "--rate", "20", "--max-gap", "1s")
    assert (code, errors, "nan" in text) == (0, "", False)
    code, text, errors = run("table", bag, "map:tag36h11:0", "--rate", "20", "--start", "+0.1s", "--stop", "+0.8s")
    assert (code, "Its transforms are too far apart" in errors) == (1, True)
    for words in (["map", "tag36h11:0"], ["-c", "map:tag36h11:0", "--rate", "20"]):
        code, text, errors = run("batch", *words, bag, "-o", tmp_path / f"poses{len(words)}")
        assert (code, "95" in errors) == (0, True), errors


def test_a_trajectory_file_has_the_gap_of_each_pose_on_request(bag, tmp_path):
    _, text, _ = run("trajectory", bag, "map", "base", "--rate", 10, "--format", "csv", "--validity", "--max-gap", "2s")
    header, *rows = (line.split(",") for line in text.splitlines())
    assert header[-2:] == ["gap_ns", "outside_ns"]
    # Every tenth sample is at the time of a pose.
    assert [int(row[-2]) for row in rows] == [2 * SECOND if GAP[0] < 10 * i < GAP[1] else 0 for i in range(41)]
    for name in ("a.npz", "a.csv"):
        assert run("trajectory", bag, "map", "base", "-o", tmp_path / name, "--validity", "--max-gap", "2s")[0] == 0
        read = read_trajectory(tmp_path / name)
        assert np.array_equal(read.stamps, at(*(i for i in range(401))))
    with np.load(tmp_path / "a.npz") as data:
        assert data["gap_ns"].max() == 2 * SECOND
    assert run("trajectory", bag, "map", "base", "--validity")[0] == 2


def test_a_dataset_has_the_gap_of_each_pose_on_request(bag, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    for validity in (False, True):
        query = TrajectoryQuery("map", "base", rate=10, validity=validity)
        assert query_recording(str(bag), query, str(tmp_path)).poses == 41
        (file,) = tmp_path.glob("[!_]*.parquet")
        columns = parquet.read_table(file).to_pydict()
        assert ("gap_ns" in columns) == validity
    assert columns["gap_ns"].count(2 * SECOND) == 19


def test_a_table_reports_refuses_or_marks_gaps(bag):
    pytest.importorskip("pyarrow")
    samples = 401 + 202
    with coframe.open_bag(bag) as recording:
        with pytest.warns(coframe.CoframeWarning, match=r"1 edge of the table has .* odom -> base for 2 s") as caught:
            assert recording.table().num_rows == samples
        assert [each.filename for each in caught] == [__file__]
        with pytest.raises(coframe.ExtrapolationException, match="odom -> base has no sample for 2 s"):
            recording.table(max_gap="200ms")
        assert recording.table(max_gap="2s").num_rows == samples
        assert recording.table(max_gap="200ms", on_gap="omit").num_rows == samples
        marked = recording.table(max_gap="200ms", on_gap="nan", validity=True).to_pydict()
        for options, error in (({"on_gap": "clip"}, ValueError), ({"max_gap": "0s"}, ValueError)):
            with pytest.raises(error):
                recording.table(**options)
    (row,) = np.flatnonzero(np.isnan(marked["x"]))
    assert len(marked["x"]) == samples + 1
    assert [marked[name][row] for name in ("stamp_ns", "parent", "child", "gap_ns")] == [
        at(200)[0],
        "odom",
        "base",
        2 * SECOND,
    ]
    assert np.isnan(marked["qw"][row])
    assert sorted(set(marked["gap_ns"])) == [0, PERIOD, 2 * SECOND]
    assert marked["x"][row + 1] == pytest.approx(3.0)


def test_many_lookups_before_a_change_of_the_parent_succeed():
    """At the latest time the frames are not connected, so there is nothing to say about gaps."""
    buffer = coframe.Buffer(None)
    for second in (1, 2):
        buffer.set("map", "base", coframe.Transform([second, 0, 0]), second * 1_000_000_000)
    buffer.set("odom", "base", coframe.Transform(), 9_000_000_000)
    assert buffer.lookup_many("map", "base", [1_500_000_000]).x.tolist() == [1.5]
