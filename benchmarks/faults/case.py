# SPDX-License-Identifier: Apache-2.0
"""A fault: its promise, its measurement and its verdict."""

from __future__ import annotations

import importlib.util
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable


_WIRE: Final = "COFRAME_WIRE"


class SkippedError(Exception):
    """The fault cannot be caused on this machine; the text says why."""


class Measurement(NamedTuple):
    """What was measured, and whether the promise was kept."""

    text: str
    kept: bool


@dataclass(frozen=True)
class Case:
    """A fault.

    Attributes:
        name: The name at the command line.
        promise: What coframe promises under this fault.
        run: Causes the fault and measures; raises `SkippedError` if that is impossible here.
    """

    name: str
    promise: str
    run: Callable[[], Measurement]


CASES: list[Case] = []


def case(name: str, promise: str) -> Callable[[Callable[[], Measurement]], Callable[[], Measurement]]:
    """Add the decorated function to the cases."""

    def add(run: Callable[[], Measurement]) -> Callable[[], Measurement]:
        CASES.append(Case(name, promise, run))
        return run

    return add


def network_case(name: str, promise: str) -> Callable[[Callable[[], Measurement]], Callable[[], Measurement]]:
    """Add the decorated function to the cases twice: for the middleware of this process, and for Fast DDS."""

    def add(run: Callable[[], Measurement]) -> Callable[[], Measurement]:
        case(name, promise)(run)
        case(f"{name}_fastdds", f"over Fast DDS, {promise}")(lambda: _over_fast_dds(run))
        return run

    return add


def _over_fast_dds(run: Callable[[], Measurement]) -> Measurement:
    if importlib.util.find_spec("coframe_fastdds") is None:
        raise SkippedError("coframe-fastdds is not installed")
    before = os.environ.get(_WIRE)
    os.environ[_WIRE] = "fastdds"
    try:
        return run()
    finally:
        if before is None:
            del os.environ[_WIRE]
        else:
            os.environ[_WIRE] = before
