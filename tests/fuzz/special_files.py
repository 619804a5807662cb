# SPDX-License-Identifier: Apache-2.0
"""Gives the readers of files pipes, devices, sockets, links and sparse files, in random combinations.

``python special_files.py --seconds 60`` prints statistics as libFuzzer does. It needs neither coverage nor atheris,
because the kind of file matters, not its bytes. A seed and a number determine a case, so ``--case`` repeats it.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "bags"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "files"))

import recordings
from special_files import KINDS, MAGIC, TERABYTE, Reader, readers

if TYPE_CHECKING:
    from types import FrameType

MAX_SECONDS = 5  # of a case


def sparse(path: Path, chance: random.Random) -> str:
    """Create a recording or other bytes, with holes up to a random size."""
    write = {".mcap": recordings.write_mcap, ".db3": lambda file: recordings.write_sqlite(file, 4)}.get(path.suffix)
    if write is not None and chance.random() < 0.5:
        write(path)
    else:
        path.write_bytes(MAGIC.get(path.suffix, b"# ") + chance.randbytes(chance.randrange(5000)))
    size = int(TERABYTE ** chance.uniform(0.5, 1))
    with path.open("r+b") as file:
        for _ in range(chance.randrange(4)):
            file.seek(chance.randrange(size))
            file.write(chance.randbytes(100))
        file.truncate(size)
    return f"{size} bytes with holes"


def special(path: Path, chance: random.Random) -> str:
    """Create a special file at a path; return what it is."""
    name = chance.choice([*KINDS, "holes"])
    if name == "holes":
        return sparse(path, chance)
    KINDS[name].make(path)
    return name


def linked(path: Path, chance: random.Random) -> str:
    """Create a special file to which a chain of links leads."""
    target = path.with_name(f"target{path.suffix}")
    name = special(target, chance)
    for number in range(chance.randrange(1, 50)):
        link = path.with_name(f"link{number}")
        link.symlink_to(target)
        target = link
    path.symlink_to(target)
    return f"links to {name}"


def replaced(path: Path, chance: random.Random, closing: contextlib.ExitStack) -> str:
    """Create a special file that is replaced by others while it is read."""
    name, ended = special(path, chance), threading.Event()

    def replace() -> None:
        for number in range(200):
            if ended.wait(chance.uniform(0, 0.002)):
                return
            other = path.with_name(f"other{number}{path.suffix}")
            with contextlib.suppress(OSError):
                special(other, chance)
                if path.is_dir() and not path.is_symlink():
                    path.rmdir()
                other.replace(path)

    thread = threading.Thread(target=replace, daemon=True)
    thread.start()
    closing.callback(thread.join)
    closing.callback(ended.set)
    return f"{name}, replaced in the meantime"


def written(path: Path, chance: random.Random, closing: contextlib.ExitStack) -> str:
    """Create a pipe into which a thread writes."""
    os.mkfifo(path)
    content = MAGIC.get(path.suffix, b"# ") + chance.randbytes(1000)

    def write() -> None:
        with contextlib.suppress(OSError):
            path.write_bytes(content)

    thread = threading.Thread(target=write, daemon=True)
    thread.start()

    def release() -> None:
        while thread.is_alive():
            os.close(os.open(path, os.O_RDONLY | os.O_NONBLOCK))
            thread.join(0.001)

    closing.callback(release)
    return "pipe with a writer"


def prepare(path: Path, chance: random.Random, closing: contextlib.ExitStack) -> str:
    """Create one of all these at a path; return what it is."""
    choice = chance.randrange(5)
    if choice < 2:
        return special(path, chance)
    if choice == 2:
        return linked(path, chance)
    return written(path, chance, closing) if choice == 3 else replaced(path, chance, closing)


def run_case(found: dict[str, Reader], seed: int, number: int) -> float:
    """Run one case; return how many seconds it took.

    Raises:
        AssertionError: It took too long, or another exception was raised than those of the reader.
    """
    chance = random.Random(f"{seed} {number}")
    name = chance.choice(list(found))
    reader, what = found[name], ""
    folder = Path(tempfile.mkdtemp(prefix="coframe-special-"))
    with contextlib.ExitStack() as closing:
        closing.callback(shutil.rmtree, folder, ignore_errors=True)
        try:
            what = prepare(folder / reader.file, chance, closing)
            closing.callback(signal.setitimer, signal.ITIMER_REAL, 0)
            started = time.monotonic()
            signal.setitimer(signal.ITIMER_REAL, MAX_SECONDS)
            with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(*reader.errors):
                reader.read(folder / reader.file)
            return time.monotonic() - started
        except Exception as error:
            raise AssertionError(f"case {number}: {name} of {what}: {type(error).__name__}: {error}") from error


def _too_long(_signal: int, _frame: FrameType | None) -> None:
    raise TimeoutError(f"takes more than {MAX_SECONDS} s")


def main() -> int:
    """Run what the command line says."""
    parser = argparse.ArgumentParser(description="Give special files to all readers.")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=0, help="0: a random one")
    parser.add_argument("--case", type=int, help="run only this case")
    options = parser.parse_args()
    seed = options.seed or random.SystemRandom().randrange(1, 1 << 32)
    signal.signal(signal.SIGALRM, _too_long)
    found = readers()
    slowest, number, end = 0.0, options.case or 0, time.monotonic() + options.seconds
    try:
        while number == options.case or (options.case is None and time.monotonic() < end):
            slowest = max(slowest, run_case(found, seed, number))
            number += 1
    except AssertionError as error:
        print(f"{error}. Reproduce: python tests/fuzz/special_files.py --seed {seed} --case {number}")
        return 1
    finally:
        print(f"stat::number_of_executed_units: {number}")
        print(f"stat::slowest_unit_time_sec: {slowest:.0f}")
        print(f"stat::peak_rss_mb: {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
