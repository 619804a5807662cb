# SPDX-License-Identifier: Apache-2.0
"""Measures the cost of `coframe doctor --watch`.

A talker publishes messages of ten transforms at 1 kHz. Once the window of the doctor is full, its processor time is
measured and printed in percent of one core:

    python -m benchmarks.doctor 10                  # seconds
"""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

from benchmarks.wire_latency import PATIENCE, RATE_HZ, TRANSFORMS

WINDOW = 10
"""Default window of the command in seconds."""
FULL = 0.95 * WINDOW * RATE_HZ * TRANSFORMS


def main(seconds: float) -> None:
    # Use only the loopback interface and a separate domain.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    doctor = start("-m", "coframe.cli", "doctor", "--watch", "--json")
    talker = start("-m", "benchmarks.wire_latency", "talk", "dds", str(seconds + 2 * PATIENCE))
    try:
        end = time.monotonic() + PATIENCE
        while json.loads(line(doctor))["transforms"] < FULL:
            if time.monotonic() > end:
                raise SystemExit(f"the window was not full after {PATIENCE:g} s")
        begin, spent = time.monotonic(), processor_time(doctor.pid)
        while time.monotonic() < begin + seconds:
            line(doctor)
        print(100 * (processor_time(doctor.pid) - spent) / (time.monotonic() - begin), flush=True)
    finally:
        for process in (talker, doctor):
            process.kill()
            process.communicate()


def start(*arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, "-E", *arguments], stdout=subprocess.PIPE, text=True)


def line(process: subprocess.Popen[str]) -> str:
    assert process.stdout
    text = process.stdout.readline()
    if not text:
        raise SystemExit("a process ended unexpectedly")
    return text


def processor_time(process: int) -> float:
    """Return the processor time of a process so far, in seconds."""
    fields = Path(f"/proc/{process}/stat").read_text("ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main(float(sys.argv[1]))
