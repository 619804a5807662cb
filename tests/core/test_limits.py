# SPDX-License-Identifier: Apache-2.0
"""What other nodes can make a buffer store has limits, with counters; the program itself has none."""

import platform
import subprocess
import sys
import time

import numpy as np
import pytest

import coframe

FRAMES, NAME_BYTES, SAMPLES = 250_000, 64 << 20, 1 << 20

TREE = """
import sys
from pathlib import Path
import coframe

def memory():
    return int(next(line for line in Path("/proc/self/status").open() if line.startswith("RssAnon")).split()[1])

buffer, pose, before = coframe.Buffer(None), coframe.Transform(), memory()
for second in range(1, 1 + int(sys.argv[1])):
    for number in range(5000):
        buffer.set("map", f"frame_{number}", pose, second * 1_000_000_000)
print((memory() - before) / 5000)
"""


def static(*edges):
    source = coframe.Buffer()
    for parent, child in edges:
        source.set(parent, child, coframe.Transform(), static=True)
    return source.encode(static=True)


@pytest.mark.slow
def test_frames_that_other_nodes_publish():
    buffer = coframe.Buffer()
    buffer.ingest(static(*(("map", f"f{n}") for n in range(FRAMES + 1000))), static=True)
    assert len(buffer.frames()) == pytest.approx(FRAMES, abs=2)
    counters = buffer.statistics
    assert counters["over_limit"] == counters["refused"] == FRAMES + 1000 - counters["stored"] > 0
    assert buffer.ingest(static(("map", "f7")), static=True) == 1, "known frames are still updated"
    buffer.set("map", "own", coframe.Transform(), static=True)
    assert buffer.can_transform("f7", "own")


def test_bytes_of_names_that_other_nodes_publish():
    buffer = coframe.Buffer()
    for n in range(70):
        buffer.ingest(static(("map", f"{n}" + "x" * (1 << 20))), static=True)
    assert len(buffer.frames()) == NAME_BYTES >> 20
    assert buffer.statistics["over_limit"] == 70 - 63


def test_samples_of_a_frame_within_the_cache_length():
    stamps = np.arange(1, SAMPLES + 100_001, dtype=np.int64)
    rows = np.zeros((len(stamps), 7))
    rows[:, 0], rows[:, 6] = stamps, 1.0
    for cache, kept in (("10s", SAMPLES), (None, len(stamps))):
        buffer = coframe.Buffer(cache)
        buffer.set_many("odom", "base", stamps, rows)
        (edge,) = buffer.edges()
        assert edge.samples == pytest.approx(kept, abs=256)
        assert buffer.lookup("odom", "base", int(stamps[-10])).x == stamps[-10]


@pytest.mark.skipif(platform.system() != "Linux", reason="reads /proc")
@pytest.mark.parametrize(("samples", "kilobytes"), [(12, 1.6), (32, 5.7), (33, 5.7 + 18)])
def test_the_memory_of_a_frame_grows_with_its_samples(samples, kilobytes):
    """The figures are those of docs/reliability.md. A tree of 100 000 frames takes less than 200 MB."""
    command = [sys.executable, "-c", TREE, str(samples)]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert float(output) == pytest.approx(kilobytes, rel=0.25)


@pytest.mark.parametrize("count", [11, 12, 13, 14, 31, 32, 33, 34, 255, 256, 257])
def test_histories_of_any_length_keep_all_samples(count):
    """Late samples, snapshots and cleared buffers too: the storage of a history grows with it."""

    def positions(buffer):
        return buffer.trajectory("map", "base").translation[:, 0].tolist()

    def set_samples(buffer, numbers):
        for number in numbers:
            buffer.set("map", "base", coframe.Transform([number, 0, 0]), number)

    buffer = coframe.Buffer(None)
    set_samples(buffer, [*range(2, count + 1)])
    snapshot = buffer.snapshot()
    set_samples(buffer, [1, *range(count + 1, count + 40)])
    assert positions(snapshot) == [*range(2, count + 1)]
    assert positions(buffer) == [*range(1, count + 40)]
    del snapshot
    buffer.clear()
    set_samples(buffer, range(1, count))
    assert positions(buffer) == [*range(1, count)]


def test_many_transforms_with_one_stamp_take_linear_time():
    def seconds(count):
        buffer = coframe.Buffer()
        transforms = [coframe.Transform([float(n), 0.0, 0.0]) for n in range(count)]
        start = time.process_time()
        for transform in transforms:
            buffer.set("odom", "base", transform, stamp=5)
        return time.process_time() - start

    assert seconds(40_000) < 8 * seconds(10_000)
