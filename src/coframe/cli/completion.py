# SPDX-License-Identifier: Apache-2.0
"""Shell completion of recordings, frames and topics, installed by ``coframe --install-completion``.

A completion never prints errors, because the user is still typing; it returns no names instead.
"""

from __future__ import annotations

import functools
import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from coframe.bags.formats import is_recording
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Callable

    import click
    from click.shell_completion import CompletionItem

__all__ = [
    "complete_frames",
    "complete_live_frames",
    "complete_live_topics",
    "complete_recordings",
    "complete_tf_topics",
]

_NamesT = TypeVar("_NamesT")
_DISCOVERY = 0.6  # seconds: the longest discovery of topics or frames
_SETTLE_TIME = 0.2  # seconds without a new name, after which the known names are complete
_MAX_BYTES = 200 << 20  # bytes; reading more would take longer than typing the name


def _without_errors(complete: Callable[..., _NamesT]) -> Callable[..., _NamesT | list[str]]:
    """Wrap a completion so that it returns no names on failure and writes nothing to stderr."""

    @functools.wraps(complete)
    def run(*args: Any, **kwargs: Any) -> _NamesT | list[str]:
        stderr, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 2)  # The DDS library also writes to it.
        try:
            return complete(*args, **kwargs)
        except (Exception, SystemExit):  # noqa: BLE001 - whatever happens, the user is still typing
            return []
        finally:
            os.dup2(stderr, 2)
            os.close(stderr)
            os.close(nowhere)

    return run


@_without_errors
def complete_recordings(
    _ctx: click.Context, _parameter: click.Parameter, incomplete: str
) -> list[str] | list[CompletionItem]:
    """Return the recordings whose paths begin with a text. If there are none, the shell completes the path."""
    from click.shell_completion import CompletionItem  # noqa: PLC0415 - only for completion

    return _recordings(incomplete) or [CompletionItem(incomplete, type="file")]


def _recordings(start_of_path: str) -> list[str]:
    folder, _, start = start_of_path.rpartition("/")
    inside = Path(f"{folder}/" if "/" in start_of_path else ".")
    prefix = f"{folder}/" if "/" in start_of_path else ""
    entries = sorted(entry for entry in inside.iterdir() if entry.name.startswith(start) and _is_visible(entry, start))
    return [f"{prefix}{entry.name}" for entry in entries if is_recording(entry)]


def _is_visible(entry: Path, start: str) -> bool:
    return start.startswith(".") or not entry.name.startswith(".")


@_without_errors
def complete_frames(ctx: click.Context, parameter: click.Parameter, incomplete: str) -> list[str]:
    """Return matching frames of the recording in the first argument, otherwise those on the ROS graph.

    The first argument may itself be a recording, in which case matching recordings are returned.
    """
    bag, names = ctx.params.get("bag"), ctx.params.get("names") or []
    if not bag and not names:
        return _recordings(incomplete) or complete_live_frames(ctx, parameter, incomplete)
    path = Path(bag or names[0])
    if not path.exists():
        return [] if bag else complete_live_frames(ctx, parameter, incomplete)
    files = path.iterdir() if path.is_dir() else [path]
    if sum(file.stat().st_size for file in files if file.is_file()) > _MAX_BYTES:
        return []
    from coframe.bags import open_bag  # noqa: PLC0415 - only if there is a recording

    with open_bag(path) as recording:
        names = {name for buffer in recording.buffers.values() for name in buffer.frame_names()}
    return sorted(name for name in names if name.startswith(incomplete))


@_without_errors
def complete_live_frames(ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """Return the frames of the ROS graph that begin with a text."""
    from coframe.connection.connection import connect  # noqa: PLC0415 - only for this completion

    options = {name: ctx.params[name] for name in ("domain", "tf_topic", "tf_static_topic") if ctx.params.get(name)}
    with connect("completion", **options) as connection:
        names = _wait_until_settled(connection.buffer.frame_names)
    return sorted(name for name in names if name.startswith(incomplete))


@_without_errors
def complete_live_topics(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """Return the topics of the ROS graph that begin with a text."""
    from coframe.cli.ros2.hidden_names import is_hidden  # noqa: PLC0415 - only for this completion

    return sorted(name for name in _live_topics(None) if name.startswith(incomplete) and not is_hidden(name))


@_without_errors
def complete_tf_topics(ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """Return the topics of transforms on the ROS graph that begin with a text."""
    topics = _live_topics(ctx.params.get("domain"))
    return sorted(name for name, types in topics.items() if TF_MESSAGE in types and name.startswith(incomplete))


def _live_topics(domain: int | None) -> dict[str, list[str]]:
    """Return the types of the topics of the ROS graph."""
    from coframe.wire.participant import Participant  # noqa: PLC0415 - only for this completion

    participant = Participant.get(domain)
    try:
        return _wait_until_settled(participant.topics)
    finally:
        participant.close()


def _wait_until_settled(observe: Callable[[], _NamesT]) -> _NamesT:
    """Return the state of the ROS graph once it no longer changes, or after a timeout."""
    begin = changed = time.monotonic()
    names = observe()
    while (now := time.monotonic()) - begin < _DISCOVERY and not (names and now - changed > _SETTLE_TIME):
        time.sleep(0.02)
        if (found := observe()) != names:
            names, changed = found, time.monotonic()
    return names
