"""Ten million transforms, and prints the most memory, in bytes, that a process ever had that holds them.

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
"""Of each link."""
PER_MESSAGE = 20
"""Links in the recording, all of them in each message."""

_BLOCK = 50_000


def buffer() -> coframe.Buffer:
    """A chain of `DEPTH` links that holds them all."""
    filled = coframe.Buffer(None)
    for link in range(DEPTH):
        for first in range(0, SAMPLES, _BLOCK):
            index = np.arange(first, first + _BLOCK)
            half = 0.5 * (0.02 * index + link)
            poses = np.zeros((_BLOCK, 7))
            poses[:, 0] = 0.1 * link + 0.001 * index
            poses[:, 4], poses[:, 5], poses[:, 6] = 0.6 * np.sin(half), 0.8 * np.sin(half), np.cos(half)
            filled.set_many(frame(link), frame(link + 1), motion.stamp(link, 0) + index * motion.STEP, poses)
    return filled


def mcap(path: Path, transforms: int = TRANSFORMS) -> Path:
    """A recording with as many, all links in each message."""
    from mcap.writer import Writer

    moment = coframe.Buffer(None)
    for link in range(PER_MESSAGE):
        *translation, qx, qy, qz, qw = motion.values(link, 1)
        moment.set(frame(link), frame(link + 1), coframe.Transform(translation, (qx, qy, qz, qw)), motion.START)
    data = bytearray(moment.encode(static=False))
    stamp = struct.Struct("<iI")
    places, place = [], -1
    while (place := data.find(stamp.pack(*divmod(motion.START, motion.NS)), place + 1)) >= 0:
        places.append(place)
    assert len(places) == PER_MESSAGE
    with path.open("wb") as stream:
        writer: Any = Writer(stream)
        writer.start(profile="ros2")
        channel = writer.register_channel(
            "/tf", "cdr", writer.register_schema("tf2_msgs/msg/TFMessage", "ros2msg", b"")
        )
        for index in range(transforms // PER_MESSAGE):
            at = motion.START + index * motion.STEP
            for place in places:
                stamp.pack_into(data, place, *divmod(at, motion.NS))
            writer.add_message(channel, at, bytes(data), at)
        writer.finish()
    return path


def opened() -> coframe.Buffer:
    with tempfile.TemporaryDirectory() as folder:
        path = mcap(Path(folder) / "run.mcap")
        before = peak()
        with coframe.open_bag(path) as recording:
            assert peak() > before, "the writer must not have taken more than the reader"
            return recording.buffer


def arrays() -> None:
    """The floor: stamps and poses and nothing else."""
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
    """The most memory that this program ever had, in bytes; `getrusage` would count what its parent had, too."""
    status = Path("/proc/self/status").read_text("ascii")
    return 1024 * int(next(line for line in status.splitlines() if line.startswith("VmHWM")).split()[1])


if __name__ == "__main__":
    main()
