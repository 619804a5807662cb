"""The table: in the terminal as it grows, and as a page."""

from pathlib import Path

from benchmarks.measuring import Result, Row, Spread

COLUMNS = ("", "coframe", "beside", "its figure", "ratio", "middle half", "bar", "")

LEGEND = """\
`ratio` is the other's figure by ours, the median over the rounds, and the middle half of them stands beside it: above 1
coframe is faster or smaller. Floors are what no implementation could go below; they are measured in the same run. D is
the depth of the chain, n the samples of each frame, N the look-ups or samples of one call. How it is measured, and how
to run it: [README.md](README.md).
"""


def cells(result: Result) -> tuple[str, ...]:
    """A row's cells, in the order of the columns."""
    row = result.row
    bar = row.bar.text(row) if row.bar else ""
    if result.error:
        return row.name, "", row.beside, "", "", "", bar, f"{result.verdict}: {result.error}"
    mine = row.unit(Spread.of(result.ours).median) if result.ours else ""
    if not result.theirs:
        return row.name, mine, row.beside, "", "", "", bar, f"{result.verdict}: {result.missing}".removeprefix(": ")
    ratio = result.ratio
    return (
        row.name,
        mine,
        row.beside,
        row.unit(Spread.of(result.theirs).median),
        f"{number(ratio.median)}x",
        f"{number(ratio.low)} - {number(ratio.high)}",
        bar,
        result.verdict,
    )


def number(value: float) -> str:
    """Three digits, for all that is below a thousand."""
    return f"{value:.0f}" if value >= 100 else f"{value:#.3g}".removesuffix(".")


class Terminal:
    """Prints the table a row at a time: the widths are known from the rows that are to come."""

    def __init__(self, rows: list[Row]) -> None:
        name = max(len(row.name) for row in rows)
        beside = max(len(row.beside) for row in rows)
        self._widths = (name, 10, beside, 10, 8, 15, 12, 0)

    def heading(self) -> str:
        return self.line(COLUMNS)

    def line(self, cells: tuple[str, ...]) -> str:
        return "  ".join(cell.ljust(width) for cell, width in zip(cells, self._widths, strict=True)).rstrip()


def summary(results: list[Result]) -> str:
    """Which bars are met, and which are not."""
    verdicts = [result.verdict for result in results if result.row.bar]
    lines = [f"{verdicts.count('met')} of {len(verdicts)} bars are met, {verdicts.count('skipped')} skipped."]
    lines += [f"{result.verdict}: {_short(result)}" for result in results if result.failed]
    return "\n".join(lines)


def _short(result: Result) -> str:
    name, mine, beside, _, ratio, _, bar, _ = cells(result)
    return f"{name} ({bar}): {result.error or f'{mine}, {ratio} beside {beside}'}"


def page(results: list[Result], facts: dict[str, str]) -> str:
    """The table with all that belongs to it, as Markdown."""
    lines = ["# Results", "", "Written by `make bench`; not to be edited.", ""]
    lines += [f"- {name}: {fact}" for name, fact in facts.items()]
    lines += ["", LEGEND, _markdown(COLUMNS), _markdown(("---",) * len(COLUMNS))]
    lines += [_markdown(cells(result)) for result in results]
    lines += ["", *(f"{line}  " for line in summary(results).splitlines())]
    return "\n".join(lines).rstrip() + "\n"


def _markdown(cells: tuple[str, ...]) -> str:
    return f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"


def write(path: Path, results: list[Result], facts: dict[str, str]) -> None:
    path.write_text(page(results, facts), encoding="utf-8")
