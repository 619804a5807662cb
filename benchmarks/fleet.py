"""Many robots, one relay, one buffer: is anything lost, and what does the relay cost?

Each robot is a process that publishes the transforms of its frames on topics of its own; the relay, in another process,
puts its name in front of them and writes all to /tf; this process has a buffer that keeps everything. It prints the
relay's processor time in percent of one core and how many transforms have not arrived:

    python -m benchmarks.fleet 10 20 50 10        # robots, frames of each, Hz, seconds
"""

import itertools
import os
import subprocess
import sys
import time
from collections.abc import Callable
from typing import NamedTuple

PATIENCE = 60.0  # seconds
KEEP = ("map",)


class Outcome(NamedTuple):
    """What came out: percent of one core, and transforms."""

    cpu: float
    sent: int
    lost: int


def child(*arguments: object) -> "subprocess.Popen[str]":
    command = [sys.executable, "-m", "benchmarks.fleet", *map(str, arguments)]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def ask(process: "subprocess.Popen[str]") -> str:
    """Lets a child go on, and waits for its word."""
    assert process.stdin
    assert process.stdout
    process.stdin.write("\n")
    process.stdin.flush()
    return process.stdout.readline()


def talk(name: str, frames: int, hertz: float, seconds: float) -> None:
    """A robot: a chain of frames below the map."""
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
        begin, spent = time.monotonic(), time.process_time()
        answer("begun")
        answer(str(100 * (time.process_time() - spent) / (time.monotonic() - begin)))
        sys.stdin.readline()


def answer(text: str) -> None:
    sys.stdin.readline()
    print(text, flush=True)


def wait(condition: Callable[[], bool]) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise SystemExit(f"waited in vain for {PATIENCE:g} s")
        time.sleep(0.01)


def measure(robots: int = 10, frames: int = 20, hertz: float = 50.0, seconds: float = 10.0) -> Outcome:
    """One run."""
    import coframe

    processes = [child("relay", robots)]
    processes += [child("talk", f"robot{number}", frames, hertz, seconds) for number in range(robots)]
    try:
        with coframe.connect("fleet_listener", cache=None) as ros:
            for process in processes:
                if ask(process) != "ready\n":
                    raise SystemExit("a process did not start")
            wait(lambda: len(ros.participant.publishers("/tf")) == 1)
            middleman, *talkers = processes
            ask(middleman)
            for talker in talkers:
                assert talker.stdin
                talker.stdin.write("\n")
                talker.stdin.flush()
            for talker in talkers:
                assert talker.stdout
                talker.stdout.readline()
            cpu = float(ask(middleman))
            sent = robots * frames * int(hertz * seconds)
            settle(lambda: ros.buffer.statistics["stored"])
            return Outcome(cpu, sent, sent - sum(edge.samples for edge in ros.buffer.edges()))
    finally:
        for process in processes:
            process.kill()
            process.communicate()


def settle(count: Callable[[], int]) -> None:
    """Waits until nothing has come for a second."""
    before, since = count(), time.monotonic()
    while time.monotonic() - since < 1.0:
        time.sleep(0.05)
        if count() != before:
            before, since = count(), time.monotonic()


def main(*arguments: str) -> None:
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    what, *rest = arguments
    if what == "talk":
        talk(rest[0], int(rest[1]), float(rest[2]), float(rest[3]))
    elif what == "relay":
        relay(int(rest[0]))
    else:
        outcome = measure(int(what), int(rest[0]), float(rest[1]), float(rest[2]))
        print(outcome.cpu, outcome.lost, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
