# SPDX-License-Identifier: Apache-2.0
"""Measure many processes that share transforms, next to one and to many that receive them themselves. Linux only.

    python -m benchmarks.shared [READERS] [KILLS]

A broadcaster publishes 10 transforms at 1 kHz. READERS processes (50) look one up at 10 Hz in shared transforms, one
process in those of its own listener, and READERS further processes in a buffer that they have filled: the programs
themselves. What the others use more is the cost of listening, in percent of one core. All run at the same time, so
that the ratio does not depend on what else the machine does. The memory is what a reader has of its own (USS) beyond
such a program. Then KILLS times (20) the process that receives is killed.
"""

from __future__ import annotations

import contextlib
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import coframe
from coframe.connection.listener_config import ListenerConfig
from coframe.connection.shared_transforms import open_segment
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

DOMAIN = 97
SECONDS = 20.0
FRAMES, RATE, LOOKUPS = 10, 1000, 10

BROADCASTER = f"""
import time
import coframe
from coframe.messages import find
from coframe.messages.codec import serialize
message, stamped = find("tf2_msgs/msg/TFMessage")(), find("geometry_msgs/msg/TransformStamped")
for i in range({FRAMES}):
    one = stamped(child_frame_id=f"f{{i}}")
    one.header.frame_id = "map" if i == 0 else f"f{{i - 1}}"
    message.transforms.append(one)
with coframe.connect("broadcaster", domain={DOMAIN}) as ros:
    publisher = ros.publisher("/tf", type(message))
    due = time.monotonic()
    while True:
        seconds, nanoseconds = divmod(time.time_ns(), 10**9)
        for one in message.transforms:
            one.header.stamp.sec, one.header.stamp.nanosec = seconds, nanoseconds
        publisher.publish(message)
        due += 1 / {RATE}
        time.sleep(max(0.0, due - time.monotonic()))
"""
READER = f"""
import sys, time
import coframe
with coframe.connect("reader", domain={DOMAIN}, shared=sys.argv[1] == "shared") as ros:
    ros.buffer.wait("map", "f{FRAMES - 1}", timeout="60s")
    print("ready", flush=True)
    while True:
        ros.buffer.lookup("map", "f{FRAMES - 1}")
        time.sleep(1 / {LOOKUPS})
"""
PROGRAM = f"""
import time
import coframe
buffer = coframe.Buffer()
for i in range({FRAMES}):
    buffer.set("map" if i == 0 else f"f{{i - 1}}", f"f{{i}}", coframe.Transform([1, 0, 0]), 1_000_000_000)
print("ready", flush=True)
while True:
    buffer.lookup("map", "f{FRAMES - 1}")
    time.sleep(1 / {LOOKUPS})
"""


@contextlib.contextmanager
def _running(count: int, *program: str) -> Iterator[list[subprocess.Popen[str]]]:
    processes: list[subprocess.Popen[str]] = []
    try:
        while len(processes) < count:
            processes.append(_start(*program))
        yield processes
    finally:
        for process in processes:
            process.kill()
            process.wait()


def _start(*program: str) -> subprocess.Popen[str]:
    process = subprocess.Popen([sys.executable, "-c", *program], stdout=subprocess.PIPE, text=True)
    if program[0] is not BROADCASTER:
        assert process.stdout is not None
        if process.stdout.readline() != "ready\n":
            raise SystemExit("shared: a process has failed")
    return process


def _processor_time(processes: list[subprocess.Popen[str]]) -> float:
    """Return the processor time of the threads of processes in seconds."""
    files = [file for process in processes for file in Path(f"/proc/{process.pid}/task").glob("*/schedstat")]
    return sum(int(file.read_text(encoding="ascii").split()[0]) for file in files) / SECOND


def _loads(*groups: list[subprocess.Popen[str]]) -> list[float]:
    """Return the processor time of groups of processes, in percent of one core."""
    before = [_processor_time(group) for group in groups]
    time.sleep(SECONDS)
    return [100 * (_processor_time(group) - start) / SECONDS for group, start in zip(groups, before, strict=True)]


def _own_memory(process: subprocess.Popen[str]) -> int:
    """Return the memory that only this process uses, in bytes."""
    lines = Path(f"/proc/{process.pid}/smaps_rollup").read_text(encoding="ascii").splitlines()
    return 1024 * sum(int(line.split()[1]) for line in lines if line.startswith(("Private_Clean", "Private_Dirty")))


def _takeovers(kills: int) -> list[float]:
    """Kill the receiving process again and again; return how long no newer transform could be looked up, in ms."""
    gaps = []
    with _running(3, READER, "shared") as processes:
        segment = open_segment(ListenerConfig.of(domain=DOMAIN))  # this process only reads
        buffer = coframe.Buffer()
        segment.follow(buffer)
        for _ in range(kills):
            time.sleep(0.3)
            victim = next(process for process in processes if process.pid == segment.writer_process)
            stored = buffer.lookup("map", f"f{FRAMES - 1}").stamp
            victim.send_signal(signal.SIGKILL)
            start = time.perf_counter()
            victim.wait()
            assert stored is not None
            last = buffer.lookup("map", f"f{FRAMES - 1}").stamp
            buffer.lookup("map", f"f{FRAMES - 1}", stored)
            buffer.wait("map", f"f{FRAMES - 1}", (last or 0) + 1, timeout="20s")
            gaps.append(1000 * (time.perf_counter() - start))
            processes.remove(victim)
            processes.append(_start(READER, "shared"))
        segment.close()
    return gaps


def main() -> None:
    readers = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    with _running(1, BROADCASTER):
        time.sleep(1)
        with (
            _running(readers, PROGRAM) as without,
            _running(1, READER, "alone") as one,
            _running(readers, READER, "shared") as sharing,
        ):
            time.sleep(10)  # until the buffers contain the seconds that they keep
            programs, alone, shared = _loads(without, one, sharing)
            memory = statistics.median(map(_own_memory, sharing[1:])) - statistics.median(map(_own_memory, without))
        alone -= programs / readers
        shared -= programs
        ratio = f"{shared / alone:.2f} times one listener"
        print(f"{readers} programs without a listener              {programs:8.1f} % of one core", flush=True)
        print(f"one listener of its own                     {alone:8.1f} % more", flush=True)
        print(f"{readers} programs that share transforms           {shared:8.1f} % more, {ratio}", flush=True)
        print(f"memory per additional program                 {memory / 1e6:8.2f} MB more", flush=True)
        gaps = _takeovers(kills)
        print(
            f"{kills} receivers killed: new transforms after   {statistics.median(gaps):8.0f} ms (median), "
            f"{max(gaps):.0f} ms (maximum)"
        )


if __name__ == "__main__":
    main()
