# SPDX-License-Identifier: Apache-2.0
"""The table of results, in the terminal and as a Markdown page."""

from pathlib import Path

from benchmarks.measuring import Result, Row, Spread

COLUMNS = ("", "coframe", "compared with", "its result", "ratio", "quartiles", "target", "")

LEGEND = """\
`ratio` is the other result divided by coframe's, as the median over the rounds, followed by its quartiles. Above 1,
coframe is faster or smaller. A floor is the cost of the work that no implementation can avoid, measured in the same
run. D is the depth of the chain, n the number of samples per frame, N the number of lookups or samples per call.
[README.md](README.md) describes how the benchmarks are measured and run.
"""


def cells(result: Result) -> tuple[str, ...]:
    """Return the cells of a row, in the order of the columns."""
    row = result.row
    target = row.target.text(row) if row.target else ""
    if result.error:
        return row.name, "", row.reference, "", "", "", target, f"{result.verdict}: {result.error}"
    mine = row.unit(Spread.of(result.ours).median) if result.ours else ""
    if not result.theirs:
        return (
            row.name,
            mine,
            row.reference,
            "",
            "",
            "",
            target,
            f"{result.verdict}: {result.missing}".removeprefix(": "),
        )
    ratio = result.ratio
    return (
        row.name,
        mine,
        row.reference,
        row.unit(Spread.of(result.theirs).median),
        f"{number(ratio.median)}x",
        f"{number(ratio.low)} - {number(ratio.high)}",
        target,
        result.verdict,
    )


def number(value: float) -> str:
    """Format a number with three digits, or without decimals from 100."""
    return f"{value:.0f}" if value >= 100 else f"{value:#.3g}".removesuffix(".")


class Terminal:
    """Formats the table row by row; the widths of the columns follow from all rows to be measured."""

    def __init__(self, rows: list[Row]) -> None:
        name = max(len(row.name) for row in rows)
        reference = max(len(row.reference) for row in rows)
        self._widths = (name, 10, reference, 10, 8, 15, 12, 0)

    def heading(self) -> str:
        return self.line(COLUMNS)

    def line(self, cells: tuple[str, ...]) -> str:
        return "  ".join(cell.ljust(width) for cell, width in zip(cells, self._widths, strict=True)).rstrip()


def summary(results: list[Result]) -> str:
    """Return how many targets are met, and which are not."""
    verdicts = [result.verdict for result in results if result.row.target]
    lines = [f"{verdicts.count('met')} of {len(verdicts)} targets are met, {verdicts.count('skipped')} skipped."]
    lines += [f"{result.verdict}: {_short(result)}" for result in results if result.failed]
    return "\n".join(lines)


def _short(result: Result) -> str:
    name, mine, reference, _, ratio, _, target, _ = cells(result)
    return f"{name} ({target}): {result.error or f'{mine}, {ratio} compared with {reference}'}"


def page(results: list[Result], facts: dict[str, str]) -> str:
    """Return the table with its summary as Markdown."""
    lines = ["# Results", "", "Written by `make bench`. Do not edit.", ""]
    lines += [f"- {name}: {fact}" for name, fact in facts.items()]
    lines += ["", LEGEND, _markdown(COLUMNS), _markdown(("---",) * len(COLUMNS))]
    lines += [_markdown(cells(result)) for result in results]
    lines += ["", *(f"{line}  " for line in summary(results).splitlines())]
    return "\n".join(lines).rstrip() + "\n"


def _markdown(cells: tuple[str, ...]) -> str:
    return f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"


def write(path: Path, results: list[Result], facts: dict[str, str]) -> None:
    path.write_text(page(results, facts), encoding="utf-8")
