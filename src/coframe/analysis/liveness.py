"""How long a link may tell of nothing before that is worth a word; the doctor and explanations go by the same."""

from __future__ import annotations

__all__ = ["usual_gap", "usual_silence"]

_GAP = 500_000_000  # between two transforms
_SILENCE = 1_000_000_000  # since the last one
_UNUSUAL = 10  # times the usual period


def usual_gap(period: float) -> int:
    """The longest time between two transforms of a link that is no gap, from its period; all in nanoseconds.

    Example:
        >>> usual_gap(20e6), usual_gap(100e6)
        (500000000, 1000000000)
    """
    return max(_GAP, round(_UNUSUAL * period))


def usual_silence(period: float) -> int:
    """For how long a link may be silent without having stopped, likewise.

    Example:
        >>> usual_silence(20e6), usual_silence(200e6)
        (1000000000, 2000000000)
    """
    return max(_SILENCE, round(_UNUSUAL * period))
