# SPDX-License-Identifier: Apache-2.0
"""`make faults`: a few faults from end to end. All of them take a quarter of an hour."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds", reason="the programs speak DDS")

ROOT = Path(__file__).parents[1]


def faults(*arguments, **environment):
    command = [sys.executable, "-m", "benchmarks.faults", *arguments]
    done = subprocess.run(
        command, cwd=ROOT, env={**os.environ, **environment}, capture_output=True, text=True, check=False
    )
    if "no network namespace" in done.stderr or "needs unshare" in done.stderr or "1 skipped" in done.stdout:
        pytest.skip(done.stderr or done.stdout)
    return done


def test_each_fault_has_a_promise():
    lines = faults("--list").stdout.splitlines()
    assert any(line.startswith("loss_30 ") and "statics within 3 s" in line for line in lines)
    assert faults("no_such_fault").returncode == 2


@pytest.mark.slow
@pytest.mark.parametrize(
    "fault", ["loss_30", "partition_15", "stop_listener", "disk_read_only_replay", "disk_read_only_frozen"]
)
def test_promise_is_kept(fault):
    done = faults(fault)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"\n| {fault} |" in done.stdout
    assert "1 fault: 1 kept, 0 broken, 0 skipped" in done.stdout


@pytest.mark.slow
def test_broken_promise_is_reported():
    # With the intervals of Cyclone DDS itself, messages are given up.
    slow = "<NackDelay>300ms</NackDelay><HeartbeatInterval minsched='300ms'>300ms</HeartbeatInterval>"
    done = faults("loss_30", CYCLONEDDS_URI=f"<CycloneDDS><Domain><Internal>{slow}</Internal></Domain></CycloneDDS>")
    assert done.returncode == 1
    assert "1 fault: 0 kept, 1 broken, 0 skipped: loss_30" in done.stdout
