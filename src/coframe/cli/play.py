# SPDX-License-Identifier: Apache-2.0
"""``coframe play``: replays a recording."""

from __future__ import annotations

import contextlib
import sys
from typing import TYPE_CHECKING, Any

import click
from rich.console import Console
from rich.live import Live
from rich.text import Text

from coframe._output.formatting import count
from coframe._process.keys import keys
from coframe.bags.formats import file_kinds
from coframe.cli.completion import complete_recordings
from coframe.cli.declaration import RECORDING, argument
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    Duration,
    bag_argument,
    domain_option,
    listener_options,
)
from coframe.cli.output import fail, warn
from coframe.cli.rosbag2_words import PLAY_WORDS, Rosbag2Command, remove_formats
from coframe.errors import RecordingError
from coframe.recorder import MAX_RATE
from coframe.recorder import play as start_playing
from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe._sources.sources import Readable
    from coframe.recorder import Player

__all__ = ["burst", "play"]

_REFRESH = 0.1  # seconds
_REFRESH_TIME = f"{_REFRESH:g}s"
_CLOCK_RATE = "40"  # Hz, as in rosbag2
_HELP = "space: pause, right: next message, up/down: faster/slower, Ctrl-C: stop"


class PlayCommand(Rosbag2Command):
    """The command ``play`` with the options of ``ros2 bag play``; ``--clock`` may have no value, as there."""

    rosbag2 = PLAY_WORDS

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Insert the default rate after ``--clock`` without a value, then parse as usual."""
        for i, word in enumerate(args):
            if word == "--clock" and not _is_number(args[i + 1 : i + 2]):
                args = [*args[: i + 1], _CLOCK_RATE, *args[i + 1 :]]
                break
        return super().parse_args(ctx, remove_formats(args))


def _is_number(following: list[str]) -> bool:
    try:
        return bool(following) and float(following[0]) is not None
    except ValueError:
        return False


_start_offset_option = click.option(
    "--start-offset",
    metavar="DURATION",
    type=Duration,
    default="0s",
    help="Start this far into the recording, e.g. 10s or 2min.",
)
_delay_option = click.option(
    "--delay",
    metavar="DURATION",
    type=Duration,
    default="1s",
    help="Time to wait for subscribers before playback starts.",
)


@click.command(cls=PlayCommand)
@argument(
    "bag",
    metavar="[BAG]",
    type=RECORDING,
    required=False,
    shell_complete=complete_recordings,
    help=lambda: f"Recording: a {file_kinds()}, or a rosbag2 folder.",
)
@click.option(
    "--input",
    "-i",
    "inputs",
    metavar="BAG",
    type=RECORDING,
    multiple=True,
    help="Recording to replay together with others; repeatable.",
)
@click.option("--topics", metavar="TOPIC", multiple=True, help="Replay only this topic; repeatable.")
@click.option("--regex", "-e", metavar="REGEX", help="Replay topics whose full name matches this expression.")
@click.option(
    "--exclude", metavar="REGEX", help="Do not replay topics whose full name matches this regular expression."
)
@click.option("--exclude-topics", metavar="TOPIC", multiple=True, help="Do not replay this topic; repeatable.")
@click.option("--remap", "-m", metavar="OLD:=NEW", multiple=True, help="Publish the topic OLD as NEW; repeatable.")
@click.option("--rate", "-r", metavar="FACTOR", type=float, default=1.0, help="Playback speed; 2 is twice as fast.")
@click.option("--loop", is_flag=True, help="Restart at the end.")
@click.option("-l", "upstream_loop", is_flag=True, hidden=True)
@_start_offset_option
@click.option(
    "--playback-duration",
    metavar="DURATION",
    type=Duration,
    default="-1s",
    show_default=False,
    help="Stop after this much of the recording. [default: at its end]",
)
@click.option(
    "--playback-until-sec", metavar="TIME", type=float, help="Stop at this receive time, in seconds since 1970."
)
@click.option("--playback-until-nsec", metavar="NANOSECONDS", type=int, hidden=True)
@click.option("--disable-keyboard-controls", "no_keys", is_flag=True, help="Do not read keys from the terminal.")
@click.option("--start-paused", is_flag=True, help="Start paused.")
@click.option("-p", "upstream_paused", is_flag=True, hidden=True)
@click.option(
    "--clock",
    metavar="[HZ]",
    type=float,
    help="Publish /clock at this rate, or at 40 Hz without a value. [default: replay /clock as recorded]",
)
@_delay_option
@domain_option
@listener_options
def play(
    bag: Readable | None,
    inputs: tuple[Readable, ...],
    topics: tuple[str, ...],
    regex: str | None,
    exclude: str | None,
    exclude_topics: tuple[str, ...],
    remap: tuple[str, ...],
    rate: float,
    loop: bool,
    upstream_loop: bool,
    start_offset: Duration,
    playback_duration: Duration,
    playback_until_sec: float | None,
    playback_until_nsec: int | None,
    no_keys: bool,
    start_paused: bool,
    upstream_paused: bool,
    clock: float | None,
    delay: Duration,
    domain: int | None,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
) -> None:
    """Replay the recording BAG: publish its messages in order and at their original rate, static transforms first.

    In a terminal, the space bar pauses, the right arrow key publishes the next message, and the up and down arrow keys
    change the speed. --prefix applies to the frame names in all messages. Messages recorded on /tf are published on
    --tf-topic.

    Example: coframe play run --rate 2 --clock
    """
    bags = [*([] if bag is None else [bag]), *inputs]
    if not bags:
        fail("Missing argument BAG.", "Example: coframe play run", code=2)
    if playback_until_sec is not None and playback_until_sec >= 0:
        playback_until_nsec = int(playback_until_sec * SECOND)
    with run_until_interrupted():
        try:
            player = start_playing(
                bags,
                topics=topics or None,
                regex=regex,
                exclude=exclude,
                exclude_topics=exclude_topics,
                remap={
                    TF_TOPIC: tf_topic,
                    TF_STATIC_TOPIC: tf_static_topic,
                    **dict(map(_parse_remapping, remap)),
                },
                rate=rate,
                # The short options of `ros2 bag play` are accepted here; in other commands they have other meanings.
                loop=loop or upstream_loop,
                start_offset=start_offset,
                # A negative limit means none, as in rosbag2.
                duration=playback_duration if playback_duration >= 0 else None,
                end=playback_until_nsec if (playback_until_nsec or 0) > 0 else None,
                paused=start_paused or upstream_paused,
                clock=clock,
                delay=delay,
                domain=domain,
                prefix=prefix,
                keep=keep,
            )
        except RecordingError:
            raise
        except ValueError as error:
            fail(str(error), code=2)
        with player:
            _watch(player, reads_keys=not no_keys)


@click.command(cls=PlayCommand, short_help="Publish messages of a recording without pauses.")
@bag_argument
@click.option(
    "--num-messages", "-n", metavar="N", type=click.IntRange(min=0), default=0, help="Number of messages; 0 for all."
)
@click.option("--topics", metavar="TOPIC", multiple=True, help="Publish only this topic; repeatable.")
@click.option("--remap", "-m", metavar="OLD:=NEW", multiple=True, help="Publish the topic OLD as NEW; repeatable.")
@_start_offset_option
@_delay_option
@domain_option
def burst(
    bag: Readable,
    num_messages: int,
    topics: tuple[str, ...],
    remap: tuple[str, ...],
    start_offset: Duration,
    delay: Duration,
    domain: int | None,
) -> None:
    """Publish the first messages of the recording BAG without pauses, static transforms first.

    Example: coframe bag burst run --num-messages 100
    """
    with run_until_interrupted():
        try:
            player = start_playing(
                bag,
                topics=topics or None,
                remap=dict(map(_parse_remapping, remap)),
                start_offset=start_offset,
                paused=True,
                delay=delay,
                domain=domain,
            )
        except RecordingError:
            raise
        except ValueError as error:
            fail(str(error), code=2)
        with player:
            player.step(num_messages or sum(topic.messages for topic in player.recording.topics.values()))
            while player.clock.steps and not player.wait(_REFRESH_TIME):
                pass
        print(f"published {count(player.played, 'message')}")


def _parse_remapping(text: str) -> tuple[str, str]:
    old, sign, new = text.partition(":=")
    if not (old and sign and new):
        fail(f"--remap: {text!r} is not of the form OLD:=NEW, for example /tf:=/robot1/tf.", code=2)
    return old, new


def _watch(player: Player, *, reads_keys: bool) -> None:
    printed_problems: set[str] = set()
    console = Console(stderr=True)
    print(
        f"playing {player.recording.path}" + (f"; {_HELP}" if reads_keys and sys.stdin.isatty() else ""),
        file=sys.stderr,
        flush=True,
    )

    def screen() -> Text:
        return _line(player)

    live = Live(get_renderable=screen, console=console, refresh_per_second=1 / _REFRESH, transient=True)
    with (
        keys() if reads_keys else contextlib.nullcontext() as pressed,
        live if console.is_terminal else contextlib.nullcontext(),
    ):
        while not player.wait(0 if pressed else _REFRESH_TIME):
            if pressed:
                _handle_key(player, pressed.read(_REFRESH))
            for problem in [problem for problem in player.problems if problem not in printed_problems]:
                printed_problems.add(problem)
                warn(problem)
    print(f"played {count(player.played, 'message')}")


def _handle_key(player: Player, key: str | None) -> None:
    if key == " ":
        player.resume() if player.clock.paused else player.pause()
    elif key == "right":
        player.step()
    elif key in {"up", "down"}:
        faster = player.clock.rate * (1.1 if key == "up" else 1 / 1.1)
        player.set_rate(min(max(faster, 0.01), MAX_RATE))


def _line(player: Player) -> Text:
    recording = player.recording
    elapsed, duration = (player.position - recording.received_start) / SECOND, recording.duration / SECOND
    state = "paused" if player.clock.paused else f"rate {player.clock.rate:.3g}"
    return Text(f"{elapsed:.1f} of {duration:.1f} s, {count(player.played, 'message')}, {state}")
