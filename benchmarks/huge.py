# SPDX-License-Identifier: Apache-2.0
"""Runs commands on huge inputs that it generates, and prints their time and memory and how they react to Ctrl-C.

    python -m benchmarks.huge                 a tree of 100 000 frames, and a recording of 10 GB
    python -m benchmarks.huge --frames 1000 --gigabytes 0.1

The files are written into a temporary folder, and deleted afterwards. Exits with 1 if a command fails, exceeds a limit,
does not end within a second after Ctrl-C, or leaves files behind.
"""

import argparse
import contextlib
import math
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import coframe
from benchmarks.process import OWN_PYTHON, ROOT
from coframe.bags import Writer
from coframe.messages import find, serialize

START = 1_700_000_000_000_000_000
SECOND = 1_000_000_000
IMAGE = 4 << 20
"""Bytes of one image of the recording."""
BRANCHES = 50
"""Children of each frame of the tree."""

MAX_MEMORY = 1 << 30
MAX_SECONDS_TO_END = 1.0
STATUS_INTERVAL = 0.02
FIRST_SECONDS = 2.0
"""The interpreter may still be starting before; Ctrl-C then ends it by the signal."""


@dataclass
class Row:
    """What was measured of one command."""

    command: str
    seconds: float
    processor_seconds: float
    memory: int  # bytes at the peak, without mapped files
    shows_progress: bool
    end_seconds: float  # after Ctrl-C; NaN if the command was faster
    problems: list[str]


def frame_name(i: int) -> str:
    return f"frame_{i}"


