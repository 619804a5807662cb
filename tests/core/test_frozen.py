# SPDX-License-Identifier: Apache-2.0
"""Buffers saved to files: loading returns the saved data, and damaged files are safe."""

import concurrent.futures
import multiprocessing
import pickle
import random
import signal
import struct
import subprocess
import sys
import textwrap
import zlib

import numpy as np
import pytest

import coframe
from coframe.buffer import _frozen_file as frozen_file

SECOND = 1_000_000_000
SPAN = (SECOND, 20 * SECOND)


def filled():
    """Moving and static frames: one changed its parent, one was only named, one was removed."""
    buffer = coframe.Buffer(None)
    for i in range(1, 1001):
        at = i * SECOND // 50
        moved = coframe.Transform.from_rpy([i / 100, np.sin(i / 50), 0], [0, 0, i / 90])
        buffer.set("odom", "base", moved, at, authority="wheels")
        buffer.set("map", "odom", coframe.Transform([0, 0, i / 1000]), at, authority="slam")
    buffer.set("base", "lidar", coframe.Transform.from_rpy([0.1, 0, 0.3], [0, 0, 1]), static=True)
    for i, parent in enumerate(["map", "map", "base", "base"]):
        buffer.set(parent, "box", coframe.Transform([i, 0, 0]), (i + 1) * SECOND)
    buffer.set("map", "gone", coframe.Transform(), SECOND)
    buffer.remove_frame("gone")
    return buffer


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "run.cfz"
    filled().save(path)
    return path


def test_results_equal_those_of_the_buffer(path):
    buffer, loaded = filled(), coframe.load(path, verify=True)
    stamps = np.random.default_rng(3).integers(*SPAN, 2000)
    for pair in (("map", "lidar"), ("lidar", "map"), ("odom", "base")):
        assert loaded.lookup_many(*pair, stamps) == buffer.lookup_many(*pair, stamps)
        assert loaded.lookup(*pair) == buffer.lookup(*pair)
        assert loaded.lookup(*pair, int(stamps[0])) == buffer.lookup(*pair, int(stamps[0]))
        assert loaded.trajectory(*pair) == buffer.trajectory(*pair)
    for second in (1, 2, 3, 4):  # over the change of the parent
        assert loaded.lookup("map", "box", second * SECOND) == buffer.lookup("map", "box", second * SECOND)
    assert loaded.edges(now=0) == buffer.edges(now=0)
    assert loaded.frames() == buffer.frames()
    assert "gone" not in loaded
    assert loaded.cache_ns == buffer.cache_ns
    for name in ("map", "nobody"):
        with pytest.raises(coframe.TransformException) as expected:
            buffer.lookup("base", name, 3600 * SECOND)
        with pytest.raises(type(expected.value)) as found:
            loaded.lookup("base", name, 3600 * SECOND)
        assert (str(found.value), found.value.hint) == (str(expected.value), expected.value.hint)


def test_samples_of_a_pruned_cache_and_late_samples(tmp_path):
    """The first chunk of these samples does not begin with the first sample."""
    buffer = coframe.Buffer("5s")
    for i in [*range(1, 900), *range(850, 800, -1)]:
        buffer.set("map", "base", coframe.Transform([i, 0, 0]), i * SECOND // 50 + i % 2)
    buffer.save(tmp_path / "a.cfz")
    loaded = coframe.load(tmp_path / "a.cfz")
    assert loaded.trajectory("map", "base") == buffer.trajectory("map", "base")


def test_an_empty_buffer(tmp_path):
    coframe.Buffer().save(tmp_path / "a.cfz")
    assert coframe.load(tmp_path / "a.cfz", verify=True).frames() == []


def test_a_loaded_buffer_is_read_only(path):
    loaded = coframe.load(path)
    with pytest.raises(coframe.InvalidArgumentException, match="frozen") as caught:
        loaded.set("map", "base", coframe.Transform(), SECOND)
    assert "loaded file" in caught.value.hint
    loaded.clear()
    assert not loaded.remove_frame("lidar")
    assert loaded.lookup("map", "lidar")


def test_snapshots_and_errors_outlive_the_loaded_buffer(path):
    """Snapshots share its memory, and errors create their text later."""
    loaded = coframe.load(path)
    snapshot = loaded.snapshot()
    with pytest.raises(coframe.ExtrapolationException) as caught:
        loaded.lookup("map", "base", 3600 * SECOND)
    del loaded
    path.unlink()
    assert snapshot.lookup("map", "lidar") == filled().lookup("map", "lidar")
    snapshot.save(path)
    assert coframe.load(path).trajectory("map", "lidar") == filled().trajectory("map", "lidar")
    assert "extrapolation" in str(caught.value)


def ask(buffer, stamp):
    return buffer.lookup("map", "lidar", stamp).translation.tolist()


def test_worker_processes_open_the_file_themselves(path):
    loaded = coframe.load(path)
    assert len(pickle.dumps(loaded)) < len(str(path)) + 100
    with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(ask, loaded, 7 * SECOND).result() == ask(loaded, 7 * SECOND)


def test_a_file_is_complete_or_does_not_appear(path, monkeypatch):
    before = path.read_bytes()
    monkeypatch.setattr(frozen_file._core, "frozen_chunks", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        filled().save(path)
    assert path.read_bytes() == before
    assert list(path.parent.iterdir()) == [path]


def test_threads_save_to_one_path(path):
    buffer = filled()
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for saved in [pool.submit(buffer.save, path) for _ in range(40)]:
            saved.result()
    assert coframe.load(path, verify=True).trajectory("map", "lidar") == buffer.trajectory("map", "lidar")
    assert list(path.parent.iterdir()) == [path]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda _data: b"", "is not a frozen buffer"),
        (lambda data: b"SQLite format 3\0" + data[16:], "is not a frozen buffer"),
        (lambda data: data[:20], "is damaged: it is truncated"),
        (lambda data: data[:-1], "is damaged: it is truncated"),
        (lambda data: data[:8] + b"\x07" + data[9:], "has version 7 of the format"),
        (lambda data: data[:30] + b"\x07" + data[31:], "the checksum of the header is wrong"),
        (lambda data: data[:-3] + b"\x07" + data[-2:], "the checksum of the table is wrong"),
    ],
)
def test_damaged_files_are_refused_with_the_reason(path, change, says):
    path.write_bytes(change(path.read_bytes()))
    with pytest.raises(coframe.FrozenFileError, match=says) as caught:
        coframe.load(path)
    assert "\n" not in str(caught.value)
    assert caught.value.hint


