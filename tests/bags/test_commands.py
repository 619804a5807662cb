# SPDX-License-Identifier: Apache-2.0
"""The commands coframe lookup, trajectory and bag info."""

import json

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from recordings import COUNT, SECOND, START
from runs import Run

import coframe
from coframe.cli.app import app


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return recordings.write_mcap(tmp_path_factory.mktemp("bag") / "walk.mcap")


def run(*arguments):
    """Run a command; return (exit code, stdout, stderr)."""
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert "Traceback" not in result.output
    return result.exit_code, result.stdout, result.stderr


@pytest.mark.parametrize(
    ("text", "stamp"),
    [
        ("1700000001.050000021", START + 1_050_000_021),
        ("1700000001050000021", START + 1_050_000_021),
        ("1700000001", START + SECOND),
        ("1s", START + SECOND),
        ("+1050ms", START + 1_050_000_000),
        ("-1s", START + (COUNT - 1) * (SECOND // 20 + 1) - SECOND),
        ("2023-11-14T22:13:21.050000021Z", START + 1_050_000_021),
        ("2023-11-15 00:13:21.05+02:00", START + 1_050_000_000),
        ("start", START),
        ("end", START + (COUNT - 1) * (SECOND // 20 + 1)),
    ],
)
def test_times_keep_their_nanoseconds(bag, text, stamp):
    code, out, _ = run("lookup", bag, "odom", "lidar", "--at", text, "--json")
    assert code == 0
    found = json.loads(out)
    assert found["stamp_ns"] == stamp
    expected = recordings.expected().lookup("odom", "lidar", stamp)
    assert found["translation"] == pytest.approx(expected.translation.tolist(), abs=1e-14)
    assert found["quaternion"] == pytest.approx(expected.quaternion.tolist(), abs=1e-14)


def test_end_is_the_latest_common_time(tmp_path):
    """Each transform is its own message, so one edge always ends before the recording does."""
    rows = [
        ("/tf", START + i, recordings.cdr("odom", "base", coframe.Transform([i, 0, 0]), START + i)) for i in range(3)
    ]
    rows.append(("/tf", START + 9, recordings.cdr("base", "arm", coframe.Transform(), START + 1)))
    rows.append(("/tf", START + 9, recordings.cdr("base", "arm", coframe.Transform(), START + 9)))
    path = recordings.write_mcap(tmp_path / "separate.mcap", rows=rows)
    code, out, error = run("lookup", path, "odom", "arm", "--at", "end", "--json")
    assert code == 0, error
    assert json.loads(out)["stamp_ns"] == START + 2
    assert run("why", path, "odom", "arm", "--at", "end")[0] == 0
    code, out, error = run("lookup", path, "odom", "arm", "--at", "end", "--fixed", "odom", "--source-time", "end")
    assert code == 0, error


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("soon", "is not a point in time"),
        ("1.0000000001", "more than nine decimals"),
        ("2023-11-14T22:13:21", "has no time zone"),
        ("2023-13-14T22:13:21Z", "is not a point in time"),
        ("10 parsecs", "is not a duration"),
        ("99999999999999999999", "is after the year 2262"),
        ("9" * 5000, "is after the year 2262"),
        ("nan", "is not a point in time"),
        ("", "is not a point in time"),
    ],
)
def test_invalid_times_are_errors(bag, text, reason):
    code, out, error = run("lookup", bag, "odom", "lidar", "--at", text)
    assert (code, out) == (2, "")
    assert reason in error
    assert error.startswith("coframe: --at: ")


def test_lookup_prints_like_echo(bag):
    code, out, error = run("lookup", bag, "base", "lidar", "-p", "2")
    assert (code, error) == (0, "")
    assert "- Translation: [0.10, 0.00, 0.30]\n" in out
    assert "- Rotation: in RPY (degree) [0.00, 0.00, 57.30]\n" in out


def test_time_travel(bag):
    code, out, _ = run("lookup", bag, "base", "base", "--at", "2s", "--fixed", "odom", "--source-time", "1s", "--json")
    assert code == 0
    expected = recordings.expected()._lookup_full("base", START + 2 * SECOND, "base", START + SECOND, "odom")
    assert json.loads(out)["translation"] == pytest.approx(expected.translation.tolist(), abs=1e-12)
    code, _, error = run("lookup", bag, "base", "base", "--fixed", "odom")
    assert (code, error) == (2, "coframe: --fixed requires --source-time\n  Time travel requires both options.\n")


@pytest.mark.parametrize(
    ("arguments", "reason", "hint"),
    [
        (("odom", "lider"), '"lider" passed to lookupTransform argument source_frame does not exist', "'lidar'"),
        (("odom", "base", "--at", "1h"), "Lookup would require extrapolation into the future", "base and odom from"),
    ],
)
def test_a_failed_lookup_prints_one_sentence_and_a_hint(bag, arguments, reason, hint):
    code, out, error = run("lookup", bag, *arguments)
    assert (code, out) == (1, "")
    assert reason in error
    assert hint in error
    assert len(error.splitlines()) == 2


@pytest.mark.parametrize(
    ("arguments", "frames"),
    [
        (("odom", "lidar", "--at", "1h"), "lidar and odom"),
        (("lidar", "base", "--at", "1s", "--fixed", "odom", "--source-time", "-1h"), "base, lidar and odom"),
    ],
)
def test_a_time_outside_the_recording_prints_the_valid_range(bag, arguments, frames):
    last = (COUNT - 1) * (SECOND // 20 + 1)
    code, _, error = run("lookup", bag, *arguments)
    assert code == 1
    expected = (
        f"The recording has transforms between {frames} from 1700000000.000000000 to 1700000002.{last % SECOND:09d}"
    )
    assert f"{expected}, i.e. --at 0s to 2.{last % SECOND:09d}s." in error
    assert "wait for it" not in error


@pytest.mark.parametrize(
    ("stamps", "at", "text"),
    [
        ([START + i * SECOND // 10 for i in range(5)], "50s", "no common time"),
        ([0] * 5, "1s", "odom -> base"),
    ],
)
def test_hint_names_edges_without_a_common_time(tmp_path, stamps, at, text):
    run_ = Run()
    for i, stamp in enumerate(stamps):
        run_.tf("odom", "base", stamp, arrived=START + i)
        run_.tf("base", "arm", START + 100 * SECOND + i, arrived=START + 100 * SECOND + i)
    code, _, error = run("lookup", run_.write(tmp_path), "odom", "arm", "--at", at)
    assert code == 1
    assert text in error
    assert "use a longer cache" not in error


def test_ctrl_c_before_completion_exits_with_130(bag, tmp_path, monkeypatch):
    from coframe.bags import _bag_repair as bag_repair
    from coframe.bags import _contents as contents

    def interrupted(*_arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr(bag_repair._Repair, "_repair_message", interrupted)
    assert run("bag", "fix", bag, tmp_path / "new")[0] == 130
    assert list(tmp_path.iterdir()) == []
    monkeypatch.setattr(contents._ReadState, "read", interrupted)
    for command in (("bag", "info", bag), ("lookup", bag, "odom", "base"), ("trajectory", bag, "odom", "base")):
        assert run(*command) == (130, "", "")


def test_missing_recording_is_reported(tmp_path):
    for command in (
        ("lookup", tmp_path / "x", "a", "b"),
        ("trajectory", tmp_path / "x", "a", "b"),
        ("bag", "info", "x"),
    ):
        code, out, error = run(*command)
        assert (code, out) == (1, "")
        assert "cannot be read: No such file" in error


def samples():
    stamps = np.array([at for topic, at, *_ in recordings.walk() if topic == "/tf"])
    poses = recordings.expected().lookup_many("odom", "lidar", stamps)
    return stamps, np.concatenate([poses.translation, poses.quaternion], axis=1), poses.matrix


def test_trajectories_in_every_format(bag, tmp_path):
    stamps, values, matrices = samples()
    for name in ("a.tum", "a.kitti", "a.csv", "a.npz", "a.parquet"):
        if name.endswith("parquet"):
            pytest.importorskip("pyarrow")
        code, out, error = run("trajectory", bag, "odom", "lidar", "-o", tmp_path / name)
        assert (code, error) == (0, "")
        assert f"{COUNT} poses from 1700000000.000000000 to 1700000002.950000059" in out
    lines = [line.split() for line in (tmp_path / "a.tum").read_text().splitlines()]
    assert [int(line[0].replace(".", "")) for line in lines] == stamps.tolist()
    np.testing.assert_allclose([[float(word) for word in line[1:]] for line in lines], values, atol=1e-14)
    np.testing.assert_allclose(np.loadtxt(tmp_path / "a.kitti").reshape(-1, 3, 4), matrices[:, :3], atol=1e-14)
    table = (tmp_path / "a.csv").read_text().splitlines()
    assert table[0] == "stamp_ns,x,y,z,qx,qy,qz,qw"
    assert [int(line.partition(",")[0]) for line in table[1:]] == stamps.tolist()
    with np.load(tmp_path / "a.npz") as arrays:
        assert (arrays["stamps"] == stamps).all()
        assert (str(arrays["target"]), str(arrays["source"])) == ("odom", "lidar")
        np.testing.assert_allclose(arrays["quaternion"], values[:, 3:], atol=1e-14)
    from pyarrow import parquet

    read = parquet.read_table(tmp_path / "a.parquet")
    assert read["stamp_ns"].to_pylist() == stamps.tolist()
    np.testing.assert_allclose(read["x"].to_numpy(), values[:, 0], atol=1e-14)
    assert read.schema.metadata[b"target"] == b"odom"


def test_trajectories_at_other_times(bag, tmp_path):
    code, out, _ = run("trajectory", bag, "odom", "base", "--rate", "100", "--start", "1s", "--stop", "2s")
    assert code == 0
    stamps = [int(line.split()[0].replace(".", "")) for line in out.splitlines()]
    assert stamps == [START + SECOND + i * SECOND // 100 for i in range(101)]

    early = ("/other", START - SECOND, recordings.cdr("x", "y", coframe.Transform(), START - SECOND))
    late = ("/other", START + SECOND, recordings.cdr("x", "y", coframe.Transform(), START + SECOND))
    other = recordings.write_mcap(tmp_path / "b.mcap", rows=[*recordings.messages(), early, late])
    code, out, error = run("trajectory", other, "odom", "base", "--stamps-of", "other", "-f", "csv")
    assert code == 0
    assert out.splitlines()[1].startswith(f"{START + SECOND},")
    assert len(out.splitlines()) == 2
    assert error == "coframe: no transform at 1 of 2 times; those are omitted\n"


@pytest.mark.parametrize(
    ("arguments", "code", "reason"),
    [
        (("-o", "x.mat"), 2, "Unknown suffix of"),
        (("-f", "xls"), 2, "unknown format 'xls'"),
        (("-f", "npz"), 2, "Give a file: -o FILE"),
        (("--rate", "0"), 2, "must be above 0"),
        (("--rate", "nan"), 2, "must be above 0"),
        (("--rate", "1", "--stamps-of", "tf"), 2, "mutually exclusive"),
        (("--stamps-of", "gone"), 1, "has no topic 'gone'"),
        (("--rate", "1", "--start", "1h"), 1, "No stamps between"),
        (("--start", "1h"), 1, "No stamps between"),
        (("--start", ""), 2, "'' is not a point in time"),
        (("--stop", ""), 2, "'' is not a point in time"),
        (("-o", "/nowhere/x.tum"), 1, "cannot be written: No such file"),
    ],
)
def test_invalid_trajectory_options_are_errors(bag, arguments, code, reason):
    found, out, error = run("trajectory", bag, "odom", "base", *arguments)
    assert (found, out) == (code, "")
    assert reason in error


def test_bag_info(bag):
    code, out, error = run("bag", "info", bag)
    assert (code, error) == (0, "")
    assert "received  2023-11-14 22:13:20.000 UTC to 2023-11-14 22:13:22.950 UTC, 2.950000059 s" in out
    assert "tree with root odom: 3 frames" in out
    code, out, _ = run("bag", "info", bag, "--json")
    summary = json.loads(out)
    assert summary["trees"] == [{"root": "odom", "size": 3}]
    assert summary["span"] == [START, START + (COUNT - 1) * (SECOND // 20 + 1)]
    edges = {edge["child"]: edge for edge in summary["edges"]}
    assert edges["lidar"]["static"]
    assert edges["base"]["samples"] == COUNT
    assert edges["base"]["longest_gap"] == SECOND // 20 + 1
    assert {topic["name"]: topic["messages"] for topic in summary["topics"]} == {"/tf": COUNT, "/tf_static": 1}


def test_bag_info_shows_the_beginning_of_a_huge_tree(tmp_path):
    buffer = coframe.Buffer(None)
    for i in range(600):
        buffer.set("root", f"frame_{i}", coframe.Transform([1, 2, 3]), START)
    path = recordings.write_mcap(tmp_path / "huge.mcap", rows=[("/tf", START, buffer.encode(static=False))])
    code, out, _ = run("bag", "info", path)
    assert (code, out.count("\nroot ")) == (0, 500)
    assert "100 more edges. All of them: coframe bag info --json" in out
    code, out, _ = run("bag", "info", path, "--json")
    assert len(json.loads(out)["edges"]) == 600


def test_bag_info_shows_which_sensors_can_be_transformed(shared):
    code, out, _ = run("bag", "info", shared / "recordings" / "tilt_laser.bag", "--json")
    assert code == 0
    sensors = {sensor["topic"]: sensor for sensor in json.loads(out)["sensors"]}
    assert sensors["/imu_data"]["why_not"] == "No frame named 'base_imu': no transform contains it."
    assert sensors["/scan"]["root"] == "tilt_base"
    assert 170 < sensors["/scan"]["possible"] <= 178


def test_bag_info_of_two_trees(shared):
    code, out, _ = run("bag", "info", shared / "recordings" / "tb3_tf_missing_static")
    assert code == 0
    assert "tree with root base_link: 3 frames" in out
    assert "tree with root odom: 2 frames" in out


def test_problems_go_to_stderr(bag, tmp_path):
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(bag.read_bytes()[:4000])
    code, out, error = run("lookup", cut, "odom", "base", "--json")
    assert code == 0
    assert json.loads(out)["target"] == "odom"
    assert error.endswith("coframe: cut.mcap: truncated at byte 4000 of 4000; the recorder may have been killed\n")


def test_control_characters_in_names_are_not_printed(tmp_path):
    evil = "\x1b]0;evil\x07"
    rows = [(topic, at, data.replace(b"lidar", b"\x1b[2Jx")) for topic, at, data in recordings.messages()]
    rows.append((f"/{evil}", START, b"?"))
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={f"/{evil}": ("a/msg/B", "", b"", "other")})
    code, out, error = run("bag", "info", path)
    assert code == 0
    assert "\x1b" not in out + error
    assert "\x07" not in out + error
