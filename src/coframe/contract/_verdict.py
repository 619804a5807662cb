# SPDX-License-Identifier: Apache-2.0
"""Verdict: whether one recording, or the running system, satisfies a contract."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from coframe._output import html_tables
from coframe._output.escaping import one_line
from coframe._output.formatting import error_text
from coframe._sources.urls import is_url, remove_credentials
from coframe.bags.namespaces import ALL_TRANSFORMS
from coframe.contract._checks import check_contract
from coframe.contract._measurement import measure_recording
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable

    from typing_extensions import Self

    from coframe._sources.sources import Location
    from coframe.bags.namespaces import TransformChoice
    from coframe.contract._checks import Result
    from coframe.contract._contract import Contract
    from coframe.errors import CoframeError

__all__ = ["Verdict", "check_recording"]


class Verdict(NamedTuple):
    """The results for one recording or for the running system.

    Attributes:
        source: The path of the recording; ``live`` for the running system.
        results: The result of each requirement; empty if the recording cannot be read.
        unreadable: Why the recording cannot be read, or "" if it can.
        unread: What of the recording could not be read, and so was not checked.
    """

    source: str
    results: tuple[Result, ...]
    unreadable: str = ""
    unread: tuple[str, ...] = ()

    @classmethod
    def of_error(cls, source: str, error: CoframeError) -> Self:
        """Return the verdict for a recording that cannot be read, with the hint of the error."""
        return cls(source, (), error_text(error))

    @property
    def broken(self) -> tuple[Result, ...]:
        """The results of the requirements that are not met."""
        return tuple(result for result in self.results if not result.is_met)

    @property
    def is_kept(self) -> bool:
        """Whether the recording can be read and meets all requirements."""
        return not self.unreadable and not self.broken

    @property
    def unchecked(self) -> tuple[str, ...]:
        """What was not checked, and why, one sentence each."""
        return self.unread + tuple(
            f"{each.kind} {each.subject}: {reason}" for each in self.results for reason in each.unchecked
        )

    def text(self) -> str:
        """Return a summary, and a line for each problem and each requirement that was not checked."""
        if self.unreadable:
            return f"{self.source}: {one_line(self.unreadable)}"
        met = len(self.results) - len(self.broken)
        lines = [f"{self.source}: {met} of {len(self.results)} requirements are met"]
        problems = [f"{each.kind} {each.subject}: {problem}" for each in self.broken for problem in each.problems]
        problems += [f"not checked: {each}" for each in self.unchecked]
        return "\n".join([*lines, *(f"  {one_line(problem)}" for problem in problems)])

    def _repr_html_(self) -> str:
        title = self.text().partition("\n")[0]
        rows = (
            (each.kind, each.subject, "yes" if each.is_met else "no", " ".join(each.problems)) for each in self.results
        )
        return html_tables.section(
            title,
            html_tables.table(("requirement", "subject", "met", "problems"), rows, len(self.results), "requirement"),
            html_tables.table(("not checked",), ((each,) for each in self.unchecked), len(self.unchecked)),
        )


def check_recording(
    contract: Contract,
    path: Location,
    choice: TransformChoice = ALL_TRANSFORMS,
    *,
    progress: Callable[[int, int], object] | None = None,
) -> Verdict:
    """Check one recording. If it cannot be read, the verdict says so.

    Args:
        contract: The contract.
        path: A file, the folder of a rosbag2 recording, or its URL.
        choice: The transforms to read, and the prefix of their frames.
        progress: Called repeatedly with the number of bytes read and the total number.
    """
    name = remove_credentials(path) if isinstance(path, str) and is_url(path) else str(path)
    try:
        measurement = measure_recording(path, choice, progress=progress)
    except RecordingError as error:
        return Verdict.of_error(name, error)
    unread_parts = dict.fromkeys(each for one in measurement.observations.values() for each in one.unread)
    return Verdict(name, tuple(check_contract(contract, measurement)), unread=tuple(unread_parts))
