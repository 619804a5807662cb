"""What a running verdict costs.

`coframe doctor --watch` beside a talker that publishes messages of ten transforms at 1 kHz: from when its window is
full, its processor time in percent of one core:

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
"""Seconds that the command looks back by default."""
FULL = 0.95 * WINDOW * RATE_HZ * TRANSFORMS


def main(seconds: float) -> None:
    # This machine's loopback only, and away from whoever else is on it.
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
    told = process.stdout.readline()
    if not told:
        raise SystemExit("a process ended by itself")
    return told


def processor_time(process: int) -> float:
    """What a process has used so far, in seconds."""
    fields = Path(f"/proc/{process}/stat").read_text("ascii").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main(float(sys.argv[1]))
