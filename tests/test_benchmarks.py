# SPDX-License-Identifier: Apache-2.0
"""The arithmetic of `make bench`, with contenders whose results are known, and one row for each target."""

import contextlib
import itertools

import pytest
from benchmarks import __main__ as bench
from benchmarks import report
from benchmarks.measuring import (
    AddsAtMost,
    AtLeast,
    AtMost,
    Effort,
    GrowsAtMost,
    MissingPeerError,
    Row,
    TimesAsFast,
    measure,
    nanoseconds,
)
from benchmarks.process import OWN_PYTHON, PeerError, Program, RemoteStatement, Worker
from benchmarks.rows import ROWS
from benchmarks.statement import Statement

EFFORT = Effort(rounds=5, seconds=60.0)


class Fake:
    """Returns given results and records the turns; the first result is for the warm-up."""

    def __init__(self, name, figures, turns=None):
        self.name, self.figures, self.turns = name, itertools.chain([1.0], figures), turns

    def sample(self):
        if self.turns is not None:
            self.turns.append(self.name)
        return next(self.figures)


def row(ours, theirs, target=None, name="work", **more):
    """Return a row with these results; an exception instead of results is raised."""

    def contenders():
        for figures in (ours, theirs):
            if isinstance(figures, Exception):
                raise figures
            yield Fake("", figures)

    return Row(name, "peer", contenders, target, **more)


def test_contenders_take_turns():
    turns = []
    ended = []

    def contenders():
        with contextlib.closing(contextlib.ExitStack()) as stack:
            stack.callback(ended.append, True)
            yield Fake("ours", [1.0] * 5, turns)
            yield Fake("theirs", [1.0] * 5, turns)

    measure(Row("work", "peer", contenders), EFFORT)
    assert turns == ["ours", "theirs"] * 6
    assert ended, "the contenders were not ended"


def test_the_ratio_is_the_median_of_the_rounds_not_the_ratio_of_the_medians():
    # The machine was half as fast in two rounds, for both contenders.
    result = measure(row([10, 20, 10, 20, 10], [50, 100, 70, 100, 30]), EFFORT)
    assert sorted(their / our for our, their in zip(result.ours, result.theirs, strict=True)) == [3, 5, 5, 5, 7]
    assert result.ratio == (5, 5, 5)
    assert report.Spread.of([1.0, 2.0, 3.0, 4.0, 5.0]) == (2, 3, 4)
    assert report.cells(result)[1:6] == ("10.0 ns", "peer", "70.0 ns", "5.00x", "5.00 - 5.00")


@pytest.mark.parametrize(
    ("target", "ours", "theirs", "verdict"),
    [
        (TimesAsFast(5), [10] * 5, [50] * 5, "met"),
        (TimesAsFast(5), [10] * 5, [49] * 5, "MISSED"),
        (TimesAsFast(5), [10] * 5, MissingPeerError("apt-get install peer"), "skipped"),
        (TimesAsFast(5), AttributeError("no such call"), [50] * 5, "ERROR"),
        (TimesAsFast(5), [10] * 5, PeerError("it crashed"), "ERROR"),
        (AtMost(10), [9, 9, 10, 99, 99], [1] * 5, "met"),
        (AtMost(10), [9, 9, 10.1, 99, 99], [1] * 5, "MISSED"),
        (AtMost(10), [11] * 5, MissingPeerError("peer"), "MISSED"),
        (GrowsAtMost(2), [20] * 5, [10] * 5, "met"),
        (GrowsAtMost(2), [21] * 5, [10] * 5, "MISSED"),
        (None, [10] * 5, [1] * 5, ""),
        (None, [10] * 5, MissingPeerError("peer"), "skipped"),
        (None, ValueError("no"), [1] * 5, "error"),
    ],
)
def test_targets_are_checked(target, ours, theirs, verdict, capsys):
    one = row(ours, theirs, target)
    assert measure(one, EFFORT).verdict == verdict
    assert bench.run([one], EFFORT, None) == (verdict in {"MISSED", "ERROR"})
    printed = capsys.readouterr().out
    for reason in (ours, theirs):
        if isinstance(reason, Exception):
            assert str(reason) in printed


