# SPDX-License-Identifier: Apache-2.0
"""``coframe hub``: receives the transforms for all programs of this user on this machine."""

from __future__ import annotations

import threading
from typing import Annotated

import typer

import coframe
from coframe import _core
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.options import (
    TF_STATIC_TOPIC,
    TF_TOPIC,
    DomainOption,
    KeepOption,
    PositiveDuration,
    PrefixOption,
    TfStaticTopicOption,
    TfTopicOption,
)
from coframe.cli.output import fail, log
from coframe.frame_names import kept
from coframe.shared_transforms import GENERATIONS, SharedTransforms, Source, full, is_suspended, suspension
from coframe.wire.domains import domain_id

__all__ = ["hub"]

NODE = "coframe_hub"
REFRESH = 1.0  # seconds
_TEN_SECONDS = PositiveDuration("10s")


def hub(
    cache: Annotated[
        PositiveDuration,
        typer.Option(
            metavar="DURATION", parser=PositiveDuration, help="How long dynamic transforms are kept, e.g. 30s."
        ),
    ] = _TEN_SECONDS,
    tf_topic: TfTopicOption = TF_TOPIC,
    tf_static_topic: TfStaticTopicOption = TF_STATIC_TOPIC,
    prefix: PrefixOption = "",
    keep: KeepOption = "",
    domain: DomainOption = None,
    status: Annotated[
        bool, typer.Option("--status", help="Print which process receives the transforms, and exit.")
    ] = False,
) -> None:
    """Receive the transforms once for all programs that share them, until Ctrl-C.

    Programs share transforms with coframe.connect(shared=True), or with COFRAME_SHARED=1 for tf2_ros. Without this
    command, the first of them receives the transforms for the others.

    Example: coframe hub --domain 5
    """
    joined = domain_id() if domain is None else domain
    source = Source(joined, tf_topic, tf_static_topic, int(cache), prefix, tuple(sorted(kept(keep))))
    with run_until_interrupted():
        try:
            if status:
                _print_status(source)
            else:
                _receive(source)
        except _core.SegmentError as error:
            fail(str(error), "Use coframe.connect() without shared=True.")


def _topics(source: Source) -> str:
    return f"{source.tf_topic} and {source.tf_static_topic} in domain {source.domain}"


def _print_status(source: Source) -> None:
    """Print which process receives the transforms. Exit with 1 if there is none, or if it is suspended."""
    segment = source.open()
    try:
        if segment.try_to_write():
            print(f"No process receives {_topics(source)} for others.")
            raise typer.Exit(1)
        buffer = coframe.Buffer(source.cache)
        segment.follow(buffer)
        process = segment.writer_process
        size = f"{len(buffer.frame_names())} frames in {segment.used / 1e6:.1f} MB of shared memory"
        print(f"Process {process} receives {_topics(source)} for all programs that share transforms: {size}.")
        if shortage := segment.shortage:
            print(full(shortage))
        if segment.outdated:
            print("Static transforms were withdrawn: programs that start now share another memory, without them.")
        if is_suspended(process):
            print(suspension(process))
            raise typer.Exit(1)
    finally:
        segment.close()


def _receive(source: Source) -> None:
    generations = [SharedTransforms.join(source)]
    try:
        _report(source, generations)
    finally:
        for shared in generations:
            shared.leave()


def _report(source: Source, generations: list[SharedTransforms]) -> None:
    """Log what happens. Programs that start after a static transform was withdrawn share a further generation."""
    if not generations[0].writes:
        process = generations[0].writer_process
        log("INFO", NODE, f"Process {process} receives {_topics(source)}. This one takes over when it ends.")
    frames = -1
    received = False
    pause = threading.Event()
    buffer = _follow(source, generations[0])
    while True:
        if generations[-1].writes and not received:
            received = True
            log("INFO", NODE, f"Receiving {_topics(source)} for all programs that share transforms. Ctrl-C stops.")
        if len(buffer.frame_names()) != frames:
            frames = len(buffer.frame_names())
            log("INFO", NODE, f"{frames} frames in {generations[-1].used / 1e6:.1f} MB of shared memory")
        pause.wait(REFRESH)
        if generations[-1].outdated and len(generations) < GENERATIONS:
            generations.append(SharedTransforms.join(source))
            buffer = _follow(source, generations[-1])
            log("INFO", NODE, "Static transforms were withdrawn. Programs that start now share another memory.")


def _follow(source: Source, shared: SharedTransforms) -> coframe.Buffer:
    buffer = coframe.Buffer(source.cache)
    shared.follow(buffer)
    return buffer
