# SPDX-License-Identifier: Apache-2.0
"""Run what one side provides and the other uses: coframe on a middleware beside a distribution of ROS 2, both ways.

The programs are in tests/process/ros_matrix; each runs with coframe's rclpy and with that of ROS 2. They communicate on
the loopback interface, and each pair has its own domain.
"""

from __future__ import annotations

import itertools
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from scripts.ros_wheels.environments import Environment

ROOT: Final = Path(__file__).parents[2]
PROGRAMS: Final = ROOT / "tests/process/ros_matrix"
VERIFY: Final = ROOT / "tests/process/inside_ros2/verify.py"

OK, REFUSED, IMPOSSIBLE, FAILED, SKIPPED = "ok", "refused", "no", "FAILED", "-"
INSIDE: Final = "ros2"  # the row that runs in a process of ROS 2
ROWS: Final = {
    "topics": "20 message types, up to 1 MB",
    "latched": "static transforms and latched messages for late joiners",
    "graph": "nodes, topics and services in the graph",
    "endpoints": "node and QoS of a publisher",
    "rosout": "`/rosout`",
    "mismatch": "QoS mismatch: an event, and no messages",
    "services": "services",
    "parameters": "parameters",
    "actions": "actions: goal, feedback, result, cancel",
    "lifecycle": "lifecycle nodes",
    INSIDE: "`coframe.ros2` in a node of ROS 2",
}
# Cells that cannot work, with the reason: (wire, distribution, row, whether coframe uses what ROS 2 provides).
KNOWN: Final = {("dds", "kilted", "endpoints", False)}

_NO_SERVER = "no server"  # see probe.py
_REFUSAL = "services, actions and parameters need the same middleware"  # part of coframe's warning
_PATIENCE = 60.0  # seconds
_domains = itertools.cycle(range(60, 100))


class Key(NamedTuple):
    """A cell of the table.

    Attributes:
        wire: The middleware of coframe.
        distro: The distribution of ROS 2.
        row: One of ROWS.
        coframe_uses: Whether coframe uses what ROS 2 provides, or the other way round.
    """

    wire: str
    distro: str
    row: str
    coframe_uses: bool


class Cell(NamedTuple):
    """What a cell contains: a state, and details for those who look for the cause."""

    state: str
    detail: str = ""


def coframe_side(wire: str) -> tuple[Path, dict[str, str]]:
    """Return the interpreter and the environment variables of coframe."""
    dropped = ("ROS_", "RMW_", "COFRAME_", "AMENT_", "CYCLONEDDS_", "FASTRTPS_", "FASTDDS_", "PYTHONPATH")
    variables = {name: value for name, value in os.environ.items() if not name.startswith(dropped)}
    return Path(sys.executable), {**variables, "COFRAME_WIRE": wire}


def run_pair(wire: str, environment: Environment, *, coframe_uses: bool) -> Iterator[tuple[Key, Cell]]:
    """Run both programs and yield the cells."""
    sides = [(environment.python, environment.variables()), coframe_side(wire)]
    outcomes, coframe_errors = run_programs(*(sides if coframe_uses else reversed(sides)), coframe_uses=coframe_uses)
    for row in ROWS:
        key = Key(wire, environment.distro.name, row, coframe_uses)
        yield key, Cell(SKIPPED) if row == INSIDE else judge(key, outcomes.get(row, "did not run"), coframe_errors)


def judge(key: Key, outcome: str, errors: str) -> Cell:
    """Return a cell, given what the probe reported and what coframe wrote to stderr."""
    if outcome == OK:
        return Cell(OK)
    if outcome == _NO_SERVER and _REFUSAL in errors:
        return Cell(REFUSED, outcome)
    return Cell(IMPOSSIBLE if key in KNOWN else FAILED, outcome)


def run_programs(
    peer: tuple[Path, Mapping[str, str]], probe: tuple[Path, Mapping[str, str]], *, coframe_uses: bool
) -> tuple[dict[str, str], str]:
    """Run peer.py on one side and probe.py on the other. Return the outcome of each row, and the stderr of coframe.

    Args:
        peer: The interpreter and the environment variables of the side that provides.
        probe: Those of the side that uses.
        coframe_uses: Whether the second one is coframe.
    """
    own = {"ROS_DOMAIN_ID": str(next(_domains)), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONUNBUFFERED": "1"}
    with tempfile.TemporaryDirectory() as folder:
        own["ROS_LOG_DIR"] = folder
        output, errors = Path(folder, "output"), Path(folder, "errors")
        command = [peer[0], PROGRAMS / "peer.py"]
        with output.open("w") as out, errors.open("w") as err:
            process = subprocess.Popen(command, env={**peer[1], **own}, stdout=out, stderr=err)
        try:
            _wait_for_line(process, output, errors)
            command = [probe[0], PROGRAMS / "probe.py"]
            environment = {**probe[1], **own}
            done = subprocess.run(
                command, env=environment, capture_output=True, text=True, timeout=4 * _PATIENCE, check=False
            )
        finally:
            process.kill()
            process.wait()
        outcomes = dict(json.loads(line)[:2] for line in done.stdout.splitlines() if line.startswith("["))
        return outcomes, done.stderr if coframe_uses else errors.read_text()


def _wait_for_line(process: subprocess.Popen[bytes], output: Path, errors: Path) -> None:
    deadline = time.monotonic() + _PATIENCE
    while "ready" not in output.read_text():
        if process.poll() is not None or time.monotonic() > deadline:
            raise SystemExit(f"{PROGRAMS / 'peer.py'} did not start:\n{errors.read_text()}")
        time.sleep(0.05)


def run_inside(environment: Environment) -> tuple[Key, Cell]:
    """Verify coframe.ros2 with the nodes of the environment, where coframe is installed with Cyclone DDS."""
    key = Key("dds", environment.distro.name, INSIDE, coframe_uses=True)
    command = [environment.python, VERIFY]
    variables = {**environment.variables(), "ROS_DOMAIN_ID": str(next(_domains))}
    done = subprocess.run(command, env=variables, capture_output=True, text=True, timeout=600, check=False)
    return key, Cell(OK) if done.returncode == 0 else Cell(FAILED, done.stdout + done.stderr)