def test_one_missed_target_fails_the_run(capsys):
    rows = [row([10] * 5, [50] * 5, TimesAsFast(5)), row([10] * 5, [40] * 5, TimesAsFast(5), name="slow work")]
    assert bench.run(rows, EFFORT, None) == 1
    assert "1 of 2 targets are met, 0 skipped.\nMISSED: slow work (≥ 5x): 10.0 ns, 4.00x" in capsys.readouterr().out


def test_a_row_ends_after_its_rounds_or_its_time():
    assert len(measure(row([1.0] * 99, [1.0] * 99), Effort(rounds=9)).ours) == 9
    assert len(measure(row([1.0] * 99, [1.0] * 99, least=3), Effort(rounds=9, seconds=0.0)).ours) == 3
    assert len(measure(row([1.0] * 99, [1.0] * 99, least=3), Effort(rounds=9, seconds=0.0, least=2)).theirs) == 2


def test_only_a_full_run_writes_the_page_with_all_rows_and_the_machine(tmp_path, monkeypatch, capsys):
    page = tmp_path / "RESULTS.md"
    monkeypatch.setattr(bench, "RESULTS", page)
    monkeypatch.setattr(bench, "ROWS", {"subject": [row([10.0] * 99, [50.0] * 99, TimesAsFast(5))]})
    for arguments in (["--quick"], ["--rows", "work"]):
        monkeypatch.setattr("sys.argv", ["bench", *arguments])
        assert bench.main() == 0
        assert not page.exists()
    monkeypatch.setattr("sys.argv", ["bench"])
    assert bench.main() == 0
    text = page.read_text()
    assert "| work | 10.0 ns | peer | 50.0 ns | 5.00x | 5.00 - 5.00 | ≥ 5x | met |" in text
    for fact in ("Date", "Command: make bench\n", "Machine", "Python", "numpy ", "transform-tree ", "python3-tf2 "):
        assert fact in text
    assert str(page) in capsys.readouterr().out


def test_rows_are_chosen_by_subject_or_by_a_word_of_their_name():
    assert bench.chosen(["startup"]) == ROWS["startup"]
    assert all("deskew" in row.name for row in bench.chosen(["deskew"]))
    assert len(bench.chosen([])) == sum(map(len, ROWS.values()))


def test_times_have_a_suitable_unit():
    formatted = [nanoseconds(value) for value in (6.54, 999.4, 9_999.0, 12_345.0, 123_456.0, 60e6, 12e9)]
    assert formatted == ["6.5 ns", "999 ns", "9999 ns", "12.3 us", "123 us", "60.0 ms", "12.0 s"]


def test_the_time_of_a_statement_excludes_the_setup_and_is_per_item():
    now = 0

    def spend(nanoseconds):
        nonlocal now
        now += nanoseconds

    statement = Statement("spend(600)", {"spend": spend}, setup="spend(10**6)", items=3, clock=lambda: now)
    assert statement.sample() == 200
    assert statement.sample() == 200


def test_the_number_of_runs_per_setup_is_limited():
    statement = Statement(
        "next(left)", {"iter": iter}, setup="left = iter([1, 2, 3])", limit=3, clock=itertools.count().__next__
    )
    assert statement.sample() > 0


def test_statements_can_be_timed_in_another_python():
    with contextlib.closing(Worker(OWN_PYTHON, "benchmarks.peers.tf2")) as worker:
        assert RemoteStatement(worker, "lookup", 1).sample() > 0
        with pytest.raises(PeerError, match="no attribute 'jump'"):
            RemoteStatement(worker, "jump").sample()
        assert RemoteStatement(worker, "can_transform", 1).sample() > 0
    with (
        contextlib.closing(Worker(OWN_PYTHON, "benchmarks.peers.unknown")) as worker,
        pytest.raises(PeerError, match="No module named"),
    ):
        RemoteStatement(worker, "lookup", 1).sample()


