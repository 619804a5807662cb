# SPDX-License-Identifier: Apache-2.0
"""Steps of the system clock by an hour, with libfaketime: only the processes of the case see them."""

from __future__ import annotations

import json
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from benchmarks.faults.case import Measurement, SkippedError, case
from benchmarks.faults.links import NS, RATE, RECOVERY, ROBOTS, SETTLING, first_after
from benchmarks.faults.processes import processes

HOUR = 3600
CACHE = 30  # seconds; longer than the case


def _library() -> str:
    found = sorted(Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))
    if not found:
        raise SkippedError("libfaketime is not installed: apt-get install libfaketime")
    return str(found[0])


class _Step(NamedTuple):
    """What listeners received after a step of the clock.

    Attributes:
        running: The time until the running listener stored newer transforms again, in seconds; infinity if never.
        missing: The number of messages after the step that the running listener did not store.
        after: The number of messages after the step.
        new: The time until a new listener had transforms and statics, in seconds; infinity if never.
        warned: Whether the running listener warned about transforms that are older than its cache.
    """

    running: float
    missing: int
    after: int
    new: float
    warned: bool


def _step(seconds: int) -> _Step:
    """Step the clock of a machine with a talker and a listener, and start another listener afterwards."""
    robot = ROBOTS[0]
    library = _library()
    with tempfile.TemporaryDirectory() as folder:
        clock = Path(folder, "clock")
        clock.write_text("+0")
        faked = {
            "LD_PRELOAD": library,
            "FAKETIME_TIMESTAMP_FILE": str(clock),
            "FAKETIME_NO_CACHE": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1",
        }
        with processes(**faked) as started:
            talker, listener = started.node("talker", robot, RATE), started.node("listener", robot, CACHE)
            time.sleep(SETTLING)
            stepped = time.monotonic()
            clock.write_text(f"{seconds:+d}")
            time.sleep(SETTLING)
            new = started.node("listener", robot, CACHE)
            new.started = time.monotonic()
            time.sleep(SETTLING)
            sent = talker.ask()["stamps"]
            time.sleep(1.0)
            before, after = [each.ask(json.dumps({robot: sent})) for each in (listener, new)]
            warned = "older than the cache" in listener.errors()
    stamps = [stamp for stamp in sent if abs(stamp - sent[0]) > HOUR * NS // 2]
    moving, static = first_after(new.started, after["arrivals"][robot]), after["statics"].get(robot, float("inf"))
    return _Step(
        running=first_after(stepped, before["arrivals"][robot]) - stepped,
        missing=before["stored"][robot][-len(stamps) :].count(False),
        after=len(stamps),
        new=max(moving, static) - new.started,
        warned=warned,
    )


@case("clock_forward", "the clock jumps an hour forward: nothing is missing, transforms within 3 s")
def _clock_forward() -> Measurement:
    step = _step(HOUR)
    text = f"running listener again after {step.running:.2f} s, {step.missing} of {step.after} messages missing"
    kept = step.after > RATE and step.running <= RECOVERY and step.missing == 0 and step.new <= RECOVERY
    return Measurement(f"{text}; new listener after {step.new:.2f} s", kept)


@case(
    "clock_back",
    "an hour back: as in tf2, running listeners drop what is older than their cache, and say so; new ones work",
)
def _clock_back() -> Measurement:
    step = _step(-HOUR)
    said = "with a warning" if step.warned else "without a warning"
    text = f"running listener dropped {step.missing} of {step.after} messages {said}"
    kept = step.after > RATE and (step.warned or step.missing == 0) and step.new <= RECOVERY
    return Measurement(f"{text}; new listener after {step.new:.2f} s", kept)
