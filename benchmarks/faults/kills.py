# SPDX-License-Identifier: Apache-2.0
"""Processes that are killed (SIGKILL) or stopped (SIGSTOP)."""

from __future__ import annotations

import itertools
import json
import signal
import tempfile
import time
from pathlib import Path

import coframe
from benchmarks.faults.case import Measurement, case
from benchmarks.faults.links import NS, RATE, RECOVERY, ROBOTS, SETTLING, evaluate, first_after
from benchmarks.faults.processes import answers, free_port, processes, wait_for

UNDISTURBED = 0.5  # seconds; the longest gap of nodes that have nothing to do with the fault
STOPPED = 15.0  # seconds; longer than the lease of 10 s, after which DDS gives up a participant
CLI = ("python", "-m", "coframe.cli")

LAUNCH_FILE = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    parameters = [{"source_list": ["/somewhere"]}]
    return LaunchDescription(
        [Node(package="joint_state_publisher", executable="joint_state_publisher", parameters=parameters)]
    )
"""


@case("kill_publisher", "kill -9 of a publisher: others undisturbed (0.5 s), a new one is received within 3 s")
def _kill_publisher() -> Measurement:
    with processes() as started:
        first, second = (started.node("talker", robot, RATE) for robot in ROBOTS)
        listener = started.node("listener", *ROBOTS)
        time.sleep(SETTLING)
        first.process.kill()
        time.sleep(SETTLING)
        first = started.node("talker", ROBOTS[0], RATE)
        restarted = time.monotonic()
        time.sleep(SETTLING)
        report = listener.ask(json.dumps({ROBOTS[0]: first.ask()["stamps"], ROBOTS[1]: second.ask()["stamps"]}))
    again = first_after(restarted, report["arrivals"][ROBOTS[0]]) - restarted
    gap = _longest_gap(report["arrivals"][ROBOTS[1]])
    text = f"the new publisher was received after {again:.2f} s, longest gap of the other {gap:.2f} s"
    return Measurement(text, again <= RECOVERY and gap <= UNDISTURBED)


@case("kill_listener", "kill -9 of a listener: publish() takes at most 0.1 s, other listeners miss nothing")
def _kill_listener() -> Measurement:
    return _lose_listener(signal.SIGKILL)


@case("stop_listener", "a listener is stopped for 15 s: as above, and it receives again within 3 s")
def _stop_listener() -> Measurement:
    return _lose_listener(signal.SIGSTOP)


def _lose_listener(how: signal.Signals) -> Measurement:
    robot = ROBOTS[0]
    with processes() as started:
        talker = started.node("talker", robot, RATE)
        lost, other = (started.node("listener", robot) for _ in range(2))
        time.sleep(SETTLING)
        lost.process.send_signal(how)
        time.sleep(STOPPED)
        if how == signal.SIGSTOP:
            lost.process.send_signal(signal.SIGCONT)
        else:
            lost = started.node("listener", robot)
            lost.started = time.monotonic()
        continued = time.monotonic()
        time.sleep(SETTLING)
        said = talker.ask()
        sent = json.dumps({robot: said["stamps"]})
        undisturbed, recovered = evaluate(other.ask(sent), other.started), lost.ask(sent)
    again = first_after(continued, recovered["arrivals"][robot]) - continued
    gap, missing, slowest = undisturbed.gap, undisturbed.missing, said["slowest"]
    text = (
        f"maximum publish() time {1000 * slowest:.0f} ms, the other listener: {missing} of {undisturbed.sent} missing, "
        f"longest gap {gap:.2f} s; received again after {again:.2f} s"
    )
    statics = robot in recovered["statics"]
    return Measurement(
        text, slowest <= 0.1 and missing == 0 and gap <= UNDISTURBED and again <= RECOVERY and bool(statics)
    )


@case("stop_publisher", "a publisher is stopped for 15 s: it is received within 3 s after it continues")
def _stop_publisher() -> Measurement:
    robot = ROBOTS[0]
    with processes() as started:
        talker = started.node("talker", robot, RATE)
        listener = started.node("listener", robot)
        time.sleep(SETTLING)
        talker.process.send_signal(signal.SIGSTOP)
        time.sleep(STOPPED)
        talker.process.send_signal(signal.SIGCONT)
        continued = time.monotonic()
        time.sleep(SETTLING)
        report = listener.ask(json.dumps({robot: talker.ask()["stamps"]}))
    again = first_after(continued, report["arrivals"][robot]) - continued
    return Measurement(f"received again after {again:.2f} s", again <= RECOVERY)


@case("kill_recorder", "kill -9 of coframe record: the recording can be read, at most the last second is lost")
def _kill_recorder() -> Measurement:
    with tempfile.TemporaryDirectory() as folder, processes() as started:
        run = Path(folder, "run")
        talkers = {robot: started.node("talker", robot, RATE) for robot in ROBOTS}
        recorder = started.start(*CLI, "record", "-o", str(run))
        wait_for(lambda: _recorded(run) > 4 * RATE, "a recording")
        recorder.process.kill()
        killed = time.time_ns()
        sent = {robot: talker.ask()["stamps"] for robot, talker in talkers.items()}
        with coframe.open_bag(run) as bag:
            lost = (killed - bag.received_end) / NS
            missing = 0
            for robot, stamps in sent.items():
                begin, end = bag.buffer.span(f"odom_{robot}", robot)
                inside = [stamp for stamp in stamps if begin <= stamp <= end]
                edge = next(edge for edge in bag.buffer.edges() if edge.child == robot)
                missing += len(inside) - edge.samples
            text = (
                f"the last {lost:.2f} s are lost, {missing} messages before are missing, {len(bag.problems)} problems"
            )
            return Measurement(text, 0 <= lost <= 1.0 and missing == 0 and not bag.problems)


def _recorded(path: Path) -> int:
    try:
        with coframe.open_bag(path) as bag:
            return bag.topics["/tf"].messages if "/tf" in bag.topics else 0
    except coframe.RecordingError:
        return 0


@case(
    "kill_viewer", "kill -9 of coframe view: the same port can be used at once, nothing is left in the temporary folder"
)
def _kill_viewer() -> Measurement:
    with tempfile.TemporaryDirectory() as folder, processes(TMPDIR=folder) as started:
        talker = started.node("talker", ROBOTS[0], RATE)
        port = free_port()
        viewer = started.start(*CLI, "view", "--no-browser", "--port", str(port))
        wait_for(lambda: answers(port, viewer), "the page of the viewer")
        viewer.process.kill()
        viewer.process.wait()
        second = started.start(*CLI, "view", "--no-browser", "--port", str(port))
        again = wait_for(lambda: answers(port, second), "the page of the second viewer")
        left = [path.name for path in Path(folder).iterdir()]
        slowest = talker.ask()["slowest"]
    text = (
        f"served again after {again:.1f} s, maximum publish() time {1000 * slowest:.0f} ms, "
        f"left behind: {left or 'nothing'}"
    )
    return Measurement(text, again <= 10.0 and slowest <= 0.1 and not left)


@case("kill_launcher", "kill -9 of coframe launch: the next launch removes the temporary files that were left")
def _kill_launcher() -> Measurement:
    with tempfile.TemporaryDirectory() as folder, processes(TMPDIR=folder) as started:
        file = Path(folder, "two.launch.py")
        file.write_text(LAUNCH_FILE)

        def left() -> list[str]:
            return sorted(path.name for path in Path(folder).glob("launch_params_*"))

        first = started.start(*CLI, "launch", str(file))
        wait_for(left, "the first launch")
        time.sleep(1.0)
        first.process.kill()
        first.process.wait()
        after_kill = left()
        second = started.start(*CLI, "launch", str(file))
        wait_for(lambda: left() and left() != after_kill, "the second launch")
        remaining = set(left()) & set(after_kill)
        second.process.send_signal(signal.SIGINT)
        second.process.wait(60)
        at_end = left()
    text = (
        f"{len(after_kill)} folder left by the kill, {len(remaining)} after the next launch, {len(at_end)} at its end"
    )
    return Measurement(text, not remaining and not at_end)


def _longest_gap(arrivals: list[tuple[float, int]]) -> float:
    times = [arrived for arrived, _ in arrivals]
    return max((later - earlier for earlier, later in itertools.pairwise(times)), default=float("inf"))
