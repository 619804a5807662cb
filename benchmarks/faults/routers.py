# SPDX-License-Identifier: Apache-2.0
"""Faults between nodes on Zenoh in two networks that only a router connects: delay, loss, a router that is killed."""

from __future__ import annotations

import contextlib
import importlib.util
import json
import subprocess
import time
from typing import TYPE_CHECKING

from benchmarks.faults.case import Measurement, SkippedError, case
from benchmarks.faults.links import ROBOTS, Reception, evaluate, first_after, lan
from benchmarks.faults.network import Impairment
from benchmarks.faults.processes import Processes, Program, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from benchmarks.faults.network import Host, Lan

RATE = 20  # messages per second and robot; a TCP connection with this delay and loss cannot carry many more
SECONDS = 30.0
STATICS = 10.0  # seconds; opening a connection takes several round trips, and lost packets are sent again
RECOVERY = 5.0  # seconds
PORT = 7447


class Routed(Processes):
    """Processes on two hosts, robot and laptop, that reach only the router on a third host."""

    def __init__(self, network: Lan) -> None:
        self.robot, self.middle, self.laptop = network.hosts
        router = json.dumps([f"tcp/{self.middle.address}:{PORT}"])
        override = f'mode="client";connect/endpoints={router}'
        super().__init__({"COFRAME_WIRE": "zenoh", "ZENOH_CONFIG_OVERRIDE": override})
        for host, other in ((self.robot, self.laptop), (self.laptop, self.robot)):
            _ip(host, "route", "add", "blackhole", f"{other.address}/32")

    def router(self) -> Program:
        """Start the router, and wait until it listens."""
        command = ("python", "-m", "coframe.cli", "router", "--listen", f"tcp/0.0.0.0:{PORT}")
        router = self.start(*command, host=self.middle, quiet=True, ZENOH_CONFIG_OVERRIDE="")
        wait_for(lambda: "Listening on" in router.errors(), "the router")
        return router

    def listener(self) -> Program:
        """Start a listener on the laptop."""
        started = time.monotonic()
        program = self.node("listener", *ROBOTS, host=self.laptop)
        program.started = started
        return program


@contextlib.contextmanager
def routed() -> Iterator[tuple[Lan, Routed]]:
    """Yield the network and its processes."""
    if importlib.util.find_spec("zenoh") is None:
        raise SkippedError("eclipse-zenoh is not installed: pip install 'coframe[zenoh]'")
    with lan(3) as network:
        started = Routed(network)
        try:
            yield network, started
        finally:
            started.close()


def _ip(host: Host, *words: str) -> None:
    subprocess.run(host.command("ip", *words), check=True)


@case(
    "router_wan",
    "two networks joined by a router, 100 ms delay and 5 % loss on each link: nothing is missing, statics reach "
    "early and late listeners within 10 s",
)
def _wan() -> Measurement:
    with routed() as (network, started):
        started.router()
        talkers = {robot: started.node("talker", robot, RATE, host=started.robot) for robot in ROBOTS}
        network.impairment = Impairment(delay=0.1, loss=0.05)
        early = started.listener()
        time.sleep(SECONDS / 2)
        late = started.listener()
        time.sleep(SECONDS / 2)
        sent = json.dumps({robot: talker.ask()["stamps"] for robot, talker in talkers.items()})
        time.sleep(RECOVERY)
        results = [evaluate(listener.ask(sent), listener.started) for listener in (early, late)]
    text = "; ".join(f"{name}: {result}" for name, result in zip(("early", "late"), results, strict=True))
    return Measurement(text, all(_is_complete(result) for result in results))


@case(
    "router_killed",
    "kill -9 of the router, a new one after 3 s: transforms again within 5 s, statics at new listeners too",
)
def _killed() -> Measurement:
    with routed() as (_, started):
        router = started.router()
        talkers = {robot: started.node("talker", robot, RATE, host=started.robot) for robot in ROBOTS}
        listener = started.listener()
        time.sleep(5.0)
        router.process.kill()
        time.sleep(3.0)
        started.router()
        restarted = time.monotonic()
        late = started.listener()
        time.sleep(15.0)
        sent = json.dumps({robot: talker.ask()["stamps"] for robot, talker in talkers.items()})
        report, new = listener.ask(sent), late.ask(sent)
    again = max(first_after(restarted, report["arrivals"][robot]) for robot in ROBOTS) - restarted
    statics = max(new["statics"].get(robot, float("inf")) for robot in ROBOTS) - restarted
    text = f"transforms again after {again:.1f} s, statics at a new listener after {statics:.1f} s"
    return Measurement(text, max(again, statics) <= RECOVERY)


def _is_complete(result: Reception) -> bool:
    return result.sent > 0 and result.missing == 0 and result.statics is not None and result.statics <= STATICS
