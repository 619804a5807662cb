# SPDX-License-Identifier: Apache-2.0
"""Exit codes and messages of commands on Ctrl-C, SIGTERM, a closed pipe, and library errors."""

from __future__ import annotations

import contextlib
import gc
import signal
import sys
import warnings
from typing import TYPE_CHECKING, Any

from click.exceptions import Exit

from coframe._base_error import CoframeError, CoframeWarning
from coframe._process.signal_handlers import SIGINT_EXIT_CODE, SignalHandlers
from coframe.cli.output import fail, for_command_line, warn

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

__all__ = ["run_to_completion", "run_until_interrupted"]

# Windows has no SIGHUP.
_END_SIGNALS = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]


@contextlib.contextmanager
def run_until_interrupted() -> Iterator[None]:
    """Exit the block silently on Ctrl-C, SIGTERM and SIGHUP; report library errors with exit code 1."""
    # nohup ignores SIGHUP, which must stay ignored.
    handled = [number for number in _END_SIGNALS if signal.getsignal(number) is not signal.SIG_IGN]
    handlers = SignalHandlers()
    for number in handled:
        handlers.install(number, _interrupt)
    try:
        yield
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:  # The reader of a pipe, such as `head`, closed it.
        sys.stderr.close()
    except CoframeError as error:
        # For a loop, tf2's message lists all frames, one per line.
        fail(str(error).partition("\nFrame ")[0], error.hint)
    finally:
        handlers.restore()


@contextlib.contextmanager
def run_to_completion() -> Iterator[None]:
    """Like :func:`run_until_interrupted`, but end with exit code 130 on Ctrl-C, because the work is not finished.

    Warnings of the library are printed like those of the command.
    """
    with run_until_interrupted(), _printed_warnings():
        try:
            yield
        except KeyboardInterrupt:
            # At exit, Python runs several garbage collections, which take a second with millions of objects.
            gc.freeze()
            raise Exit(SIGINT_EXIT_CODE) from None


@contextlib.contextmanager
def _printed_warnings() -> Iterator[None]:
    """Print each distinct library warning once, without the source line that Python adds."""
    printed_texts: set[str] = set()
    show = warnings.showwarning

    def print_once(message: Warning | str, category: type[Warning], *place: Any, **line: Any) -> None:
        if not issubclass(category, CoframeWarning):
            show(message, category, *place, **line)
        elif str(message) not in printed_texts:
            printed_texts.add(str(message))
            warn(for_command_line(str(message)))

    with warnings.catch_warnings():
        warnings.simplefilter("always", CoframeWarning)
        warnings.showwarning = print_once
        yield


def _interrupt(_signal: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt
