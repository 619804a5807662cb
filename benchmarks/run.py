"""`make bench`: single calls from Python, coframe and Debian's tf2 in turn, and the median of the ratios.

The peer is Debian's python3-tf2-ros (ROS 1's C++ core) in Debian's own Python; without it the ratios are left out.
"""

import platform
import statistics
import subprocess
import sys
from pathlib import Path

ROWS = Path(__file__).with_name("rows.py")
ROUNDS = 25
DEBIAN_PYTHON = "/usr/bin/python3"


class Contender:
    """A process that times calls on request."""

    def __init__(self, python, name):
        self.process = subprocess.Popen([python, ROWS, name], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, question):
        self.process.stdin.write(question + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().rstrip("\n")

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def has_debian_tf2():
    probe = [DEBIAN_PYTHON, "-c", "import tf2_py, genpy"]
    return Path(DEBIAN_PYTHON).exists() and subprocess.run(probe, capture_output=True, check=False).returncode == 0


def main():
    ours = Contender(sys.executable, "coframe")
    theirs = Contender(DEBIAN_PYTHON, "tf2") if has_debian_tf2() else None
    print(f"{platform.machine()}, Python {platform.python_version()}, {ROUNDS} rounds in turn; medians")
    if theirs is None:
        print("Debian's tf2 is not installed (apt-get install python3-tf2-ros): no ratios")
    print(f"{'':34}{'coframe':>10}{'tf2':>10}{'ratio':>8}{'middle half':>14}")
    for row in ours.ask("?").split("|"):
        pairs = [(float(ours.ask(row)), float(theirs.ask(row)) if theirs else None) for _ in range(ROUNDS)]
        line = f"{row:34}{statistics.median(our for our, _ in pairs):>7.0f} ns"
        if theirs:
            ratios = [their / our for our, their in pairs]
            low, middle, high = statistics.quantiles(ratios, n=4)
            line += f"{statistics.median(their for _, their in pairs):>7.0f} ns{middle:>7.1f}x{low:>7.1f}-{high:.1f}"
        print(line, flush=True)
    ours.close()
    if theirs:
        theirs.close()


main()