def test_a_program_is_a_contender_that_prints_its_results():
    assert Program("-c", "print(1.5, 2)").sample() == 1.5
    with pytest.raises(PeerError, match="ValueError: not today"):
        Program("-c", "raise ValueError('not today')").sample()


# The targets of the project.
ROS_WHEELS = "ROS 2 Jazzy's rclpy on Fast DDS, from wheels"
TARGETS = [
    ("50th node of a process", "2nd to 5th", GrowsAtMost(1.5)),
    ("50th node of a process", "ROS 2 Jazzy's rclpy on Fast DDS, from wheels", TimesAsFast(1.9)),
    ("create_publisher beside 50 nodes", "ROS 2 Jazzy's rclpy on Fast DDS, from wheels", TimesAsFast(1.5)),
    ("create_subscription beside 50 nodes", "ROS 2 Jazzy's rclpy on Fast DDS, from wheels", TimesAsFast(2.0)),
    ("get_topic_names_and_types of 50 nodes", "ROS 2 Jazzy's rclpy on Fast DDS, from wheels", TimesAsFast(1.3)),
    ("destroy_node beside 50 nodes", "ROS 2 Jazzy's rclpy on Fast DDS, from wheels", TimesAsFast(3.8)),
    ("lookup, newest, D=1", "Debian's tf2", TimesAsFast(35)),
    ("lookup, newest, D=5", "Debian's tf2", TimesAsFast(25)),
    ("lookup, newest, D=10", "Debian's tf2", TimesAsFast(18)),
    ("lookup, newest, D=50", "Debian's tf2", TimesAsFast(10)),
    ("lookup at a time, D=1", "tf_tree, Plan.at", TimesAsFast(2.5)),
    ("lookup at a time, D=5", "tf_tree, Plan.at", TimesAsFast(3)),
    ("tf2_py: lookup_transform_core, D=5", "Debian's tf2", TimesAsFast(8)),
    ("can_transform, newest, D=5", "Debian's tf2", TimesAsFast(12)),
    ("can_transform at a time, D=5", "Debian's tf2", TimesAsFast(12)),
    ("failing lookup, caught, D=5", "Debian's tf2", TimesAsFast(10)),
    ("tf2_py: set_transform(message)", "Debian's tf2", TimesAsFast(3)),
    ("set, from numbers", "Debian's tf2", TimesAsFast(8)),
    ("lookup, newest, in shared transforms, D=5", "coframe, own memory", GrowsAtMost(1.3)),
    ("lookup at a time in shared transforms, D=5", "coframe, own memory", GrowsAtMost(1.3)),
    ("ingest a TFMessage of 10, per transform", "floor: copying the bytes", AtMost(60)),
    ("ingest a TFMessage of 10, per transform", "rosbags, decoding only", TimesAsFast(50)),
    ("lookup_many, N=1e5, sorted, D=5, into an array", "tf_tree, Plan", TimesAsFast(5)),
    ("lookup_many, N=1e5, random, D=5, into an array", "tf_tree, Plan", TimesAsFast(5)),
    ("lookup_many, N=1e6, random, D=10, n=1e5, per edge", "floor: sorted, n=100", AtMost(15)),
    ("set_many, N=1e5, in order, per sample", "floor: copying the arrays", AtMost(10)),
    ("transform_cloud, 1e5 points, per point", "Debian's tf2", TimesAsFast(500)),
    ("transform_cloud, 1e5 points, per point", "floor: copying the bytes", AtMost(3)),
    ("deskew, 1e6 points, distinct times, D=1, per point", "floor: copying the points", AtMost(10)),
    ("exp, N=1e5, each", "SciPy", TimesAsFast(4)),
    ("log, N=1e5, each", "SciPy", TimesAsFast(4)),
    ("compose, N=1e5, each", "SciPy", TimesAsFast(4)),
    ("inverse, N=1e5, each", "SciPy", TimesAsFast(4)),
    ("interpolate, N=1e5, each", "SciPy", TimesAsFast(4)),
    ("exp, N=1e5, each", "pytransform3d", TimesAsFast(2)),
    ("log, N=1e5, each", "pytransform3d", TimesAsFast(2)),
    ("compose, N=1e5, each", "pytransform3d", TimesAsFast(2)),
    ("interpolate along screws, N=1e5, each", "pytransform3d", TimesAsFast(2)),
    ("exp, N=1e5, each", "jaxlie on the CPU", TimesAsFast(5)),
    ("log, N=1e5, each", "jaxlie on the CPU", TimesAsFast(5)),
    ("compose, N=1e5, each", "jaxlie on the CPU", TimesAsFast(5)),
    ("exp, N=1e5, each", "Pinocchio in a loop", TimesAsFast(10)),
    ("log, N=1e5, each", "Pinocchio in a loop", TimesAsFast(10)),
    ("compose, N=1e5, each", "Pinocchio in a loop", TimesAsFast(10)),
    ("interpolate along screws, N=1e5, each", "Pinocchio in a loop", TimesAsFast(10)),
    ("talos, 1e5 configurations, new transforms, each", "Pinocchio in a loop, poses kept", TimesAsFast(20)),
    ("talos, 1e5 configurations, into an array, each", "Pinocchio in a loop, poses kept", TimesAsFast(20)),
    ("talos, one configuration", "Pinocchio, poses kept", TimesAsFast(5)),
    ("listener, 1 kHz x 10, CPU of one core", "floor: a bare UDP socket", GrowsAtMost(1.25)),
    ("listener, 1 kHz x 10, latency, p50", "floor: a bare UDP socket", GrowsAtMost(1.3)),
    ("sendTransform, 1 transform, time of a call", "floor: bare UDP sockets", GrowsAtMost(1.5)),
    ("publish, PointCloud2 of 1 MB, time of a call", "ROS 2's rclpy", TimesAsFast(2)),
    ("receive, PointCloud2 of 1 MB, processor time", "ROS 2's rclpy", TimesAsFast(3)),
    (
        "relay, 10 robots x 20 x 50 Hz, nothing lost, CPU of one core",
        "floor: no relay, the listener renames the frames",
        AtMost(10.0),
    ),
    (
        "Zenoh router, 100 robots x 20 x 50 Hz: CPU of router and listener",
        "10 times that of 10 robots",
        GrowsAtMost(1.2),
    ),
    ("coframe doctor, MCAP of 1e6 transforms, wall clock", "floor: open_bag only", AtMost(3e9)),
    ("coframe doctor, MCAP of 1e6 transforms, processor", "floor: open_bag only", AtMost(3e9)),
    ("coframe doctor --watch, 1 kHz x 10, CPU of one core", "floor: a listening buffer", AtMost(5)),
    ("open_bag, MCAP, zstd, per transform", "rosbags, reading and decoding only", TimesAsFast(10)),
    ("open_bag, MCAP, zstd, per transform", "tf_tree.ingest_bag", TimesAsFast(1)),
    ("open_bag, SQLite, per transform", "rosbags, reading and decoding only", TimesAsFast(10)),
    ("edit, a topic renamed, per message", "pymcap-cli process", TimesAsFast(1)),
    ("edit, a topic dropped, per message", "pymcap-cli process", TimesAsFast(1)),
    ("edit, log times shifted, per message", "pymcap-cli process", TimesAsFast(1)),
    ("load of a frozen file, 1e7 transforms", "floor: open it and read a page", AtMost(5_000_000)),
    ("lookup_many at 1e5 random times, all, D=5, n=2e6", "the same, in order", AtMost(100_000_000)),
    ("lookup_many at 1e5 random times, frozen, D=5, n=2e6", "the same in memory", GrowsAtMost(1.5)),
    ("lookup at 1e5 times in order, frozen, D=5, n=2e6", "the same in memory", GrowsAtMost(1.5)),
    ("peak memory of a process, 1e7 transforms set", "floor: NumPy arrays", AtMost(1e9)),
    ("peak memory of a process, 1e7 transforms from an MCAP", "floor: NumPy arrays", AtMost(1e9)),
    ("lookup, newest, D=1, n=1e6", "the same, n=100", GrowsAtMost(2)),
    ("lookup at an old time, D=1, n=1e6", "the same, n=100", GrowsAtMost(2)),
    ("lookup at increasing times, D=1, n=1e6", "the same, n=100", GrowsAtMost(2)),
    ("memory per stored transform", "floor: NumPy arrays", AtMost(80)),
    ("start a program that does not use coframe", "without coframe", AddsAtMost(500_000)),
    ("import coframe after numpy, use Buffer", "floor: import numpy", AtMost(60_000_000)),
    ("rclpy.init() and a node", "floor: a bare DDS participant", AtMost(60_000_000)),
    ("idle node with a TransformListener, spin(), CPU of one core", "floor: a bare DDS participant", AtMost(0.5)),
    ("idle node, spin_once(timeout_sec=0.5) in a loop, CPU of one core", "floor: a bare DDS participant", AtMost(0.5)),
    ("Image of 1 MB over Fast DDS, latency, p50", "coframe over Cyclone DDS", TimesAsFast(2)),
    ("Image of 1 MB over Fast DDS, latency, p50", ROS_WHEELS, TimesAsFast(2)),
    ("Image of 1 MB over Fast DDS, sender, processor time", "coframe over Cyclone DDS", TimesAsFast(1)),
    ("Image of 1 MB over Fast DDS, sender, processor time", ROS_WHEELS, TimesAsFast(2)),
    ("Image of 1 MB over Fast DDS, receiver, processor time", "coframe over Cyclone DDS", TimesAsFast(1)),
    ("Image of 1 MB over Fast DDS, receiver, processor time", ROS_WHEELS, TimesAsFast(2)),
    ("clouds of 40 MB over Fast DDS, reliable, received of 10", "coframe over Cyclone DDS", AtLeast(10)),
    ("clouds of 40 MB over Fast DDS, reliable, received of 10", ROS_WHEELS, AtLeast(10)),
    ("clouds of 40 MB over Fast DDS, best effort, received of 10", "coframe over Cyclone DDS", AtLeast(10)),
    ("clouds of 40 MB over Fast DDS, best effort, received of 10", ROS_WHEELS, AtLeast(10)),
    ("a tab of the viewer, 10 frames at 30 Hz, CPU of one core", "the lookups alone", AtMost(3)),
    ("a tab of the viewer, 100 frames at 30 Hz, CPU of one core", "the lookups alone", AtMost(3)),
    ("a tab of the viewer, 1000 frames at 30 Hz, CPU of one core", "the lookups alone", AtMost(5)),
]


def test_every_target_has_its_row():
    rows = {(row.name, row.reference, row.target) for row in bench.chosen([]) if row.target}
    assert rows == set(TARGETS)


def test_a_program_that_does_not_end_is_ended_with_a_sentence():
    waits = Program(
        "-c", "import sys, time; print('a message', file=sys.stderr, flush=True); time.sleep(60)", time_limit=1
    )
    with pytest.raises(PeerError, match="ended after 1 s, waiting for a message: "):
        waits.sample()
    worker = Worker(OWN_PYTHON, "time", time_limit=1)
    with pytest.raises(PeerError, match="ended after 1 s, waiting for the result of"):
        RemoteStatement(worker, "sleep", 60).sample()
    worker.close()
