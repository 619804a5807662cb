# SPDX-License-Identifier: Apache-2.0
"""Lookups of transforms that processes share."""

import sys
import tempfile
from collections.abc import Generator
from pathlib import Path

import coframe
from benchmarks import ours
from benchmarks.measuring import Contender, GrowsAtMost, MissingPeerError, Row
from benchmarks.motion import frame
from benchmarks.rows.single import AT_A_TIME, NEWEST, TIME
from benchmarks.statement import Statement
from coframe import _core

MAX_RATIO = 1.3
DEPTH = 5


def contenders(code: str) -> Generator[Contender]:
    """Yield lookups in a buffer that reads shared memory, and in a buffer of the process with the same transforms."""
    if not sys.platform.startswith("linux"):
        raise MissingPeerError("shared transforms exist on Linux only")
    names = {"source": frame(DEPTH), "time": TIME}
    own = ours.filled(DEPTH)
    with tempfile.TemporaryDirectory() as folder:
        segment = _core.Segment.open(str(Path(folder) / "shared"), "bench", -1)
        try:
            assert segment.try_to_write()
            writer, reader = coframe.Buffer(None), coframe.Buffer(None)
            segment.write(writer)
            ours.fill(writer, DEPTH)
            assert segment.follow(reader)
            assert reader.lookup("f0", frame(DEPTH), TIME) == own.lookup("f0", frame(DEPTH), TIME)
            yield Statement(code, {"buffer": reader, **names})
            yield Statement(code, {"buffer": own, **names})
        finally:
            segment.close()


def row(name: str, code: str) -> Row:
    return Row(
        f"{name} in shared transforms, D={DEPTH}",
        "coframe, own memory",
        lambda: contenders(code),
        GrowsAtMost(MAX_RATIO),
    )


ROWS = [row("lookup, newest,", NEWEST), row("lookup at a time", AT_A_TIME)]
