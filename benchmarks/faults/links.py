# SPDX-License-Identifier: Apache-2.0
"""Faults of the network: loss, delay, duplication, reordering, partition, no multicast."""

from __future__ import annotations

import contextlib
import itertools
import json
import subprocess
import time
from typing import TYPE_CHECKING, Any, NamedTuple

from benchmarks.faults.case import Measurement, network_case
from benchmarks.faults.network import Impairment, Lan
from benchmarks.faults.processes import processes

if TYPE_CHECKING:
    from collections.abc import Iterator

ROBOTS = ("robot1", "robot2")
RATE = 100  # messages per second and robot
SECONDS = 30.0
RECOVERY = 3.0  # seconds
SETTLING = 5.0  # seconds
NS = 1_000_000_000


class Reception(NamedTuple):
    """What a listener received.

    Attributes:
        sent: The number of messages that were sent from the first one received on.
        missing: How many of these are not in the buffer.
        gap: The longest time without a newer transform of a robot, in seconds.
        statics: The time from the start of the listener until all static transforms were there; None if never.
        discovery: The part of that time until all their publishers had been discovered.
        delay: The median of the delays, in seconds.
    """

    sent: int
    missing: int
    gap: float
    statics: float | None
    discovery: float
    delay: float

    def __str__(self) -> str:
        statics = "did not arrive" if self.statics is None else f"after {self.statics:.1f} s"
        return (
            f"{self.missing} of {self.sent} messages missing, longest gap {self.gap:.2f} s, "
            f"statics {statics} ({self.discovery:.1f} s for discovery), median delay {1000 * self.delay:.0f} ms"
        )


@contextlib.contextmanager
def lan(hosts: int = 2) -> Iterator[Lan]:
    """Yield a network, whose hosts use multicast discovery."""
    made = Lan(hosts)
    try:
        yield made
    finally:
        made.close()


def evaluate(report: dict[str, Any], started: float) -> Reception:
    """Evaluate the report of a listener."""
    sent = missing = 0
    gap = 0.0
    delays: list[float] = []
    offset = time.time_ns() - time.monotonic_ns()
    for robot, arrivals in report["arrivals"].items():
        if not arrivals:
            return Reception(0, 0, float("inf"), None, float("inf"), 0.0)
        stored = report["stored"][robot]
        first = stored.index(True) if True in stored else len(stored)
        sent += len(stored) - first
        missing += stored[first:].count(False)
        gap = max([gap, *(later - earlier for (earlier, _), (later, _) in itertools.pairwise(arrivals))])
        delays += [arrival - (stamp - offset) / NS for arrival, stamp in arrivals]
    statics = report["statics"]
    complete = max(statics.values()) - started if len(statics) == len(report["arrivals"]) else None
    discovery = max((report["discovered"] or float("inf")) - started, 0.0)
    return Reception(sent, missing, gap, complete, discovery, sorted(delays)[len(delays) // 2])


def first_after(begin: float, arrivals: list[tuple[float, int]]) -> float:
    """Return the time of the first arrival after a time; infinity if there is none."""
    return next((arrived for arrived, _ in arrivals if arrived > begin), float("inf"))


def stop_and_evaluate(talkers: dict[str, Any], listener: Any, recovery: float = RECOVERY) -> Reception:
    """End the talkers, wait for messages that are sent again, and evaluate the listener."""
    sent = {robot: talker.ask()["stamps"] for robot, talker in talkers.items()}
    time.sleep(recovery)
    return evaluate(listener.ask(json.dumps(sent)), listener.started)


def _measure_with(impairment: Impairment) -> Measurement:
    """Start a listener on an impaired network, and compare what it received with what was sent."""
    result = _received_under(impairment)
    kept = result.missing == 0 and result.gap <= RECOVERY and (result.statics or float("inf")) <= RECOVERY
    return Measurement(str(result), kept and result.sent > 0)


def _received_under(impairment: Impairment) -> Reception:
    with lan() as network, processes(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET") as started:
        first, second = network.hosts
        talkers = {robot: started.node("talker", robot, RATE, host=first) for robot in ROBOTS}
        network.impairment = impairment
        listener = started.node("listener", *ROBOTS, host=second)
        listener.started = time.monotonic()
        time.sleep(SECONDS)
        return stop_and_evaluate(talkers, listener)


_PROMISE = "no reliable message is missing, no gap above 3 s, statics within 3 s"


@network_case("loss_5", f"5 % of the packets are lost: {_PROMISE}")
def _loss_5() -> Measurement:
    return _measure_with(Impairment(loss=0.05))


@network_case("loss_10", f"10 % of the packets are lost: {_PROMISE}")
def _loss_10() -> Measurement:
    return _measure_with(Impairment(loss=0.10))


@network_case("loss_30", f"30 % of the packets are lost: {_PROMISE}")
def _loss_30() -> Measurement:
    return _measure_with(Impairment(loss=0.30))


@network_case("loss_30_arp", "30 % of the packets and of the ARP frames are lost: statics within 20 s")
def _loss_30_arp() -> Measurement:
    result = _received_under(Impairment(loss=0.30, arp=True))
    return Measurement(str(result), (result.statics or float("inf")) <= 20.0)


@network_case("delay_200", f"each packet is delayed by 200 ms: {_PROMISE}")
def _delay_200() -> Measurement:
    return _measure_with(Impairment(delay=0.2))


@network_case("duplicates", f"half of the packets arrive twice: {_PROMISE}")
def _duplicates() -> Measurement:
    return _measure_with(Impairment(duplicates=0.5))


@network_case("reordering", f"30 % of the packets are overtaken by up to 50 ms: {_PROMISE}")
def _reordering() -> Measurement:
    return _measure_with(Impairment(reordered=0.3))


@network_case("bad_wireless", f"10 % loss, 50 ms delay, 10 % duplicates, 20 % reordered at once: {_PROMISE}")
def _bad_wireless() -> Measurement:
    return _measure_with(Impairment(loss=0.1, delay=0.05, duplicates=0.1, reordered=0.2))


@network_case("partition_15", "after 15 s without any packet: transforms again within 3 s, statics of new nodes too")
def _partition() -> Measurement:
    with lan() as network, processes(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET") as started:
        first, second = network.hosts
        talkers = {"robot1": started.node("talker", "robot1", RATE, host=first)}
        listener = started.node("listener", *ROBOTS, host=second)
        time.sleep(SETTLING)
        network.impairment = Impairment(cut=True)
        time.sleep(12.0)
        talkers["robot2"] = started.node("talker", "robot2", RATE, host=first)
        time.sleep(3.0)
        network.impairment = Impairment()
        healed = time.monotonic()
        time.sleep(10.0)
        sent = {robot: talker.ask()["stamps"] for robot, talker in talkers.items()}
        report = listener.ask(json.dumps(sent))
    again = max(first_after(healed, report["arrivals"][robot]) for robot in ROBOTS) - healed
    statics = report["statics"].get("robot2", float("inf")) - healed
    text = f"transforms of both nodes again after {again:.1f} s, statics of the new one after {statics:.1f} s"
    return Measurement(text, max(again, statics) <= RECOVERY)


@network_case(
    "no_multicast", "on one machine, without multicast on its loopback interface: statics within 3 s, nothing missing"
)
def _no_multicast() -> Measurement:
    with lan(1) as network, processes(ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST") as started:
        host = network.hosts[0]
        subprocess.run(host.command("ip", "link", "set", "lo", "multicast", "off"), check=True)
        talkers = {robot: started.node("talker", robot, RATE, host=host) for robot in ROBOTS}
        listener = started.node("listener", *ROBOTS, host=host)
        listener.started = time.monotonic()
        time.sleep(SETTLING)
        result = stop_and_evaluate(talkers, listener)
    return Measurement(str(result), result.missing == 0 and (result.statics or float("inf")) <= RECOVERY)


@network_case(
    "no_multicast_lan", "no multicast between machines, ROS_STATIC_PEERS on both: statics within 3 s, nothing missing"
)
def _no_multicast_lan() -> Measurement:
    with lan() as network, processes(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET") as started:
        first, second = network.hosts
        network.impairment = Impairment(multicast=False)
        peer = {"ROS_STATIC_PEERS": second.address}
        talkers = {robot: started.node("talker", robot, RATE, host=first, **peer) for robot in ROBOTS}
        listener = started.node("listener", *ROBOTS, host=second, ROS_STATIC_PEERS=first.address)
        listener.started = time.monotonic()
        time.sleep(SETTLING)
        result = stop_and_evaluate(talkers, listener)
    return Measurement(str(result), result.missing == 0 and (result.statics or float("inf")) <= RECOVERY)
