# SPDX-License-Identifier: Apache-2.0
"""Command line for the comparison of coframe with Debian's real tf2:

PYTHONPATH=tests/core python -m real_tf2 failure.json               a scenario that a test printed
PYTHONPATH=tests/core python -m real_tf2 --operations 10000000      random ones
"""

import argparse
import json
import sys
import time
from pathlib import Path

from real_tf2.comparison import Debian, difference_report, first_difference, run


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("failure", nargs="?", type=Path, help="a scenario as JSON")
    parser.add_argument("--operations", type=int, default=200_000)
    parser.add_argument("--seed", default=str(time.time_ns()))
    arguments = parser.parse_args()
    debian = Debian()
    if arguments.failure:
        made = json.loads(arguments.failure.read_text("utf-8"))
        finding = difference_report(debian, made) if first_difference(debian, made) else None
    else:
        print("seed", arguments.seed, flush=True)
        explained, finding = run(debian, arguments.seed, arguments.operations)
        print(*(f"{count:9} {reason}" for reason, count in explained.most_common()), sep="\n")
    debian.close()
    print(finding or "no difference that the rules do not explain")
    return 1 if finding else 0


if __name__ == "__main__":
    sys.exit(main())
