# SPDX-License-Identifier: Apache-2.0
"""Count the processor instructions of the most frequent calls, which a busy machine does not change.

    python -m benchmarks.instructions [PYTHON ...]

Each PYTHON is an interpreter with coframe installed, such as one per build that is compared; without any it is this
one. The counts come from Valgrind (``apt-get install valgrind``): a run with calls minus a run without.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys

CALLS = 50_000
OPERATIONS = {
    "lookup": 'buffer.lookup("map", "base", 105_500_000_000)',
    "lookup newest": 'buffer.lookup("map", "base")',
    "can_transform": 'buffer.can_transform("map", "base", 105_500_000_000)',
    "set": 'buffer.set("odom", "base", pose, 110_000_000_000 + i)',
}
# Operations on a buffer that reads the memory that processes share, which exists on Linux only.
SHARED = {f"{name}, shared": OPERATIONS[name] for name in ("lookup", "lookup newest") if sys.platform == "linux"}
PROGRAM = """
import coframe
buffer, pose = coframe.Buffer(), coframe.Transform([1, 2, 3])
{before}
for second in range(101, 111):
    for parent, child in (("map", "odom"), ("odom", "base")):
        buffer.set(parent, child, pose, second * 1_000_000_000)
{after}
for i in range({count}):
    {operation}
"""
BEFORE = """
import tempfile
from coframe import _core
folder = tempfile.TemporaryDirectory()
segment = _core.Segment.open(folder.name + "/shared", "instructions", 10_000_000_000)
assert segment.try_to_write()
segment.write(buffer)
"""
AFTER = """
buffer = coframe.Buffer()
assert segment.follow(buffer)
"""


def _program(name: str, count: int) -> str:
    before, after = (BEFORE, AFTER) if name in SHARED else ("", "")
    return PROGRAM.format(before=before, after=after, count=count, operation=(OPERATIONS | SHARED)[name])


def _count(python: str, name: str, count: int) -> int:
    program = _program(name, count)
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", python, "-c", program]
    # The kernels for other processors than Valgrind's are not of interest here.
    result = subprocess.run(
        command, capture_output=True, text=True, check=False, env={"PYTHONHASHSEED": "0", "COFRAME_CPU_LEVEL": "plain"}
    )
    collected = re.search(r"Collected : (\d+)", result.stderr)
    if result.returncode != 0 or collected is None:
        raise SystemExit(f"instructions: {python} failed under Valgrind:\n{result.stderr[-2000:]}")
    return int(collected[1])


def main() -> None:
    if shutil.which("valgrind") is None:
        raise SystemExit("instructions: Valgrind is not installed. On Debian or Ubuntu: apt-get install valgrind")
    pythons = sys.argv[1:] or [sys.executable]
    for python in pythons:  # the first run of an installation compiles its Python modules
        subprocess.run([python, "-c", _program("lookup", 1)], check=True)
    print(f"{'instructions per call':24}" + "".join(f"  {python[-40:]:>40}" for python in pythons))
    for name in OPERATIONS | SHARED:
        counts = [(_count(p, name, CALLS) - _count(p, name, 0)) / CALLS for p in pythons]
        print(f"{name:24}" + "".join(f"  {count:40.0f}" for count in counts), flush=True)


if __name__ == "__main__":
    main()
