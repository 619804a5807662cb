# SPDX-License-Identifier: Apache-2.0
"""Stores ten million transforms and prints the peak memory of the process in bytes.

python -m benchmarks.large buffer
python -m benchmarks.large mcap
"""

import struct
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import coframe
from benchmarks import motion
from benchmarks.motion import frame

TRANSFORMS = 10_000_000
DEPTH = 5
SAMPLES = TRANSFORMS // DEPTH
"""Number of samples of each edge."""
PER_MESSAGE = 20
"""Edges in the recording; each message contains all of them."""

_BLOCK = 50_000


def buffer() -> coframe.Buffer:
    """Return a buffer with a chain of `DEPTH` edges that contains all transforms."""
    filled = coframe.Buffer(None)
    for edge in range(DEPTH):
        for first in range(0, SAMPLES, _BLOCK):
            index = np.arange(first, first + _BLOCK)
            half = 0.5 * (0.02 * index + edge)
            poses = np.zeros((_BLOCK, 7))
            poses[:, 0] = 0.1 * edge + 0.001 * index
            poses[:, 4], poses[:, 5], poses[:, 6] = 0.6 * np.sin(half), 0.8 * np.sin(half), np.cos(half)
            filled.set_many(frame(edge), frame(edge + 1), motion.stamp(edge, 0) + index * motion.STEP, poses)
    return filled


def mcap(path: Path, transforms: int = TRANSFORMS) -> Path:
    """Write a recording with this number of transforms; each message contains all edges."""
    from mcap.writer import Writer

    moment = coframe.Buffer(None)
    for edge in range(PER_MESSAGE):
        *translation, qx, qy, qz, qw = motion.values(edge, 1)
        moment.set(frame(edge), frame(edge + 1), coframe.Transform(translation, (qx, qy, qz, qw)), motion.START)
    data = bytearray(moment.encode(static=False))
    stamp = struct.Struct("<iI")
    offsets, offset = [], -1
    while (offset := data.find(stamp.pack(*divmod(motion.START, motion.NS)), offset + 1)) >= 0:
        offsets.append(offset)
    assert len(offsets) == PER_MESSAGE
    with path.open("wb") as stream:
        writer: Any = Writer(stream)
        writer.start(profile="ros2")
        channel = writer.register_channel(
            "/tf", "cdr", writer.register_schema("tf2_msgs/msg/TFMessage", "ros2msg", b"")
        )
        for index in range(transforms // PER_MESSAGE):
            at = motion.START + index * motion.STEP
            for offset in offsets:
                stamp.pack_into(data, offset, *divmod(at, motion.NS))
            writer.add_message(channel, at, bytes(data), at)
        writer.finish()
    return path


def opened() -> coframe.Buffer:
    with tempfile.TemporaryDirectory() as folder:
        path = mcap(Path(folder) / "run.mcap")
        before = peak()
        with coframe.open_bag(path) as recording:
            assert peak() > before, "the writer used more memory than the reader"
            return recording.buffer


def arrays() -> None:
    """Print the memory of the floor: only stamps and poses."""
    stamps, poses = np.ones(TRANSFORMS, dtype=np.int64), np.ones((TRANSFORMS, 7))
    assert len(stamps) == len(poses)
    print(peak())


def main() -> None:
    if sys.argv[1] == "arrays":
        arrays()
        return
    found = {"buffer": buffer, "mcap": opened}[sys.argv[1]]()
    assert sum(edge.samples for edge in found.edges()) == TRANSFORMS
    print(peak())


def peak() -> int:
    """Return the peak memory of this process in bytes; `getrusage` would include its parent."""
    status = Path("/proc/self/status").read_text("ascii")
    return 1024 * int(next(line for line in status.splitlines() if line.startswith("VmHWM")).split()[1])


if __name__ == "__main__":
    main()