def test_verify_finds_a_flipped_bit_in_the_samples(path):
    data = bytearray(path.read_bytes())
    data[4096 + 5000] ^= 1
    path.write_bytes(data)
    coframe.load(path)
    with pytest.raises(coframe.FrozenFileError, match="the checksum of the samples is wrong"):
        coframe.load(path, verify=True)


@pytest.mark.parametrize("where", ["nowhere/run.cfz", "."])
def test_paths_that_cannot_be_written_or_read(tmp_path, where):
    with pytest.raises(coframe.FrozenFileError, match="cannot be written"):
        filled().save(tmp_path / where)
    with pytest.raises(coframe.FrozenFileError, match="cannot be opened") as caught:
        coframe.load(tmp_path / where)
    assert "open_bag() reads recordings" in caught.value.hint


def sealed(data):
    """Return the file with checksums that match its content."""
    header = frozen_file.Header(*frozen_file._HEADER.unpack_from(data))
    table = data[header.table : header.table + header.table_size]
    data[: frozen_file._HEADER.size] = frozen_file._HEADER.pack(*header._replace(table_crc=zlib.crc32(table)))
    data[frozen_file._HEADER.size : frozen_file._HEADER.size + 4] = struct.pack(
        "<I", zlib.crc32(data[: frozen_file._HEADER.size])
    )
    return data


def mutated(rng, whole):
    """Return the file with random changes in header, table and samples, mostly with matching checksums."""
    data = bytearray(whole)
    header = frozen_file.Header(*frozen_file._HEADER.unpack_from(data))
    for _ in range(rng.choice([1, 2, 8])):
        start, end = rng.choice([(16, frozen_file._HEADER.size), (header.table, len(data)), (4096, header.table)])
        where = rng.randrange(start, end)
        piece = rng.choice([b"\xff", b"\0", b"\x7f", b"\xff" * 8, bytes(8), rng.randbytes(4), rng.randbytes(8)])
        data[where : where + len(piece)] = piece
    data = data[: len(whole)]
    return bytes(sealed(data)) if rng.random() < 0.9 else bytes(data)


