# SPDX-License-Identifier: Apache-2.0
"""What `coframe relay --max-error` saves, and what it costs: recorded transforms pass a relay.

For each recording and setting, it prints how many bytes of TFMessages are received and sent, the worst error of 10 000
random lookups across one edge and across any chain, compared with lookups in all recorded transforms, and the size of
the compressed messages for comparison:

    python -m benchmarks.thinning ../shared/recordings
    python -m benchmarks.thinning run.mcap --setting 10 1mm,0.1deg --setting 2 5mm,0.5deg
"""

import argparse
import itertools
import zlib
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np

import coframe
from coframe import _core
from coframe.messages import codec, find
from coframe.tf_relay import MaxError
from coframe.time import SECOND

LOOKUPS = 10_000
SETTINGS = ((10.0, "1mm,0.1deg"), (5.0, "5mm,0.5deg"), (2.0, "5mm,0.5deg"))


class Message(NamedTuple):
    """A TFMessage as CDR with the time of its receipt in nanoseconds."""

    received: int
    data: bytes


class Error(NamedTuple):
    """The worst errors of lookups in meters and radians."""

    distance: float
    angle: float


class Outcome(NamedTuple):
    """What a relay sent of a recording.

    Attributes:
        sent: The messages.
        edges: The worst error of lookups across one dynamic edge.
        chains: The worst error of lookups between any two connected frames.
    """

    sent: list[Message]
    edges: Error
    chains: Error


def recorded(path: Path) -> tuple[list[Message], list[Message]]:
    """Return the dynamic and the static transforms of a recording as TFMessages, in the order of their receipt."""
    tf_message = find("tf2_msgs/msg/TFMessage")
    bag = coframe.open_bag(path)

    def messages(topics: Iterable[str]) -> list[Message]:
        found = [message for topic in topics if topic in bag.topics for message in bag.messages(topic)]
        found.sort(key=lambda message: message.received)
        return [
            Message(message.received, codec.serialize(tf_message(transforms=list(message.message.transforms))))
            for message in found
        ]

    return messages(["/tf"]), messages(["/tf_static"])


def relayed(messages: list[Message], rate: float, most: MaxError | None) -> list[Message]:
    """Return what a relay sends; the relay is called at the times of the recording."""
    native = _core.Relay(False, round(SECOND / rate), most)
    native.add_source(_core.Renaming("", []), False)
    sent = []

    def take(at: int) -> None:
        if (data := native.take(at)) is not None:
            sent.append(Message(at, data))

    for message in messages:
        while (due := native.next_due()) is not None and due < message.received:
            take(due)
        native.add(0, 1, message.data, message.received)
        take(message.received)
    while (due := native.next_due()) is not None:
        take(due)
    return sent


def size(messages: Iterable[Message]) -> int:
    return sum(len(message.data) for message in messages)


def buffer_of(dynamic: list[Message], static: list[Message]) -> coframe.Buffer:
    buffer = coframe.Buffer(None)
    for is_static, messages in ((False, dynamic), (True, static)):
        for message in messages:
            buffer.ingest(message.data, static=is_static)
    return buffer


def error(original: coframe.Buffer, thinned: coframe.Buffer, pairs: list[tuple[str, str]], seed: int) -> Error:
    """Return the worst error of random lookups between these frames at random times."""
    random = np.random.default_rng(seed)
    worst = Error(0.0, 0.0)
    for target, source in pairs:
        stamps = random.integers(*thinned.span(target, source), LOOKUPS // len(pairs) + 1, endpoint=True)
        expected, found = (buffer.lookup_many(target, source, stamps) for buffer in (original, thinned))
        difference = expected.inverse() @ found
        chord = np.linalg.norm(difference.quaternion[:, :3], axis=1)
        worst = Error(
            max(worst.distance, float(np.linalg.norm(expected.translation - found.translation, axis=1).max())),
            max(worst.angle, float((2 * np.arcsin(np.minimum(chord, 1.0))).max())),
        )
    return worst


def has_common_time(buffer: coframe.Buffer, target: str, source: str) -> bool:
    try:
        return buffer.span(target, source) != (0, 0)
    except coframe.TransformException:
        return False


def measure(dynamic: list[Message], static: list[Message], rate: float, most: MaxError, seed: int = 20) -> Outcome:
    """Return what a relay sends of these messages."""
    sent = relayed(dynamic, rate, most)
    original, thinned = buffer_of(dynamic, static), buffer_of(sent, static)
    edges = [(edge.parent, edge.child) for edge in original.edges() if not edge.static]
    frames = sorted(original.frame_names())
    chains = [pair for pair in itertools.permutations(frames, 2) if has_common_time(original, *pair)]
    return Outcome(sent, error(original, thinned, edges, seed), error(original, thinned, chains, seed))


def report(path: Path, settings: Iterable[tuple[float, str]]) -> None:
    """Print the lines of one recording."""
    dynamic, static = recorded(path)
    if not dynamic:
        return
    seconds = (dynamic[-1].received - dynamic[0].received) / SECOND
    plain = size(dynamic)
    packed = sum(len(zlib.compress(message.data)) for message in dynamic)
    print(f"{path.name}: {len(dynamic)} messages, {plain / seconds:.0f} B/s, {packed / plain:.0%} of it with zlib")
    for rate, text in settings:
        outcome = measure(dynamic, static, rate, MaxError.of(text))
        share = size(outcome.sent) / plain
        errors = ", ".join(
            f"{name} {1e3 * worst.distance:.2f} mm {np.degrees(worst.angle):.3f} deg"
            for name, worst in (("edges", outcome.edges), ("chains", outcome.chains))
        )
        print(
            f"  --rate {rate:g} --max-error {text}: {len(outcome.sent)} messages, "
            f"{size(outcome.sent) / seconds:.0f} B/s, 1/{1 / share:.1f}; worst error: {errors}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording", type=Path, nargs="+", help="a recording, or a folder of recordings")
    parser.add_argument("--setting", nargs=2, action="append", metavar=("RATE", "MAX_ERROR"))
    arguments = parser.parse_args()
    settings = [(float(rate), text) for rate, text in arguments.setting or SETTINGS]
    for path in arguments.recording:
        is_recording = path.is_file() or (path / "metadata.yaml").exists()
        for each in [path] if is_recording else sorted(path.iterdir()):
            if each.suffix == ".bag" or (each / "metadata.yaml").exists():
                report(each, settings)


if __name__ == "__main__":
    main()
