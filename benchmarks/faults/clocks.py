# SPDX-License-Identifier: Apache-2.0
"""Steps of the system clock by an hour, with libfaketime: only the processes of the case see them."""

from __future__ import annotations

import json
import tempfile
import time
from pathlib import Path

from benchmarks.faults.case import Measurement, SkippedError, case
from benchmarks.faults.links import RATE, RECOVERY, ROBOTS, SETTLING, first_after
from benchmarks.faults.processes import processes

HOUR = 3600
CACHE = 30  # seconds; longer than the case


def _library() -> str:
    found = sorted(Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))
    if not found:
        raise SkippedError("libfaketime is not installed: apt-get install libfaketime")
    return str(found[0])


def _step(seconds: int) -> Measurement:
    """Step the clock of a machine with a talker and a listener, and measure when the listener is up to date again."""
    robot = ROBOTS[0]
    library = _library()
    with tempfile.TemporaryDirectory() as folder:
        clock = Path(folder, "clock")
        clock.write_text("+0")
        faked = {
            "LD_PRELOAD": library,
            "FAKETIME_TIMESTAMP_FILE": str(clock),
            "FAKETIME_NO_CACHE": "1",
            "DONT_FAKE_MONOTONIC": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1",
        }
        with processes(**faked) as started:
            talker, listener = started.node("talker", robot, RATE), started.node("listener", robot, CACHE)
            time.sleep(SETTLING)
            stepped = time.monotonic()
            clock.write_text(f"{seconds:+d}")
            time.sleep(SETTLING)
            late = started.node("listener", robot, CACHE)
            late.started = time.monotonic()
            time.sleep(SETTLING)
            said = talker.ask()
            time.sleep(1.0)
            reports = [each.ask(json.dumps({robot: said["stamps"]})) for each in (listener, late)]
    after = [stamp for stamp in said["stamps"] if abs(stamp - said["stamps"][0]) > HOUR * 10**9 // 2]
    stored = reports[0]["stored"][robot][-len(after) :]
    missing = stored.count(False)
    again = first_after(stepped, reports[0]["arrivals"][robot]) - stepped
    statics = reports[1]["statics"].get(robot, float("inf")) - late.started
    text = (
        f"transforms again after {again:.2f} s, {missing} of {len(after)} messages after the step missing, "
        f"statics of a new listener after {statics:.2f} s"
    )
    return Measurement(text, bool(after) and again <= RECOVERY and missing == 0 and statics <= RECOVERY)


@case("clock_forward", "the clock of the machine jumps an hour forward: nothing is missing, transforms within 3 s")
def _clock_forward() -> Measurement:
    return _step(HOUR)


@case("clock_back", "the clock of the machine jumps an hour back: nothing is missing, transforms within 3 s")
def _clock_back() -> Measurement:
    return _step(-HOUR)
