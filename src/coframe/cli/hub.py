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
from coframe.shared_transforms import SharedTransforms, Source
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
) -> None:
    """Receive the transforms once for all programs that share them, until Ctrl-C.

    Programs share transforms with coframe.connect(shared=True), or with COFRAME_SHARED=1 for tf2_ros. Without this
    command, the first of them receives the transforms for the others.

    Example: coframe hub --domain 5
    """
    with run_until_interrupted():
        joined = domain_id() if domain is None else domain
        shared_frames = tuple(sorted(kept(keep)))
        source = Source(joined, tf_topic, tf_static_topic, int(cache), prefix, shared_frames)
        try:
            shared = SharedTransforms.join(source)
        except _core.SegmentError as error:
            fail(str(error), "Use coframe.connect() without shared=True.")
        try:
            _report(shared, source)
        finally:
            shared.leave()


def _report(shared: SharedTransforms, source: Source) -> None:
    buffer = coframe.Buffer(source.cache)
    shared.follow(buffer)
    topics = f"{source.tf_topic} and {source.tf_static_topic} in domain {source.domain}"
    if not shared.writes:
        log("INFO", NODE, f"Process {shared.writer_process} receives {topics}. This one takes over when it ends.")
    frames = -1
    received = False
    pause = threading.Event()
    while True:
        if shared.writes and not received:
            received = True
            log("INFO", NODE, f"Receiving {topics} for all programs that share transforms. Ctrl-C stops.")
        if len(buffer.frame_names()) != frames:
            frames = len(buffer.frame_names())
            log("INFO", NODE, f"{frames} frames in {shared.used / 1e6:.1f} MB of shared memory")
        pause.wait(REFRESH)
