"""What the commands share: plain sentences instead of tracebacks, clean ends, the options about topics."""

from __future__ import annotations

import contextlib
import signal
import sys
import time
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from coframe import frame_names
from coframe.errors import (
    DecodeError,
    FrozenFileError,
    RecordingError,
    RobotDescriptionError,
    TransformException,
    ViewerError,
    WireError,
)
from coframe.time import duration_ns

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

__all__ = [
    "TF_STATIC_TOPIC",
    "TF_TOPIC",
    "DomainOption",
    "KeepOption",
    "PrefixOption",
    "RecordedTfStaticTopicOption",
    "RecordedTfTopicOption",
    "TfStaticTopicOption",
    "TfTopicOption",
    "check_prefix",
    "fail",
    "length",
    "log",
    "node_errors",
    "printable",
    "qualified",
    "recorded_tf_topics",
    "session",
    "xacro_arguments",
]

DomainOption = Annotated[
    int | None, typer.Option(min=0, max=232, help="The ROS domain; by default ROS_DOMAIN_ID, or 0.", show_default=False)
]


TF_TOPIC, TF_STATIC_TOPIC = "/tf", "/tf_static"


def qualified(topic: str | None) -> str | None:
    """A topic's name with its slash."""
    return topic if topic is None or topic.startswith("/") else f"/{topic}"


TfTopicOption = Annotated[str, typer.Option(help="Where transforms are sent, such as /robot1/tf.", callback=qualified)]
TfStaticTopicOption = Annotated[str, typer.Option(help="Where static transforms are sent.", callback=qualified)]
RecordedTfTopicOption = Annotated[
    str | None,
    typer.Option(
        help="Where transforms are sent, such as /robot1/tf.",
        callback=qualified,
        show_default="/tf; in a recording all of them",
    ),
]
RecordedTfStaticTopicOption = Annotated[
    str | None,
    typer.Option(
        help="Where static transforms are sent.",
        callback=qualified,
        show_default="/tf_static; in a recording all of them",
    ),
]


def recorded_tf_topics(tf_topic: str | None, tf_static_topic: str | None) -> tuple[str, str] | None:
    """The topics whose transforms of a recording are read; None: all, as nobody has chosen."""
    if tf_topic is None and tf_static_topic is None:
        return None
    return tf_topic or TF_TOPIC, tf_static_topic or TF_STATIC_TOPIC


def check_prefix(prefix: str) -> str:
    """The prefix; a word where it has no slash at its end, and the command's end where it has one in front."""
    try:
        frame_names.renaming(prefix)
    except ValueError as error:
        fail(str(error), code=2)
    if advice := frame_names.prefix_advice(prefix):
        typer.echo(f"coframe: {printable(advice)}", err=True)
    return prefix


PrefixOption = Annotated[
    str,
    typer.Option(
        help="Goes in front of the names of frames as it is, with its own slash: robot1/.", callback=check_prefix
    ),
]
KeepOption = Annotated[str, typer.Option(help="Frames that are shared and get no prefix, such as map,world.")]


def fail(text: str, hint: str = "", *, code: int = 1) -> NoReturn:
    """Ends the command with one plain sentence and, below it, what to do."""
    typer.echo(f"coframe: {printable(text)}" + (f"\n  {printable(hint)}" if hint else ""), err=True)
    raise typer.Exit(code)


def length(option: str, text: str) -> int:
    """The duration that an option gives, in nanoseconds; one that is none, or 0, ends the command."""
    try:
        nanoseconds = duration_ns(text)
    except (ValueError, TypeError) as error:
        fail(f"{option}: {error}", code=2)
    if nanoseconds <= 0:
        fail(f"{option} must be more than 0", code=2)
    return nanoseconds


def printable(text: str) -> str:
    """Without what would steer a terminal: names from recordings and the wire may hold anything."""
    return "".join(c if c.isprintable() or c == "\n" else "\N{REPLACEMENT CHARACTER}" for c in text)


def log(level: str, node: str, text: str) -> None:
    """A line on stderr in the format of ROS."""
    now = time.time_ns()
    print(f"[{level}] [{now // 10**9}.{now % 10**9:09d}] [{node}]: {text}", file=sys.stderr, flush=True)


@contextlib.contextmanager
def session() -> Iterator[None]:
    """Ctrl-C, SIGTERM and a closed terminal end the block quietly; errors of ours become a sentence and exit code 1."""
    # Under nohup a closed terminal is to be ignored.
    ending = [number for number in _ENDING if signal.getsignal(number) is not signal.SIG_IGN]
    previous = {number: signal.signal(number, _interrupt) for number in ending}
    try:
        yield
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:  # the reader, `head` perhaps, has seen enough
        sys.stderr.close()
    except _OURS as error:
        fail(str(error), error.hint)
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)


@contextlib.contextmanager
def node_errors() -> Iterator[None]:
    """What is wrong with the part of the command line that is a node's becomes a sentence and exit code 2."""
    from rclpy.exceptions import NameValidationException, ParameterException, RCLError  # noqa: PLC0415 - few need it

    try:
        yield
    except (NameValidationException, ParameterException, RCLError) as error:
        fail(str(error), code=2)


def xacro_arguments(words: list[str]) -> dict[str, str]:
    """The arguments of a xacro file, NAME:=VALUE, of what the command itself did not know; the node's are left alone.

    Anything else, such as a misspelt option, ends the command.
    """
    from rclpy.utilities import remove_ros_args  # noqa: PLC0415 - few need it

    own = remove_ros_args(["coframe", *words])[1:]
    for word in own:
        if ":=" not in word or word.startswith("-"):
            fail(
                f"there is no option or argument {word!r}",
                "NAME:=VALUE is an argument of a xacro file; what follows --ros-args is the node's.",
                code=2,
            )
    return dict(word.split(":=", 1) for word in own)


_OURS = (
    DecodeError,
    FrozenFileError,
    RecordingError,
    RobotDescriptionError,
    TransformException,
    ViewerError,
    WireError,
)

# Windows has no SIGHUP.
_ENDING = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]


def _interrupt(_signal: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt
