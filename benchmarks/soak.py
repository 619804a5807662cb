# SPDX-License-Identifier: Apache-2.0
"""`make soak`: a long run of a whole system, in which memory, descriptors, threads and files must not grow.

make soak                         30 minutes: 20 nodes that publish 20 000 transforms per second in total
make soak ARGS="--minutes 3"      a short one
make soak ARGS="--rate 20"        for a busy machine: each node sends 20 messages per second instead of 50

A listener, `coframe record`, `coframe view` with a connected page and `coframe doctor --watch` receive all transforms.
Every 20 s, another node joins and leaves. Each process is measured every second. After a warm-up of a sixth of the time
(at least 1 minute), the median memory of the last 5 minutes must be at most 1 % above that of the first 5; the page
stands for a browser, and is only measured. The exit code is 1 if a process grew, if messages were lost, or if anything
was left behind.
"""

from __future__ import annotations

import argparse
import signal
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import coframe
from benchmarks import machine
from benchmarks.faults.processes import Processes, Program, answers, descriptors, free_port, processes, wait_for

if TYPE_CHECKING:
    from coframe.bags import Recording

NODES = 20
TRANSFORMS = 20  # per message
GROWTH = 0.01
PASSING = 20.0  # seconds between two nodes that join and leave
_WINDOW = 300  # seconds that are compared
DOMAIN = "87"
CLI = ("python", "-m", "coframe.cli")

PAGE = """
import sys
from websockets.sync.client import connect
with connect(sys.argv[1], max_size=None, compression=None) as socket:
    while True:
        if isinstance(socket.recv(), bytes):
            socket.send('{"type":"ready"}')
"""


class Sample(NamedTuple):
    """The resources of a process; memory is what it has in RAM without mapped files, whose pages the kernel moves."""

    memory: int
    descriptors: int
    threads: int


class Watched:
    """A process and its samples."""

    def __init__(self, name: str, program: Program) -> None:
        self.name = name
        self.program = program
        self.samples: list[Sample] = []

    def sample(self) -> None:
        """Measure its resources."""
        process = self.program.process.pid
        if self.program.process.poll() is not None:
            raise RuntimeError(f"{self.name} ended: {self.program.errors()[-2000:]}")
        status = Path(f"/proc/{process}/status").read_text()
        kilobytes = sum(int(status.split(kind)[1].split()[0]) for kind in ("RssAnon:", "RssShmem:"))
        threads = len(list(Path(f"/proc/{process}/task").iterdir()))
        self.samples.append(Sample(kilobytes * 1024, descriptors(process), threads))

    def growth(self, warm_up: int) -> float:
        """Return the growth of the memory after the warm-up, as a fraction."""
        first, last = (statistics.median(sample.memory for sample in part) for part in self._ends(warm_up))
        return last / first - 1

    def changes(self, warm_up: int) -> tuple[int, int]:
        """Return by how much the least numbers of descriptors and threads have changed since the warm-up."""
        first, last = self._ends(warm_up)
        return (
            min(sample.descriptors for sample in last) - min(sample.descriptors for sample in first),
            min(sample.threads for sample in last) - min(sample.threads for sample in first),
        )

    def _ends(self, warm_up: int) -> tuple[list[Sample], list[Sample]]:
        after = self.samples[warm_up:]
        length = max(min(_WINDOW, len(after) // 3), 1)
        return after[:length], after[-length:]


def start(started: Processes, folder: Path, rate: float) -> list[Watched]:
    """Start all processes; the listeners first, so that they receive every message."""
    port = free_port()
    commands = {
        "listener": ("python", "-m", "benchmarks.soak_programs", "listener", str(NODES)),
        "record": (*CLI, "record", "-o", str(folder / "run")),
        "view": (*CLI, "view", "--no-browser", "--port", str(port)),
        "doctor": (*CLI, "doctor", "--watch", "--json"),
    }
    watched = [Watched(name, started.start(*command, quiet=name != "listener")) for name, command in commands.items()]
    watched[0].program.line()
    wait_for(lambda: answers(port, watched[2].program), "the viewer")
    watched.append(Watched("page", started.start("python", "-c", PAGE, f"ws://127.0.0.1:{port}/ws", quiet=True)))
    wait_for((folder / "run").exists, "the recorder")
    time.sleep(2.0)  # The commands join the graph.
    for number in range(NODES):
        arguments = ("talker", str(number), str(rate), str(TRANSFORMS))
        watched.append(Watched(f"node {number}", started.start("python", "-m", "benchmarks.soak_programs", *arguments)))
    for each in watched[-NODES:]:
        each.program.line()
    return watched


class Soak:
    """The measurement."""

    def __init__(self, started: Processes, watched: list[Watched]) -> None:
        self._started = started
        self._watched = watched
        self._passing: Program | None = None
        self.reports: list[dict[str, float]] = []

    def run(self, seconds: float) -> None:
        """Sample every second, and print a line every minute."""
        names = "listener", "record", "view", "doctor", "page"
        print("minute  transforms/s  lost  p50 ms  p99 ms  " + "  ".join(f"{name:>8}" for name in (*names, "nodes")))
        begin = time.monotonic()
        self._report()
        for second in range(1, int(seconds) + 1):
            time.sleep(max(begin + second - time.monotonic(), 0.0))
            for each in self._watched:
                each.sample()
            if second % PASSING == 1:
                self._pass_by(second)
            if second % 60 == 0:
                report = self._report()
                sizes = [each.samples[-1].memory / 1e6 for each in self._watched[: len(names)]]
                nodes = statistics.mean(each.samples[-1].memory / 1e6 for each in self._watched[len(names) :])
                latencies = f"{report['p50']:6.2f}  {report['p99']:6.2f}"
                memory = "  ".join(f"{size:5.1f} MB" for size in (*sizes, nodes))
                received = f"{report['transforms'] / 60:12.0f}  {report['lost']:4.0f}"
                print(f"{second // 60:6}  {received}  {latencies}  {memory}", flush=True)

    def _report(self) -> dict[str, float]:
        report: dict[str, float] = self._watched[0].program.ask("report")
        self.reports.append(report)
        return report

    def _pass_by(self, number: int) -> None:
        if self._passing:
            self._passing.close()
            self._started.forget(self._passing)
        arguments = ("passing", str(number))
        self._passing = self._started.start("python", "-m", "benchmarks.soak_programs", *arguments, quiet=True)


def not_recorded(bag: Recording, sent: int) -> int:
    """Return how many messages are missing after the first one of each node: before, the recorder was not connected."""
    oldest = {frame.name: frame.oldest for frame in bag.buffer.frames()}
    names = [f"robot{number}_0" for number in range(NODES)]
    before = sum(int(bag.buffer.lookup("map", name, oldest[name]).x) for name in names)
    return sent - before - bag.topics["/tf"].messages


def finish(watched: list[Watched], folder: Path) -> tuple[int, list[str]]:
    """End all processes; return how many messages were not recorded, and what was not ended or removed."""
    talkers = watched[-NODES:]
    sent = sum(int(each.program.ask()) for each in talkers)
    time.sleep(3.0)  # Lost messages are sent again.
    left = []
    watched[0].program.ask("end")
    for each in watched[1:4]:
        each.program.process.send_signal(signal.SIGINT)
    for each in talkers:
        each.program.tell()
    for each in [*watched[:4], *talkers]:
        code = each.program.process.wait(60)
        if code not in (0, 130):
            left.append(f"{each.name} ended with exit code {code}: {each.program.errors()[-500:]}")
    with coframe.open_bag(folder / "run") as bag:
        missing = not_recorded(bag, sent)
        left += bag.problems
    left += [f"{path.name} in the temporary folder" for path in (folder / "temporary").iterdir()]
    return missing, left


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=30.0, help="how long to measure (default: 30)")
    parser.add_argument("--rate", type=float, default=50.0, help="messages per second of each node (default: 50)")
    options = parser.parse_args()
    seconds = 60 * options.minutes
    warm_up = int(max(60.0, seconds / 6))
    if seconds < warm_up + 60:
        parser.error("--minutes must be at least 2")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "temporary").mkdir()
        with processes(TMPDIR=str(folder / "temporary"), ROS_DOMAIN_ID=DOMAIN) as started:
            watched = start(started, folder, options.rate)
            soak = Soak(started, watched)
            soak.run(seconds)
            missing, problems = finish(watched, folder)
    return summarize(watched, soak.reports, warm_up, missing, problems)


