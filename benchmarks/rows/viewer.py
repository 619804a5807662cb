"""The viewer's server with one tab: frames that move, 30 times a second."""

from collections.abc import Generator

from benchmarks.measuring import AtMost, Contender, Row, percent
from benchmarks.process import Program

SECONDS = "4"
LIMITS = {10: 3.0, 100: 3.0, 1000: 5.0}
"""Percent of one core, beyond the look-ups, by the number of frames."""


class LookUps:
    """The second figure of the same program."""

    def __init__(self, frames: int) -> None:
        self._program = Program("-m", "benchmarks.viewer_load", str(frames), "1")

    def sample(self) -> float:
        return self._program.sample(1)


def row(frames: int, limit: float) -> Row:
    def contenders() -> Generator[Contender]:
        yield Program("-m", "benchmarks.viewer_load", str(frames), SECONDS)
        yield LookUps(frames)

    name = f"a tab of the viewer, {frames} frames at 30 Hz, CPU of one core"
    return Row(name, "the look-ups themselves", contenders, AtMost(limit), percent, least=3, processors=2)


ROWS = [row(frames, limit) for frames, limit in LIMITS.items()]