def edges(frames: int) -> Iterator[tuple[str, str]]:
    """Return the parent and the child of each edge of the tree."""
    return ((frame_name((i - 1) // BRANCHES), frame_name(i)) for i in range(1, frames))


def write_urdf(path: Path, frames: int) -> None:
    """Write a robot with this number of links."""
    with path.open("w") as file:
        file.write('<robot name="huge">\n<link name="frame_0"/>\n')
        for i, (parent, child) in enumerate(edges(frames)):
            kind = "continuous" if i % 2 else "fixed"
            file.write(
                f'<link name="{child}"/><joint name="joint_{i}" type="{kind}"><parent link="{parent}"/>'
                f'<child link="{child}"/><origin xyz="1 0 {i % 10}"/></joint>\n'
            )
        file.write("</robot>\n")


def transforms(pairs: Iterable[tuple[str, str]], stamp: int) -> bytes:
    """Return a TFMessage."""
    buffer = coframe.Buffer(None)
    for i, (parent, child) in enumerate(pairs):
        buffer.set(parent, child, coframe.Transform([1.0, 0.0, i % 10]), stamp)
    return buffer.encode(static=False)


def write_tree(path: Path, frames: int) -> None:
    """Write a recording of a tree: half of it static, half of it moving at 1 Hz for 10 s."""
    pairs = list(edges(frames))
    half = len(pairs) // 2
    with Writer(path, compression="none") as writer:
        static = writer.add_topic("/tf_static", "tf2_msgs/msg/TFMessage")
        moving = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        writer.write(static, transforms(pairs[:half], START), START)
        for second in range(10):
            writer.write(moving, transforms(pairs[half:], START + second * SECOND), START + second * SECOND)


def write_recording(path: Path, size: int) -> None:
    """Write a recording of this many bytes: a moving robot, a lidar at 10 Hz, and a camera with the rest."""
    image = find("sensor_msgs/msg/Image")(height=1024, width=4096, encoding="mono8", step=4096, data=bytes(IMAGE))
    image.header.frame_id = "camera"
    scan = find("sensor_msgs/msg/LaserScan")(ranges=[1.0] * 720)
    scan.header.frame_id = "lidar"
    pictures, scans = (bytearray(serialize(message)) for message in (image, scan))
    with Writer(path, compression="none") as writer:
        static = writer.add_topic("/tf_static", "tf2_msgs/msg/TFMessage")
        moving = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        camera = writer.add_topic("/image", "sensor_msgs/msg/Image")
        lidar = writer.add_topic("/scan", "sensor_msgs/msg/LaserScan")
        writer.write(static, transforms([("base_link", "lidar"), ("base_link", "camera")], START), START)
        for i in range(size // IMAGE):
            at = START + i * SECOND // 10
            for k in range(5):
                stamp = at + k * SECOND // 50
                writer.write(moving, transforms([("odom", "base_link")], stamp), stamp + 1000)
            for topic, data in ((camera, pictures), (lidar, scans)):
                struct.pack_into("<iI", data, 4, *divmod(at, SECOND))
                writer.write(topic, bytes(data), at + 2000)


class Command:
    """A running command of coframe; what it writes to the terminal is collected."""

    def __init__(self, arguments: list[str], scratch: Path) -> None:
        self.memory = 0
        self.processor_seconds = 0.0
        self.arguments = arguments
        self._output = bytearray()
        temporary = scratch / "temporary"
        temporary.mkdir(exist_ok=True)
        environment = {**os.environ, "TMPDIR": str(temporary), "TERM": "xterm", "COLUMNS": "120"}
        terminal, other_end = os.openpty()
        self.process = subprocess.Popen(
            [*OWN_PYTHON, "-m", "coframe.cli", *arguments],
            cwd=ROOT,
            stdout=other_end,
            stderr=other_end,
            env=environment,
        )
        os.close(other_end)
        self.started = time.monotonic()
        threading.Thread(target=self._watch, daemon=True).start()
        threading.Thread(target=self._read, args=(terminal,), daemon=True).start()

    def _read(self, terminal: int) -> None:
        with contextlib.suppress(OSError):  # the end of the process closes the terminal
            while data := os.read(terminal, 1 << 16):
                self._output += data
        os.close(terminal)

    def _watch(self) -> None:
        """Record the processor time, and the peak of the allocated memory: mapped files can be dropped at any time."""
        folder = Path(f"/proc/{self.process.pid}")
        while self.process.poll() is None:
            try:
                lines = dict(line.split(":", 1) for line in (folder / "status").read_text().splitlines())
                ticks = (folder / "stat").read_text().rpartition(")")[2].split()[11:13]
            except (OSError, ValueError):
                return
            self.processor_seconds = sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK")
            self.memory = max(self.memory, int(lines.get("RssAnon", "0 kB").split()[0]) << 10)
            time.sleep(STATUS_INTERVAL)

    def text(self) -> str:
        """Return the output so far."""
        return self._output.decode("utf-8", "replace")

    def wait_for(self, text: str, limit: float) -> bool:
        """Wait until the output contains a text; return whether it does."""
        while self.process.poll() is None and time.monotonic() - self.started < limit:
            if text in self.text():
                return True
            time.sleep(STATUS_INTERVAL)
        return text in self.text()

    def interrupt(self) -> float:
        """Press Ctrl-C; return the seconds until the command has ended."""
        pressed = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(60)
        except subprocess.TimeoutExpired:
            self.process.kill()
        return time.monotonic() - pressed


def measure(arguments: list[str], scratch: Path, limit: float) -> Row:
    """Run a command twice: to its end, and until Ctrl-C in the middle. `view` runs until the page can be opened."""
    is_view = arguments[0] == "view"
    problems = []
    command = Command(arguments, scratch)
    if is_view:
        command.wait_for("http://", limit)
    else:
        try:
            command.process.wait(limit)
        except subprocess.TimeoutExpired:
            problems.append(f"not ready after {limit:g} s")
            command.process.kill()
    seconds, processor_seconds = time.monotonic() - command.started, command.processor_seconds
    code = command.process.poll()
    if code not in ((None,) if is_view else (0, 1)):  # 1: the doctor has found problems
        problems.append(f"exit code {code}: {command.text()[-200:]!r}")
    end_seconds = float("nan")
    if is_view and code is None:
        end_seconds = command.interrupt()
        problems += ended_badly(command, scratch)
    elif seconds > 2 * FIRST_SECONDS:
        second = Command(arguments, scratch)
        time.sleep(max(seconds / 2, FIRST_SECONDS))
        if second.process.poll() is None:  # It can be faster than the first one.
            end_seconds = second.interrupt()
            problems += ended_badly(second, scratch)
    if command.memory > MAX_MEMORY:
        problems.append("more than 1 GB of memory")
    if end_seconds > MAX_SECONDS_TO_END:
        problems.append(f"ended {end_seconds:.1f} s after Ctrl-C")
    shows_progress = "\u2501" in command.text()
    return Row(" ".join(arguments), seconds, processor_seconds, command.memory, shows_progress, end_seconds, problems)


def ended_badly(command: Command, scratch: Path) -> list[str]:
    """Return what is wrong with the end of a command after Ctrl-C."""
    problems = []
    if command.process.returncode not in {130, 0 if command.arguments[0] == "view" else 130}:
        problems.append(f"exit code {command.process.returncode} after Ctrl-C")
    if "Traceback" in command.text():
        problems.append("a traceback after Ctrl-C")
    if left := [file.name for file in (scratch / "temporary").iterdir()]:
        problems.append(f"left behind: {', '.join(left[:5])}")
        shutil.rmtree(scratch / "temporary")
    return problems


def show(row: Row, hidden: Path) -> None:
    name = row.command.replace(f"{hidden}/", "")
    end = "" if math.isnan(row.end_seconds) else f"{row.end_seconds:.2f} s"
    progress = "yes" if row.shows_progress else ""
    times = f"{row.seconds:.1f} s | {row.processor_seconds:.1f} s"
    print(f"| coframe {name} | {times} | {row.memory / 1e6:.0f} MB | {progress} | {end} |", flush=True)
    for problem in row.problems:
        print(f"    {problem}", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description="Run commands on huge inputs.")
    parser.add_argument("--frames", type=int, default=100_000, help="frames of the tree; 0: no tree")
    parser.add_argument("--gigabytes", type=float, default=10.0, help="size of the recording; 0: no recording")
    parser.add_argument("--folder", type=Path, help="where the temporary folder is created")
    parser.add_argument("--limit", type=float, default=300.0, help="seconds that a command may take")
    options = parser.parse_args()
    needed = int(options.gigabytes * 1e9) + options.frames * 3000
    free = shutil.disk_usage(options.folder or tempfile.gettempdir()).free
    if free < 1.5 * needed:
        print(f"{needed / 1e9:.1f} GB are written, and {free / 1e9:.1f} GB are free: use --folder or --gigabytes")
        return 1
    rows = []
    with tempfile.TemporaryDirectory(prefix="coframe-huge-", dir=options.folder) as name:
        folder = Path(name)
        runs = []
        if options.frames:
            write_urdf(folder / "huge.urdf", options.frames)
            write_tree(folder / "tree", options.frames)
            runs += commands(folder / "tree")
            runs[-1] += ["--robot", f"{folder}/huge.urdf"]
        if options.gigabytes:
            began = time.monotonic()
            write_recording(folder / "recording", int(options.gigabytes * 1e9))
            print(f"wrote {options.gigabytes:g} GB in {time.monotonic() - began:.0f} s", file=sys.stderr, flush=True)
            runs += commands(folder / "recording")
        print(
            "| command | time | processor time | memory | progress | end after Ctrl-C |\n|---|---|---|---|---|---|",
            flush=True,
        )
        for arguments in runs:
            rows.append(measure(arguments, folder, options.limit))
            show(rows[-1], folder)
    return int(any(row.problems for row in rows))


def commands(recording: Path) -> list[list[str]]:
    """Return the commands that run on a recording."""
    path = str(recording)
    return [
        ["bag", "info", path],
        ["doctor", path],
        ["frames", path],
        ["view", path, "--no-browser", "--port", "0"],
    ]


if __name__ == "__main__":
    # Shells start background jobs with Ctrl-C ignored, and the commands would inherit that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
