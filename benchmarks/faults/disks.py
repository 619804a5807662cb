# SPDX-License-Identifier: Apache-2.0
"""Full and read-only disks: small file systems in memory, which only this process and its children see."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import coframe
from benchmarks.faults.case import CASES, Case, Measurement, SkippedError, case
from benchmarks.faults.links import RATE, ROBOTS
from benchmarks.faults.processes import processes
from benchmarks.process import ROOT
from coframe.bags import Writer
from coframe.messages import find, serialize

if TYPE_CHECKING:
    from collections.abc import Iterator

CLI = ("python", "-m", "coframe.cli")
_MESSAGES = 4000
_LIMIT = 60.0  # seconds
_FILLER = "filler"
_PROMISE = "a sentence with the path and the reason, exit code 1; no partial file, except the messages of a bag"
_SAVE = "import sys, coframe; coframe.open_bag(sys.argv[1]).buffer.save(sys.argv[2])"

# Commands that write. BAG is a recording, OUT a new path on the disk with the fault.
_COMMANDS = {
    "bag_fix": (*CLI, "bag", "fix", "BAG", "OUT", "--compression", "none"),
    "bag_convert": (*CLI, "bag", "convert", "BAG", "OUT", "--compression", "none"),
    "bag_slice": (*CLI, "bag", "slice", "BAG", "OUT", "--start", "1s"),
    "trajectory": (*CLI, "trajectory", "BAG", "odom", "base_link", "-o", "OUT.csv"),
    "batch": (*CLI, "batch", "odom", "base_link", "BAG", "-o", "OUT"),
    "replay": (*CLI, "view", "BAG", "-o", "OUT.html"),
    "frames": (*CLI, "frames", "BAG", "-o", "OUT.svg"),
    "frames_picture": (*CLI, "frames", "BAG", "-o", "OUT.png"),
    "plot": (*CLI, "plot", "BAG", "odom:base_link.x", "-o", "OUT.png"),
    "frozen": ("python", "-c", _SAVE, "BAG", "OUT.cfz"),
    "course": (*CLI, "lab", "new", "OUT"),
}
_SMALL = {"frames", "frames_picture", "plot", "batch", "course"}  # their files might fit
# The messages written before the error can be read.
_KEEP_A_PART = {"bag_fix", "bag_convert", "bag_slice"}
# A program that saves a buffer gets coframe's exception.
_WITH_TRACEBACK = {"frozen"}


@contextlib.contextmanager
def _disk(options: str) -> Iterator[Path]:
    """Yield the folder of a file system of its own."""
    with tempfile.TemporaryDirectory() as folder:
        if subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], check=False).returncode:
            raise SkippedError("a tmpfs cannot be mounted here: run it as root")
        try:
            yield Path(folder)
        finally:
            subprocess.run(["umount", folder], check=True)


@contextlib.contextmanager
def _recording() -> Iterator[Path]:
    """Yield a recording of a moving frame."""
    message, stamped = find("tf2_msgs/msg/TFMessage"), find("geometry_msgs/msg/TransformStamped")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "run")
        with Writer(path, compression="none") as writer:
            topic = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
            for number in range(_MESSAGES):
                one = stamped(child_frame_id="base_link")
                one.header.frame_id = "odom"
                one.header.stamp.sec, one.header.stamp.nanosec = 1000 + number // 100, number % 100 * 10_000_000
                one.transform.translation.x = number / 7
                one.transform.rotation.w = 1.0
                writer.write(topic, serialize(message(transforms=[one])), (100_000 + number) * 10_000_000)
        yield path


def _fails_with_a_sentence(name: str, options: str, reason: str, *, fill: bool = False) -> Measurement:
    """Run a command on a disk with a fault; it must end with an error message that names the path and the reason."""
    with _recording() as bag, _disk(options) as disk:
        if fill:
            _fill(disk)
        command = [
            sys.executable if word == "python" else word.replace("BAG", str(bag)).replace("OUT", str(disk / "out"))
            for word in _COMMANDS[name]
        ]
        environment = {**os.environ, "NO_COLOR": "1", "COLUMNS": "500"}
        begin = time.monotonic()
        try:
            done = subprocess.run(
                command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=_LIMIT
            )
        except subprocess.TimeoutExpired:
            return Measurement(f"no end within {_LIMIT:.0f} s", kept=False)
        took = time.monotonic() - begin
        left = [str(path.relative_to(disk)) for path in disk.rglob("*") if path.is_file() and path.name != _FILLER]
    lines = [line for line in done.stderr.replace(str(disk), "DISK").splitlines() if line.strip()]
    kept = done.returncode == 1 and reason in done.stderr and "DISK" in "".join(lines)
    if name in _WITH_TRACEBACK:
        kept &= "FrozenFileError" in done.stderr
        lines = [line for line in lines if "FrozenFileError" in line]
    else:
        kept &= "Traceback" not in done.stderr and len(lines) <= 4
    kept &= not left or name in _KEEP_A_PART
    partial = f", partial files {', '.join(left)}" if left else ""
    return Measurement(f"exit code {done.returncode} after {took:.1f} s{partial}: {' '.join(lines)[-300:]}", kept)


def _fill(disk: Path) -> None:
    with contextlib.suppress(OSError), (disk / _FILLER).open("wb", buffering=0) as file:
        while True:
            file.write(bytes(4096))


for _name in _COMMANDS:
    _full = partial(_fails_with_a_sentence, _name, "size=64k", "No space left on device", fill=_name in _SMALL)
    CASES.append(Case(f"disk_full_{_name}", _PROMISE, _full))
for _name in _COMMANDS:
    _read_only = partial(_fails_with_a_sentence, _name, "size=64k,ro", "Read-only file system")
    CASES.append(Case(f"disk_read_only_{_name}", _PROMISE, _read_only))


@case("disk_full_record", "the recording ends with an error message and exit code 1; what was written can be read")
def _record_to_full_disk() -> Measurement:
    with _disk("size=256k") as disk, processes() as started:
        talker = started.node("talker", ROBOTS[0], RATE)
        recorder = started.start(*CLI, "record", "-o", str(disk / "run"), "--compression", "none")
        code = recorder.process.wait(_LIMIT)
        stamps = talker.ask()["stamps"]
        lines = [line for line in recorder.errors().replace(str(disk), "DISK").splitlines() if "record" not in line]
        with coframe.open_bag(disk / "run") as bag:
            edge = next(edge for edge in bag.buffer.edges() if edge.child == ROBOTS[0])
            begin, end = bag.buffer.span(f"odom_{ROBOTS[0]}", ROBOTS[0])
            missing = sum(begin <= stamp <= end for stamp in stamps) - edge.samples
            text = (
                f"exit code {code}, {edge.samples} messages readable, {missing} missing between them: {' '.join(lines)}"
            )
            return Measurement(text, code == 1 and edge.samples > RATE and missing == 0 and "Traceback" not in text)


@case("disk_read_only_record", "a sentence with the path and the reason, exit code 1")
def _record_to_read_only_disk() -> Measurement:
    with _disk("size=256k,ro") as disk, processes() as started:
        recorder = started.start(*CLI, "record", "-o", str(disk / "run"))
        code = recorder.process.wait(_LIMIT)
        text = f"exit code {code}: {recorder.errors().replace(str(disk), 'DISK').strip()}"
    return Measurement(text, code == 1 and "Read-only file system" in text and "Traceback" not in text)
