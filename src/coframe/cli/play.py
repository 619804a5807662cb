"""``coframe play``: a recording said again on the graph."""

from __future__ import annotations

import contextlib
import sys
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.live import Live
from rich.text import Text

import coframe
from coframe.cli.help_format import PlainCommand
from coframe.cli.keys import keys
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    BagArgument,
    DomainOption,
    KeepOption,
    PrefixOption,
    TfStaticTopicOption,
    TfTopicOption,
)
from coframe.cli.output import fail, printable
from coframe.recorder import FASTEST
from coframe.recorder import play as start_playing
from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe.recorder import Player

__all__ = ["PlayCommand", "play"]

_REFRESH = 0.1  # seconds
_CLOCK_RATE = "40"  # Hz, as rosbag2's
_HELP = "space: pause, right: the next message, up and down: faster and slower, Ctrl-C: leave"


class PlayCommand(PlainCommand):
    """``--clock`` may stand alone, as rosbag2's does."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:  # noqa: D102 - see the class
        for i, argument in enumerate(args):
            if argument == "--clock" and not _is_number(args[i + 1 : i + 2]):
                args = [*args[: i + 1], _CLOCK_RATE, *args[i + 1 :]]
                break
        return super().parse_args(ctx, args)


def _is_number(following: list[str]) -> bool:
    try:
        return bool(following) and float(following[0]) is not None
    except ValueError:
        return False


def play(
    bag: BagArgument,
    topics: Annotated[list[str] | None, typer.Option("--topics", "-t", help="Only this one; may be repeated.")] = None,
    remap: Annotated[
        list[str] | None, typer.Option("--remap", "-m", metavar="OLD:=NEW", help="Another name; may be repeated.")
    ] = None,
    rate: Annotated[float, typer.Option("--rate", "-r", help="Seconds of the recording in a second.")] = 1.0,
    loop: Annotated[bool, typer.Option("--loop", "-l", help="Again and again.")] = False,
    start_offset: Annotated[
        str, typer.Option(help="How far from its beginning it starts: 10s, 2min, or seconds.")
    ] = "0s",
    start_paused: Annotated[bool, typer.Option("--start-paused", "-p", help="Stand still at first.")] = False,
    clock: Annotated[
        float | None,
        typer.Option(
            metavar="[HZ]", help="Tell /clock so often, 40 times if nothing is said.", show_default="as recorded"
        ),
    ] = None,
    delay: Annotated[str, typer.Option(help="How long to wait for subscribers at first.")] = "1s",
    domain: DomainOption = None,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
) -> None:
    """Say the recording BAG again on the graph, in its order and at its pace. Static transforms come first.

    In a terminal, space pauses, right says the next message, up and down change the rate. --prefix goes in front of the
    frames that any message names, sensors' too; --tf-topic is where what was recorded on /tf goes.

    Example: coframe play run --rate 2 --clock
    """
    with run_until_interrupted():
        try:
            player = start_playing(
                bag,
                topics=topics or None,
                remap={TF_TOPIC: tf_topic, TF_STATIC_TOPIC: tf_static_topic, **dict(map(_renaming, remap or []))},
                rate=rate,
                loop=loop,
                start_offset=f"{start_offset}s" if _is_number([start_offset]) else start_offset,
                paused=start_paused,
                clock=clock,
                delay=f"{delay}s" if _is_number([delay]) else delay,
                domain=domain,
                prefix=prefix,
                keep=keep,
            )
        except coframe.RecordingError:
            raise
        except ValueError as error:
            fail(str(error), code=2)
        with player:
            _watch(player)


def _renaming(text: str) -> tuple[str, str]:
    old, sign, new = text.partition(":=")
    if not (old and sign and new):
        fail(f"--remap: {text!r} is no renaming: write /tf:=/robot1/tf", code=2)
    return old, new


def _watch(player: Player) -> None:
    told: set[str] = set()
    console = Console(stderr=True)
    print(
        f"playing {player.recording.path}" + (f"; {_HELP}" if sys.stdin.isatty() else ""), file=sys.stderr, flush=True
    )

    def picture() -> Text:
        return _line(player)

    live = Live(get_renderable=picture, console=console, refresh_per_second=1 / _REFRESH, transient=True)
    with keys() as pressed, live if console.is_terminal else contextlib.nullcontext():
        while not player.wait(0.0):
            _obey(player, pressed.read(_REFRESH))
            for problem in [problem for problem in player.problems if problem not in told]:
                told.add(problem)
                print(f"coframe: {printable(problem)}", file=sys.stderr)
    print(f"played {player.played} messages")


def _obey(player: Player, key: str | None) -> None:
    if key == " ":
        player.resume() if player.clock.paused else player.pause()
    elif key == "right":
        player.step()
    elif key in {"up", "down"}:
        faster = player.clock.rate * (1.1 if key == "up" else 1 / 1.1)
        player.set_rate(min(max(faster, 0.01), FASTEST))


def _line(player: Player) -> Text:
    recording = player.recording
    passed, whole = (player.position - recording.start) / SECOND, recording.duration / SECOND
    state = "paused" if player.clock.paused else f"rate {player.clock.rate:.3g}"
    return Text(f"{passed:.1f} of {whole:.1f} s, {player.played} messages, {state}")
