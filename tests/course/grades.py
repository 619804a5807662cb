# SPDX-License-Identifier: Apache-2.0
"""The reference solution, and the facts of a report that lost points."""

from pathlib import Path

SOLUTION = Path(__file__).with_name("solution")


def lost(criterion):
    """Return the facts of a criterion that lost points, with everything that is said about them."""
    return {fact["name"]: fact for fact in criterion["facts"] if fact["earned"] < fact["points"]}
