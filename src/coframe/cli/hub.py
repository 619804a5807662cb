# SPDX-License-Identifier: Apache-2.0
"""``coframe hub``: receives the transforms for all programs of this user on this machine."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe import _core
from coframe.cli.declaration import Command
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    PositiveDuration,
    domain_option,
    listener_options,
)
from coframe.cli.output import fail, log
from coframe.connection.listener_config import ListenerConfig
from coframe.connection.shared_transforms import (
    GENERATIONS,
    SharedTransforms,
    full_memory_warning,
    is_suspended,
    open_segment,
    suspension_warning,
)

if TYPE_CHECKING:
    from coframe.buffer.buffer import Buffer

__all__ = ["hub"]

NODE = "coframe_hub"
REFRESH = 1.0  # seconds


@click.command(cls=Command)
@click.option(
    "--cache",
    metavar="DURATION",
    type=PositiveDuration,
    default="10s",
    help="Cache length: how long dynamic transforms are kept, e.g. 30s.",
)
@listener_options
@domain_option
@click.option("--status", is_flag=True, help="Print which process receives the transforms and exit.")
def hub(
    cache: PositiveDuration,
    tf_topic: str,
    tf_static_topic: str,
    prefix: str,
    keep: str,
    domain: int | None,
    status: bool,
) -> None:
    """Receive transforms once for all programs that share them, until Ctrl-C.

    Programs share transforms with coframe.connect(shared=True), or with COFRAME_SHARED=1 for tf2_ros. Without this
    command, the first program receives the transforms for the others.

    Example: coframe hub --domain 5
    """
    with run_until_interrupted():
        config = ListenerConfig.of(
            domain=domain,
            tf_topic=tf_topic,
            tf_static_topic=tf_static_topic,
            prefix=prefix,
            keep=keep,
            cache=cache,
        )
        try:
            if status:
                _print_status(config)
            else:
                _receive(config)
        except _core.SegmentError as error:
            fail(str(error), "Use coframe.connect() without shared=True.")


def _topics(config: ListenerConfig) -> str:
    return f"{config.tf_topic} and {config.tf_static_topic} in domain {config.domain}"


def _print_status(config: ListenerConfig) -> None:
    """Print which process receives the transforms. Exit with code 1 if there is none, or if it is suspended."""
    segment = open_segment(config)
    try:
        if segment.try_to_write():
            print(f"No process receives {_topics(config)} for others.")
            raise Exit(1)
        buffer = config.new_buffer()
        segment.follow(buffer)
        process = segment.writer_process
        size = f"{len(buffer.frame_names())} frames in {segment.used / 1e6:.1f} MB of shared memory"
        print(f"Process {process} receives {_topics(config)} for all programs that share transforms: {size}.")
        if shortage := segment.shortage:
            print(full_memory_warning(shortage))
        if segment.outdated:
            print(
                "Static transforms were withdrawn: programs that start now use a separate shared memory without them."
            )
        if is_suspended(process):
            print(suspension_warning(process))
            raise Exit(1)
    finally:
        segment.close()


def _receive(config: ListenerConfig) -> None:
    generations = [SharedTransforms.join(config)]
    try:
        _report(config, generations)
    finally:
        for shared in generations:
            shared.leave()


def _report(config: ListenerConfig, generations: list[SharedTransforms]) -> None:
    """Log changes. Programs that start after a static transform was withdrawn use a new generation."""
    if not generations[0].is_writer:
        process = generations[0].writer_process
        log("INFO", NODE, f"Process {process} receives {_topics(config)}. This one takes over when it ends.")
    frames = -1
    received = False
    pause = threading.Event()
    buffer = _follow(config, generations[0])
    while True:
        if generations[-1].is_writer and not received:
            received = True
            log("INFO", NODE, f"Receiving {_topics(config)} for all programs that share transforms. Ctrl-C stops.")
        if len(buffer.frame_names()) != frames:
            frames = len(buffer.frame_names())
            log("INFO", NODE, f"{frames} frames in {generations[-1].used / 1e6:.1f} MB of shared memory")
        pause.wait(REFRESH)
        if generations[-1].is_outdated and len(generations) < GENERATIONS:
            generations.append(SharedTransforms.join(config))
            buffer = _follow(config, generations[-1])
            log("INFO", NODE, "Static transforms were withdrawn. Programs that start now use a separate shared memory.")


def _follow(config: ListenerConfig, shared: SharedTransforms) -> Buffer:
    buffer = config.new_buffer()
    shared.follow(buffer)
    return buffer
