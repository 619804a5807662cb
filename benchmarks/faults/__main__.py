# SPDX-License-Identifier: Apache-2.0
"""`make faults`: causes faults between real processes, and checks what coframe promises for each.

make faults                         all faults; ends with a table, and with exit code 1 if a promise was broken
make faults ARGS="loss_30 disk"     the faults whose name contains one of these words
make faults ARGS="--list"           their names and promises

It runs in its own network and mount namespaces, which need root or unprivileged user namespaces. Nothing outside
them is changed.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import time
import traceback
from collections import Counter
from typing import NamedTuple

from benchmarks import machine
from benchmarks.faults import clocks, disks, kills, limits, links, routers  # noqa: F401 - they add their cases
from benchmarks.faults.case import CASES, Case, SkippedError

_INSIDE = "COFRAME_FAULTS_NETWORK"
_UP = 'ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"'


class Outcome(NamedTuple):
    """The result of a case."""

    case: Case
    verdict: str
    measured: str


def enter_namespaces() -> None:
    """Continue in a network and a file system of its own. Return if it is there already."""
    if os.environ.get(_INSIDE):
        return
    if not (shutil.which("unshare") and shutil.which("nsenter") and shutil.which("ip")):
        sys.exit("make faults: needs unshare, nsenter and ip: apt-get install util-linux iproute2")
    rights = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    namespaces = ["unshare", *rights, "--net", "--mount"]
    if subprocess.run([*namespaces, "true"], capture_output=True, check=False).returncode:
        sys.exit("make faults: no network namespace can be made here: run it as root")
    os.environ[_INSIDE] = "1"
    command = [sys.executable, "-E", "-m", "benchmarks.faults", *sys.argv[1:]]
    os.execvp(namespaces[0], [*namespaces, "sh", "-c", _UP, "sh", *command])


def run(case: Case) -> Outcome:
    """Run a case. A case that raises an error has broken its promise."""
    try:
        measured = case.run()
    except SkippedError as reason:
        return Outcome(case, "skipped", str(reason))
    except Exception as error:  # noqa: BLE001 - the other cases must run
        traceback.print_exc()
        return Outcome(case, "BROKEN", str(error).strip().rpartition("\n")[2][:200])
    return Outcome(case, "kept" if measured.kept else "BROKEN", measured.text)


def table(outcomes: list[Outcome]) -> str:
    """Return the outcomes as a Markdown table."""
    rows = [f"| {each.case.name} | {each.case.promise} | {each.measured} | {each.verdict} |" for each in outcomes]
    return "\n".join(["| fault | promise | measured | verdict |", "|---|---|---|---|", *rows])


def summary(outcomes: list[Outcome]) -> str:
    """Return the counts of the verdicts, and the names of the broken promises."""
    count = Counter(each.verdict for each in outcomes)
    faults = "1 fault" if len(outcomes) == 1 else f"{len(outcomes)} faults"
    broken = ", ".join(each.case.name for each in outcomes if each.verdict == "BROKEN")
    text = f"{faults}: {count['kept']} kept, {count['BROKEN']} broken, {count['skipped']} skipped"
    return f"{text}: {broken}" if broken else text


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="WORD", help="only faults whose name contains one of the words")
    parser.add_argument("--list", action="store_true", help="print the names and promises")
    arguments = parser.parse_args()
    chosen = [case for case in CASES if not arguments.words or any(word in case.name for word in arguments.words)]
    if not chosen:
        names = ", ".join(case.name for case in CASES)
        parser.error(f"no fault contains any of: {' '.join(arguments.words)}. Faults: {names}")
    if arguments.list:
        print("\n".join(f"{case.name:20} {case.promise}" for case in chosen))
        return 0
    enter_namespaces()
    outcomes = []
    for case in chosen:
        begin = time.monotonic()
        outcomes.append(run(case))
        took = time.monotonic() - begin
        print(f"{outcomes[-1].verdict:8} {case.name:20} {took:4.0f} s  {outcomes[-1].measured}", flush=True)
    facts = machine.facts()
    print("", *(f"{name}: {facts[name]}" for name in ("Date", "Machine", "Load", "coframe", "Python")), sep="\n")
    print("", table(outcomes), sep="\n")
    print("", summary(outcomes), sep="\n")
    return int(any(each.verdict == "BROKEN" for each in outcomes))


if __name__ == "__main__":
    sys.exit(main())
