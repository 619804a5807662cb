# SPDX-License-Identifier: Apache-2.0
"""Few file descriptors, no free port, many participants."""

from __future__ import annotations

import contextlib
import json
import socket
import subprocess
import time
from typing import TYPE_CHECKING

from benchmarks.faults.case import Measurement, case, network_case
from benchmarks.faults.links import RATE, RECOVERY, ROBOTS, SETTLING, evaluate
from benchmarks.faults.processes import Processes, Program, answers, free_port, processes, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

CLI = ("python", "-m", "coframe.cli")
_DESCRIPTORS = (10, 12, 14, 16, 20, 24, 32, 48)
_LIMIT = 60  # seconds
_PARTICIPANTS = 130
_VIEWER_DESCRIPTORS = 48
_FIRST_PORT, _PORTS_PER_DOMAIN, _INDICES = 7410, 250, 100  # of DDS

# Importing the modules once for all processes saves most of their time and memory.
IDLE = """
import os, sys, time
from coframe.wire import Participant
for number in range(int(sys.argv[1])):
    time.sleep(1e-4 * number**2)  # all others discover it, and answer it: without pauses, they keep a machine busy
    reading, writing = os.pipe()
    if os.fork() == 0:
        os.close(reading)
        participant = Participant.get()
        participant.add_node("/", "idle")
        os.close(writing)
        sys.stdin.read()
        os._exit(0)
    os.close(writing)
    os.read(reading, 1)  # until the process has joined the graph
print("ready", flush=True)
sys.stdin.read()
"""
COUNT = """
import sys, time
from coframe.wire import Participant
participant = Participant.get()
begin = time.monotonic()
while len(participant.nodes()) < int(sys.argv[1]) and time.monotonic() - begin < 30:
    time.sleep(0.05)
print(len(participant.nodes()), time.monotonic() - begin, flush=True)
participant.close()
"""


def _limited(started: Processes, descriptors: int, *command: str) -> Program:
    return started.start("sh", "-c", f'ulimit -n {descriptors} && exec "$@"', "sh", *command)


@case("few_descriptors", "with 10 to 48 file descriptors, commands work or end with an error message, not a traceback")
def _few_descriptors() -> Measurement:
    results = []
    bad = []
    with processes() as started:
        started.node("talker", ROBOTS[0], RATE)
        for descriptors in _DESCRIPTORS:
            program = _limited(
                started, descriptors, *CLI, "lookup", f"odom_{ROBOTS[0]}", ROBOTS[0], "--duration", "10s"
            )
            try:
                code = program.process.wait(_LIMIT)
            except subprocess.TimeoutExpired:
                bad.append(f"{descriptors} descriptors: no end within {_LIMIT} s")
                continue
            results.append(code)
            errors = program.errors()
            if code not in (0, 1) or "Traceback" in errors or (code and "coframe: " not in errors):
                bad.append(f"{descriptors} descriptors: exit code {code}: {errors.strip()[-200:]}")
    text = f"{results.count(0)} of {len(_DESCRIPTORS)} worked, {results.count(1)} ended with an error message"
    return Measurement("; ".join([text, *bad]), not bad)


@case("few_descriptors_viewer", "a viewer whose descriptors were used up by connections serves pages again within 3 s")
def _few_descriptors_viewer() -> Measurement:
    with processes() as started, contextlib.ExitStack() as connections:
        port = free_port()
        viewer = _limited(started, _VIEWER_DESCRIPTORS, *CLI, "view", "--no-browser", "--port", str(port))
        wait_for(lambda: answers(port, viewer), "the page of the viewer")
        for _ in range(2 * _VIEWER_DESCRIPTORS):
            with contextlib.suppress(OSError):
                connections.enter_context(socket.create_connection(("127.0.0.1", port), timeout=0.2))
        time.sleep(2.0)
        connections.close()
        again = wait_for(lambda: answers(port, viewer), "the page of the viewer")
        errors = viewer.errors()
    text = f"served again after {again:.1f} s, {len(errors.splitlines())} lines on standard error"
    return Measurement(text, again <= RECOVERY and "Traceback" not in errors)


@case("no_port_viewer", "--port in use: a sentence and exit code 1; the default port in use: another one is taken")
def _no_port_viewer() -> Measurement:
    with processes() as started, _listening() as taken, _listening(7676):
        chosen = started.start(*CLI, "view", "--no-browser", "--port", str(taken))
        code = chosen.process.wait(_LIMIT)
        errors = chosen.errors().strip()
        other = started.start(*CLI, "view", "--no-browser")
        line = wait_for_text(other, "http://127.0.0.1:")
    text = f"exit code {code}: {errors.splitlines()[0] if errors else ''}; without --port: {line}"
    return Measurement(text, code == 1 and "Traceback" not in errors and str(taken) in errors and ":7676" not in line)


def wait_for_text(program: Program, text: str) -> str:
    """Return the first line on standard output or error that contains a text."""
    begin = time.monotonic()
    while time.monotonic() - begin < _LIMIT:
        for line in program.errors().splitlines():
            if text in line:
                return line
        if program.has_output():
            line = program.line()
            if text in line:
                return line
        time.sleep(0.05)
    raise RuntimeError(f"no line with {text!r}: {program.errors()}")


@contextlib.contextmanager
def _listening(port: int = 0) -> Iterator[int]:
    with socket.socket() as server:
        server.bind(("127.0.0.1", port))
        server.listen()
        yield server.getsockname()[1]


@case("no_port_dds", "all 100 participant indices of a domain in use: a sentence and exit code 1; one free: it works")
def _no_port_dds() -> Measurement:
    with processes() as started, contextlib.ExitStack() as sockets:
        first = _FIRST_PORT + _PORTS_PER_DOMAIN * int(started.environment["ROS_DOMAIN_ID"])
        some = socket.socket()
        for index in range(_INDICES):
            port = sockets.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
            port.bind(("", first + 2 * index))
            some = port if index == _INDICES // 2 else some
        refused = started.start(*CLI, "topic", "list", ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST")
        code = refused.process.wait(_LIMIT)
        some.close()
        works = started.start(*CLI, "topic", "list").process.wait(_LIMIT)
        errors = refused.errors().strip()
    text = f"exit code {code}: {errors.partition('coframe: ')[2].splitlines()[0]}; with one free: exit code {works}"
    return Measurement(text, code == 1 and works == 0 and "Traceback" not in errors and "coframe: " in errors)


@network_case(
    "participants_130", "130 processes in a domain: all are found within 30 s, statics within 3 s, nothing is missing"
)
def _participants_130() -> Measurement:
    with processes(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET") as started:
        started.start("python", "-c", IDLE, str(_PARTICIPANTS - 2)).line()
        talker = started.node("talker", ROBOTS[0], RATE)
        listener = started.node("listener", ROBOTS[0])
        listener.started = time.monotonic()
        nodes, seconds = started.start("python", "-c", COUNT, str(_PARTICIPANTS)).line().split()
        time.sleep(SETTLING)
        sent = {ROBOTS[0]: talker.ask()["stamps"]}
        time.sleep(RECOVERY)
        result = evaluate(listener.ask(json.dumps(sent)), listener.started)
    text = f"{nodes} nodes found after {float(seconds):.1f} s; {result}"
    statics = result.statics if result.statics is not None else float("inf")
    return Measurement(text, int(nodes) >= _PARTICIPANTS and statics <= RECOVERY and result.missing == 0)