def summarize(
    watched: list[Watched], reports: list[dict[str, float]], warm_up: int, missing: int, problems: list[str]
) -> int:
    """Print the summary, and return the exit code."""
    print("\n| process | memory | growth after the warm-up | descriptors | threads |\n|---|---|---|---|---|")
    for each in watched:
        growth, (files, threads) = each.growth(warm_up), each.changes(warm_up)
        last = each.samples[-1]
        resources = f"{last.descriptors} ({files:+}) | {last.threads} ({threads:+})"
        print(f"| {each.name} | {last.memory / 1e6:.1f} MB | {100 * growth:+.2f} % | {resources} |")
        if growth > GROWTH and each.name != "page":  # which stands for a browser
            problems.append(f"the memory of {each.name} grew by {100 * growth:.2f} %")
        if files > 0 or threads > 0:
            problems.append(f"{each.name} has {files} more descriptors and {threads} more threads")
    lost = sum(report["lost"] for report in reports)
    if lost or missing:
        problems.append(f"{lost:.0f} messages were not received, {missing} were not recorded")
    facts = machine.facts()
    print("", *(f"{key}: {facts[key]}" for key in ("Date", "Machine", "Load", "coframe", "Python")), sep="\n")
    seconds = len(watched[0].samples)
    transforms = sum(report["transforms"] for report in reports[1:])
    worst = max((report["p99"] for report in reports[1:]), default=0.0)
    middle = statistics.median(report["p50"] for report in reports[1:])
    print(
        f"\n{seconds / 60:.0f} minutes, {transforms:.0f} transforms received, {lost:.0f} messages lost; latency from "
        f"the stamp to the callback: median {middle:.2f} ms, 99th percentile {worst:.2f} ms in the worst minute"
    )
    print(
        "\n".join(f"PROBLEM: {problem}" for problem in problems) or "nothing grew, nothing was lost, nothing was left"
    )
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main())
