"""What the commands share: plain sentences instead of tracebacks, clean ends, the options about topics."""

from __future__ import annotations

import contextlib
import signal
import sys
import time
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from coframe.errors import DecodeError, TransformException, WireError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

__all__ = ["DomainOption", "TfStaticTopicOption", "TfTopicOption", "fail", "log", "session"]

DomainOption = Annotated[
    int | None, typer.Option(min=0, max=232, help="The ROS domain; by default ROS_DOMAIN_ID, or 0.", show_default=False)
]
TfTopicOption = Annotated[str, typer.Option(help="Where transforms are sent, such as /robot1/tf.")]
TfStaticTopicOption = Annotated[str, typer.Option(help="Where static transforms are sent.")]


def fail(text: str, hint: str = "", *, code: int = 1) -> NoReturn:
    """Ends the command with one plain sentence and, below it, what to do."""
    typer.echo(f"coframe: {text}" + (f"\n  {hint}" if hint else ""), err=True)
    raise typer.Exit(code)


def log(level: str, node: str, text: str) -> None:
    """A line on stderr in the format of ROS."""
    now = time.time_ns()
    print(f"[{level}] [{now // 10**9}.{now % 10**9:09d}] [{node}]: {text}", file=sys.stderr, flush=True)


@contextlib.contextmanager
def session() -> Iterator[None]:
    """Ctrl-C and SIGTERM end the block quietly; errors of ours become a sentence and exit code 1."""
    previous = signal.signal(signal.SIGTERM, _interrupt)
    try:
        yield
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:  # the reader, `head` perhaps, has seen enough
        sys.stderr.close()
    except (WireError, TransformException, DecodeError) as error:
        fail(str(error), error.hint)
    finally:
        signal.signal(signal.SIGTERM, previous)


def _interrupt(_signal: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt
