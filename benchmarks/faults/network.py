# SPDX-License-Identifier: Apache-2.0
"""Hosts in network namespaces, and a switch between them that loses, delays, duplicates and reorders frames.

The switch is a thread of this process with one TAP device per host, because not every kernel has netem.
"""

from __future__ import annotations

import contextlib
import fcntl
import heapq
import itertools
import os
import random
import select
import struct
import subprocess
import threading
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from benchmarks.faults.case import SkippedError

if TYPE_CHECKING:
    from collections.abc import Iterator

_TUNSETIFF = 0x400454CA
_TAP, _NO_PACKET_INFORMATION = 0x0002, 0x1000
_MAX_FRAME_BYTES = 65536
_ARP = bytes.fromhex("0806")  # the type of a frame, after two addresses of 6 bytes
_IPV4_MULTICAST = bytes.fromhex("01005e")  # begin of the destination address
_UP = "ip link set lo up && ip link set lo multicast on && echo up && exec cat"


@dataclass(frozen=True)
class Impairment:
    """What the switch does with each frame.

    Attributes:
        loss: The probability that a frame is lost.
        arp: Whether ARP frames can be lost, too. Linux repeats a lost ARP request once per second.
        delay: The delay in seconds.
        duplicates: The probability that a frame is delivered twice.
        reordered: The probability that a frame is overtaken: it is delivered up to 50 ms later.
        cut: Whether no frame is delivered at all.
        multicast: Whether IPv4 multicast is delivered.
    """

    loss: float = 0.0
    arp: bool = False
    delay: float = 0.0
    duplicates: float = 0.0
    reordered: float = 0.0
    cut: bool = False
    multicast: bool = True

    def deliveries(self, frame: bytes, chance: random.Random) -> Iterator[float]:
        """Yield the delay of each delivery of one frame, in seconds."""
        if self.cut or (not self.multicast and frame.startswith(_IPV4_MULTICAST)):
            return
        loss = 0.0 if frame[12:14] == _ARP and not self.arp else self.loss
        for _ in range(1 + (chance.random() < self.duplicates)):
            if chance.random() >= loss:
                yield self.delay + (chance.uniform(0.0, 0.05) if chance.random() < self.reordered else 0.0)


class Host:
    """A network namespace with one interface to the switch."""

    def __init__(self, number: int) -> None:
        self.address = f"10.77.0.{number}"
        device = f"tap{number}"
        try:
            self.tap = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
        except OSError as error:
            raise SkippedError(
                f"/dev/net/tun cannot be opened ({error.strerror}): no network can be made here"
            ) from None
        self._holder = subprocess.Popen(
            ["unshare", "--net", "sh", "-c", _UP], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self._holder.stdout
        self._holder.stdout.readline()
        fcntl.ioctl(self.tap, _TUNSETIFF, struct.pack("16sH", device.encode(), _TAP | _NO_PACKET_INFORMATION))
        _ip("link", "set", device, "netns", str(self._holder.pid))
        for words in (
            f"addr add {self.address}/24 dev {device}",
            f"link set {device} up multicast on",
            f"route add default dev {device}",
        ):
            subprocess.run([*self.command("ip", *words.split())], check=True)

    def command(self, *command: str) -> list[str]:
        """Return the command that runs a command on this host."""
        return ["nsenter", "--target", str(self._holder.pid), "--net", *command]

    def close(self) -> None:
        """Remove the namespace with its last process."""
        os.close(self.tap)
        self._holder.communicate("", 10)


class Lan:
    """Hosts at one switch."""

    def __init__(self, hosts: int, seed: int = 1) -> None:
        self.impairment = Impairment()
        self.frames = self.lost = 0
        self.hosts: list[Host] = []
        self._chance = random.Random(seed)  # noqa: S311 - not for cryptography
        self._due: list[tuple[float, int, int, bytes]] = []  # time, number, device, frame
        self._numbers = itertools.count()
        self._closing = False
        for number in range(1, hosts + 1):
            self.hosts.append(Host(number))
        self._thread = threading.Thread(target=self._run, name="switch", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop the switch and remove the hosts."""
        self._closing = True
        self._thread.join()
        for host in self.hosts:
            host.close()

    def _run(self) -> None:
        taps = [host.tap for host in self.hosts]
        while not self._closing:
            wait = min(max(self._due[0][0] - time.monotonic(), 0.0), 0.1) if self._due else 0.1
            for tap in select.select(taps, [], [], wait)[0]:
                self._receive(tap, [other for other in taps if other != tap])
            self._deliver()

    def _receive(self, tap: int, others: list[int]) -> None:
        with contextlib.suppress(BlockingIOError):
            while True:
                frame = os.read(tap, _MAX_FRAME_BYTES)
                for other in others:
                    deliveries = list(self.impairment.deliveries(frame, self._chance))
                    self.frames += 1
                    self.lost += not deliveries
                    for delay in deliveries:
                        heapq.heappush(self._due, (time.monotonic() + delay, next(self._numbers), other, frame))

    def _deliver(self) -> None:
        while self._due and self._due[0][0] <= time.monotonic():
            _, _, tap, frame = heapq.heappop(self._due)
            with contextlib.suppress(OSError):  # The device is not up yet, or its queue is full.
                os.write(tap, frame)


def _ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True)
