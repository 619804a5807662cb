# SPDX-License-Identifier: Apache-2.0
"""`make bench`: compares coframe with its peers in one table, and checks whether each target is met.

make bench                                  all rows; writes benchmarks/RESULTS.md
make bench ARGS="--rows lookup deskew"      the rows whose subject or name contains one of these words
make bench ARGS="--quick"                   all rows with few samples
"""

import argparse
import sys
from pathlib import Path

from benchmarks import machine, report
from benchmarks.measuring import Effort, Row, measure
from benchmarks.rows import ROWS

RESULTS = Path(__file__).with_name("RESULTS.md")
QUICK = Effort(rounds=7, seconds=0.5, least=2)


def chosen(words: list[str]) -> list[Row]:
    """Return the rows whose subject or name contains one of the words; without words, all rows."""
    return [
        row
        for subject, rows in ROWS.items()
        for row in rows
        if not words or any(word in subject or word in row.name for word in words)
    ]


def run(rows: list[Row], effort: Effort, results: Path | None) -> int:
    """Measure and print the rows, and write the page if there is a path for it; return the exit status."""
    terminal = report.Terminal(rows)
    print(terminal.heading(), flush=True)
    measured = []
    for row in rows:
        measured.append(measure(row, effort))
        print(terminal.line(report.cells(measured[-1])), flush=True)
    print()
    print(report.summary(measured))
    if results:
        report.write(results, measured, machine.facts())
        print(f"written: {results}")
    return int(any(result.failed for result in measured))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", nargs="+", default=[], metavar="WORD", help="only rows that contain one of the words")
    parser.add_argument("--quick", action="store_true", help="few samples")
    arguments = parser.parse_args()
    rows = chosen(arguments.rows)
    if not rows:
        parser.error(f"no row contains any of: {' '.join(arguments.rows)}. Subjects: {', '.join(ROWS)}")
    is_full_run = not arguments.rows and not arguments.quick
    return run(rows, QUICK if arguments.quick else Effort(), RESULTS if is_full_run else None)


if __name__ == "__main__":
    sys.exit(main())
