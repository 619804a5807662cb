# SPDX-License-Identifier: Apache-2.0
"""Several robots, one relay and one buffer: measures the processor time of the relay and the number of lost transforms.

Each robot is a process that publishes the transforms of its frames on its own topics. The relay, in another process,
adds the name of the robot as a prefix and publishes all transforms on /tf. This process has a buffer with unlimited
history. It prints the processor time of the relay in percent of one core, and the number of lost transforms:

    python -m benchmarks.fleet 10 20 50 10              # robots, frames of each, Hz, seconds
    python -m benchmarks.fleet direct 10 20 50 10       # without a relay: the processor time of the listener
"""

import contextlib
import itertools
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    import coframe

PATIENCE = 60.0  # seconds
KEEP = ("map",)


class Outcome(NamedTuple):
    """The processor time in percent of one core, and the numbers of transforms."""

    cpu: float
    sent: int
    lost: int


class Child:
    """A process of this module, or another one, that performs one step for each line of input, and answers it."""

    def __init__(self, *arguments: object, module: str = "benchmarks.fleet") -> None:
        command = [sys.executable, "-m", module, *map(str, arguments)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def go_on(self) -> None:
        assert self._process.stdin
        self._process.stdin.write("\n")
        self._process.stdin.flush()

    def answer(self) -> str:
        assert self._process.stdout
        line = self._process.stdout.readline()
        if not line:
            raise SystemExit("a process ended unexpectedly")
        return line

    def ask(self) -> str:
        self.go_on()
        return self.answer()

    def close(self) -> None:
        self._process.kill()
        self._process.communicate()


@contextlib.contextmanager
def fleet(robots: int, frames: int, hertz: float, seconds: float) -> Iterator[list[Child]]:
    """Start the robots; each answers its first request once it has a subscriber."""
    talkers = [Child("talk", f"robot{number}", frames, hertz, seconds) for number in range(robots)]
    try:
        yield talkers
    finally:
        for talker in talkers:
            talker.close()


def let_talk(talkers: list[Child]) -> None:
    """Let all robots publish, and wait until the last one is done."""
    for talker in talkers:
        talker.go_on()
    for talker in talkers:
        talker.answer()


def talk(name: str, frames: int, hertz: float, seconds: float) -> None:
    """Publish as one robot: a chain of frames below the map."""
    from coframe.messages import codec, find
    from coframe.wire import Participant
    from coframe.wire.qos import TF

    tf_message = find("tf2_msgs/msg/TFMessage")
    message = tf_message()
    names = ["map", *(f"link_{number}" for number in range(frames))]
    for parent, frame in itertools.pairwise(names):
        stamped = find("geometry_msgs/msg/TransformStamped")()
        stamped.header.frame_id, stamped.child_frame_id = parent, frame
        stamped.transform.rotation.w = 1.0
        message.transforms.append(stamped)
    participant = Participant.get()
    publisher = participant.publisher(participant.add_node(f"/{name}", "driver"), f"/{name}/tf", tf_message, TF)
    wait(lambda: publisher.matched > 0)
    answer("ready")
    sys.stdin.readline()
    start = time.monotonic()
    for number in range(int(hertz * seconds)):
        time.sleep(max(0.0, start + number / hertz - time.monotonic()))
        now = divmod(time.time_ns(), 1_000_000_000)
        for stamped in message.transforms:
            stamped.header.stamp.sec, stamped.header.stamp.nanosec = now
        publisher.write(codec.serialize(message))
    print("done", flush=True)
    sys.stdin.readline()
    participant.close()


def relay(robots: int) -> None:
    import coframe

    with coframe.relay([f"robot{number}" for number in range(robots)], prefix_each=True, keep=KEEP):
        answer("ready")
        sys.stdin.readline()
        begin, spent = time.monotonic(), time.process_time()
        print("begun", flush=True)
        sys.stdin.readline()
        print(100 * (time.process_time() - spent) / (time.monotonic() - begin), flush=True)
        sys.stdin.readline()


def answer(text: str) -> None:
    sys.stdin.readline()
    print(text, flush=True)


def wait(condition: Callable[[], bool]) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise SystemExit(f"timed out after {PATIENCE:g} s")
        time.sleep(0.01)


def measure(robots: int = 10, frames: int = 20, hertz: float = 50.0, seconds: float = 10.0) -> Outcome:
    """Run the benchmark once with a relay."""
    import coframe

    middleman = Child("relay", robots)
    try:
        with fleet(robots, frames, hertz, seconds) as talkers, coframe.connect("fleet_listener", cache=None) as ros:
            for child in (middleman, *talkers):
                child.ask()
            wait(lambda: len(ros.participant.publishers("/tf")) == 1)
            middleman.ask()
            let_talk(talkers)
            cpu = float(middleman.ask())
            return outcome(ros.buffer, robots * frames * int(hertz * seconds), cpu)
    finally:
        middleman.close()


def direct(robots: int, frames: int, hertz: float, seconds: float) -> Outcome:
    """Run the benchmark once without a relay; the listener renames the frames, and its processor time is measured."""
    import coframe
    from coframe.frame_names import renaming
    from coframe.wire import Participant

    buffer, participant = coframe.Buffer(None), Participant.get()
    node = participant.add_node("/", "fleet_listener")
    for number in range(robots):
        names = renaming(f"robot{number}/", KEEP)
        participant.tf_reader(node, f"/robot{number}/tf", buffer, static=False, renaming=names)
    with fleet(robots, frames, hertz, seconds) as talkers:
        for talker in talkers:
            talker.ask()
        begin, spent = time.monotonic(), time.process_time()
        let_talk(talkers)
        cpu = 100 * (time.process_time() - spent) / (time.monotonic() - begin)
        return outcome(buffer, robots * frames * int(hertz * seconds), cpu)


def outcome(buffer: "coframe.Buffer", sent: int, cpu: float) -> Outcome:
    """Return the outcome, once no transform has been received for a second."""
    before, since = buffer.statistics["stored"], time.monotonic()
    while time.monotonic() - since < 1.0:
        time.sleep(0.05)
        if buffer.statistics["stored"] != before:
            before, since = buffer.statistics["stored"], time.monotonic()
    return Outcome(cpu, sent, sent - sum(edge.samples for edge in buffer.edges()))


def main(*arguments: str) -> None:
    # Use only the loopback interface and a separate domain.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    what, *rest = arguments
    if what == "talk":
        talk(rest[0], int(rest[1]), float(rest[2]), float(rest[3]))
    elif what == "relay":
        relay(int(rest[0]))
    else:
        run = direct if what == "direct" else measure
        robots, frames, hertz, seconds = rest if what == "direct" else arguments
        result = run(int(robots), int(frames), float(hertz), float(seconds))
        print(result.cpu, result.lost, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