def survives(path):
    """Return whether the file could be opened; if so, call everything that reads samples."""
    try:
        loaded = coframe.load(path)
    except coframe.FrozenFileError:
        return False
    stamps = np.array([0, *range(SECOND, 20 * SECOND, SECOND // 3), 2**63 - 1, -(2**63)])
    loaded.edges()
    loaded.encode(static=False)
    loaded.all_frames_as_yaml()
    loaded.all_frames_as_dot()
    names = [*loaded.frame_names(), "map", "lidar"]
    for target in names[:4]:
        for source in names[-4:]:
            try:
                loaded.lookup_many(target, source, stamps, on_error="nan", twist=True)
                loaded.lookup_many(target, source, stamps, on_error="nan", extrapolate="1s")
                for stamp in stamps[:20].tolist():
                    loaded.can_transform(target, source, stamp)
                loaded.trajectory(target, source, SECOND, 3 * SECOND)
            except (coframe.TransformException, ValueError):
                continue
    return True


def fuzz(path, cases, seed):
    whole, rng, opened = path.read_bytes(), random.Random(seed), 0
    for i in range(cases):
        target = path.with_name(f"{i % 2}.cfz")
        target.unlink(missing_ok=True)
        target.write_bytes(mutated(rng, whole))
        opened += survives(target)
    assert 0 < opened < cases


def test_mutated_files_are_safe(path):
    fuzz(path, 150, 5)


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_ten_thousand_mutated_files_are_safe(path):
    fuzz(path, 10_000, np.random.SeedSequence().entropy)


# A broken guard would end the test process, so the tests below run programs.
TRUNCATED = """
    import os, sys
    import numpy as np
    import coframe
    from coframe.buffer import frozen
    path, act, size = sys.argv[1], sys.argv[2], int(sys.argv[3])
    stamps = np.arange(1, 30_001) * 1_000_000
    source = coframe.Buffer(None)
    for parent, child in (("map", "odom"), ("odom", "base")):
        source.set_many(parent, child, stamps, np.tile([1.0, 0, 0, 0, 0, 0, 1], (len(stamps), 1)))
    source.save(path)
    assert os.path.getsize(path) > frozen.MAX_COPIED
    buffer, middle = coframe.load(path), int(stamps[15_000])
    buffer.lookup("map", "base", middle)
    snapshot = buffer.snapshot()
    os.truncate(path, size)
    try:
        print("returned", eval(act))
    except coframe.CoframeError as error:
        print(type(error).__name__, error)
    try:
        buffer.lookup("map", "base", middle)
    except coframe.CoframeError as error:
        print(type(error).__name__, error)
    coframe.Buffer().set("map", "base", coframe.Transform(), 1)
"""
can_truncate = pytest.mark.skipif(sys.platform == "win32", reason="Windows does not truncate files that are mapped")


def run(program, *arguments):
    """Run a program and return its exit code, what it prints and what it reports."""
    command = [sys.executable, "-c", textwrap.dedent(program), *map(str, arguments)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    return ended.returncode, ended.stdout, ended.stderr


@can_truncate
@pytest.mark.parametrize("size", [0, 5000])
@pytest.mark.parametrize(
    "act",
    [
        "buffer.lookup('map', 'base')",
        "buffer.lookup('map', 'base', middle, timeout='10ms')",
        "buffer.lookup_many('map', 'base', stamps, threads=2)",
        "snapshot.lookup('map', 'base', middle)",
        "buffer.can_transform('base', 'map', middle + 5)",
        "buffer.trajectory('map', 'base')",
        "buffer.edges()",
        "buffer.verify()",
        "buffer.save(path + '.copy')",
        "buffer.why('map', 'base')",
        "coframe.Buffer.snapshot(buffer).lookup('map', 'base')",
    ],
)
def test_a_large_file_that_is_truncated_raises_an_error(tmp_path, act, size):
    path = tmp_path / "run.cfz"
    code, output, errors = run(TRUNCATED, path, act, size)
    assert (code, errors) == (0, "")
    lines = output.splitlines()
    assert len(lines) == 2
    for line in lines:
        assert line.startswith(f"FrozenFileError {path} was truncated by another program while it was in use.")
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("content", [b"", b"x" * 5000, bytes(200_000)])
def test_a_small_file_can_be_overwritten_while_it_is_in_use(path, content):
    buffer, saved = coframe.load(path), filled()
    path.write_bytes(content)
    for second in range(1, 21):
        assert buffer.lookup("map", "lidar", second * SECOND) == saved.lookup("map", "lidar", second * SECOND)
    buffer.verify()


def test_a_file_that_is_saved_again_does_not_change_what_was_loaded(path):
    buffer = coframe.load(path)
    coframe.Buffer(None).save(path)
    buffer.verify()
    assert "lidar" in buffer
    assert "lidar" not in coframe.load(path)


@can_truncate
def test_other_bus_errors_still_end_the_process(tmp_path):
    program = """
        import faulthandler, mmap, os, sys
        import coframe
        if sys.argv[2] == "faulthandler":
            faulthandler.enable()
        coframe.Buffer().save(sys.argv[1])
        kept = coframe.load(sys.argv[1])
        with open(sys.argv[1] + ".other", "w+b") as file:
            file.write(bytes(100_000))
            file.flush()
            memory = mmap.mmap(file.fileno(), 0)
            file.truncate(0)
        memory[50_000]
    """
    assert run(program, tmp_path / "run.cfz", "nothing") == (-signal.SIGBUS, "", "")
    code, _, errors = run(program, tmp_path / "run.cfz", "faulthandler")
    assert code == -signal.SIGBUS
    assert "Fatal Python error: Bus error" in errors
