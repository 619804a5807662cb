# SPDX-License-Identifier: Apache-2.0
"""Count the processor instructions of a message by layer: Python, coframe, Cyclone DDS, and the C library.

    python -m benchmarks.layers listener 5     the thread that receives messages of ten transforms
    python -m benchmarks.layers socket 5       a thread that receives the same bytes from a bare socket
    python -m benchmarks.layers publisher 5    the thread that calls sendTransform with one transform

The numbers are instructions outside the kernel per message, counted for a few seconds by Valgrind
(``apt-get install valgrind``) at 1 kHz, or as fast as the emulated processor can. A busy machine does not change them.
The functions with the most instructions follow: first their own, then with those of the functions that they call. The
other side is a process that is not counted.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

LISTENER, SOCKET, PUBLISHER = "listener", "socket", "publisher"
FUNCTIONS = 40
TIME_LIMIT_S = 300
PAUSE_S = 0.001
WARM_UP_S = 12.0
"""Longer than the history of a buffer, which allocates memory until it is full."""
LAYERS = {
    "_core.": "coframe",
    "libddsc": "Cyclone DDS",
    "python": "Python",
    "libc": "C library",
    "libm.": "C library",
    "ld-linux": "C library",
    "libstdc++": "C++ library",
}
RECEIVER = """
import sys
from benchmarks.publishing import RclpyReceiver
receiver = RclpyReceiver("tf")
sys.stdin.read()
"""


def layer_of(path: str) -> str:
    name = Path(path).name
    return next((layer for part, layer in LAYERS.items() if part in name), "other")


class Costs(NamedTuple):
    """Instructions.

    Attributes:
        layers: Of each layer.
        own: Of each function, a pair of layer and name.
        total: The same with the functions that it calls.
    """

    layers: Counter[str]
    own: Counter[tuple[str, str]]
    total: Counter[tuple[str, str]]


def costs(profile: str) -> Costs:
    """Return the instructions in a file of Callgrind."""
    names: dict[str, str] = {}  # the file contains each name once, with a number for the next time

    def name_of(value: str) -> str:
        number, _, name = value.partition(" ")
        return names.setdefault(number, name)

    result = Costs(Counter(), Counter(), Counter())
    layer = function = ""
    is_called = False
    for line in profile.splitlines():
        key, _, value = line.partition("=")
        if key in ("ob", "cob"):
            path = name_of("object" + value)
            layer = layer_of(path) if key == "ob" else layer
        elif key in ("fn", "cfn"):
            name = name_of("function" + value)
            function = name if key == "fn" else function
        elif key == "calls":
            is_called = True  # The next line has the cost of the called function.
        elif re.match(r"[+\-*\d]", line):
            count = int(line.split()[1])
            result.total[layer, function] += count
            if not is_called:
                result.layers[layer] += count
                result.own[layer, function] += count
            is_called = False
    return result


@contextlib.contextmanager
def listening() -> Iterator[Callable[[], int]]:
    from benchmarks.wire_latency import Coframe, talker

    listener = Coframe()
    with talker(sys.executable, listener, TIME_LIMIT_S, ""):
        yield lambda: listener.received


@contextlib.contextmanager
def receiving() -> Iterator[Callable[[], int]]:
    from benchmarks.wire_latency import Udp, talker

    listener, received = Udp(), 0

    def run() -> None:
        nonlocal received
        while True:
            listener.next_message()
            received += 1

    with talker(sys.executable, listener, TIME_LIMIT_S, ""):
        threading.Thread(target=run, daemon=True).start()
        yield lambda: received


@contextlib.contextmanager
def publishing() -> Iterator[Callable[[], int]]:
    from benchmarks.publishing import rclpy_sender

    sent = 0
    with subprocess.Popen([sys.executable, "-c", RECEIVER], stdin=subprocess.PIPE), rclpy_sender("tf", "") as send:

        def run() -> None:
            nonlocal sent
            while True:
                send()
                sent += 1
                time.sleep(PAUSE_S)

        threading.Thread(target=run, daemon=True).start()
        yield lambda: sent


SUBJECTS = {LISTENER: listening, SOCKET: receiving, PUBLISHER: publishing}


def run(subject: str, seconds: float) -> None:
    """Let Valgrind, which emulates this process, write the profiles of its threads; print the number of messages."""
    with SUBJECTS[subject]() as count:
        time.sleep(WARM_UP_S)
        control("--zero")
        before = count()
        time.sleep(seconds)
        messages = count() - before
        control("--dump")
        print(messages, flush=True)
    os._exit(0)


def control(command: str) -> None:
    subprocess.run(["callgrind_control", command, str(os.getpid())], check=True, stdout=subprocess.DEVNULL)


def profile(subject: str, seconds: str) -> tuple[int, list[str]]:
    """Return how many messages were counted, and the profile of each thread."""
    with tempfile.TemporaryDirectory() as folder:
        output = f"--callgrind-out-file={folder}/profile"
        valgrind = ["valgrind", "--tool=callgrind", "--separate-threads=yes", output]
        command = [*valgrind, sys.executable, "-m", "benchmarks.layers", "run", subject, seconds]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise SystemExit(f"layers: the program failed under Valgrind:\n{done.stderr[-2000:]}")
        return int(done.stdout), [path.read_text() for path in Path(folder).glob("profile.1-*")]


def main(subject: str, seconds: str) -> None:
    if shutil.which("callgrind_control") is None:
        raise SystemExit("layers: Valgrind is not installed. On Debian or Ubuntu: apt-get install valgrind")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    os.environ["COFRAME_CPU_LEVEL"] = "plain"  # Valgrind does not know all processors.
    messages, profiles = profile(subject, seconds)
    layers, own, total = max((costs(text) for text in profiles), key=lambda result: result.layers.total())
    print(f"{subject}: {layers.total() / messages:.0f} instructions per message, {messages} messages")
    for layer, count in layers.most_common():
        print(f"{count / messages:8.0f}  {count / layers.total():4.0%}  {layer}")
    for title, functions in ("Functions alone", own), ("Functions with those that they call", total):
        print(f"\n{title}:")
        for (layer, function), count in functions.most_common(FUNCTIONS):
            print(f"{count / messages:8.0f}  {layer:12}  {function[:90]}")


if __name__ == "__main__":
    if sys.argv[1] == "run":
        run(sys.argv[2], float(sys.argv[3]))
    main(*sys.argv[1:])
