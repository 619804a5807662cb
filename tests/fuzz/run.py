# SPDX-License-Identifier: Apache-2.0
"""Fuzzes all targets, or some, and prints a table: ``make fuzz SECONDS=60 ARGS="urdf mcap"``.

The corpora of the repository (``corpus/TARGET.zip``) and the seeds are unpacked into ``build/fuzz/corpus``, where runs
add the inputs that reach new code; the next run continues from there. ``--keep`` minimizes them into the repository.
"""

from __future__ import annotations

import argparse
import base64
import contextlib
import hashlib
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import time
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
BUILD = HERE.parents[1] / "build" / "fuzz"
CORPORA = HERE / "corpus"
NATIVE = sorted(file.stem for file in (HERE / "native").glob("*.cpp"))
UNGUIDED = ["special_files"]  # scripts that need neither coverage nor a corpus
PYTHON = re.findall(r"^@target\ndef (\w+)", (HERE / "python_targets.py").read_text(), re.MULTILINE)
ALL = [*NATIVE, *PYTHON, *UNGUIDED]

MAX_MEMORY = 1024  # MB
MAX_SECONDS = 5  # per input
# A xacro file is expanded in a separate process, which coframe ends after 20 s.
SLOW = {"xacro": 25}
MAX_INPUT_BYTES = {"frozen": 60_000, "frozen_file": 60_000, "sqlite": 30_000}  # bytes of an input; 8000 for others
MAX_CORPUS_BYTES = 90_000  # bytes of a corpus in the repository

_STATUS = re.compile(r"^#\d+\t.*?cov: (\d+).*?corp: (\d+)", re.MULTILINE)
_STATISTIC = re.compile(r"^stat::(\w+): +(\d+)", re.MULTILINE)
_ARTIFACT = re.compile(r"Test unit written to (\S+)")


@dataclass
class Outcome:
    """What a run of a target has shown."""

    name: str
    inputs: int = 0
    corpus: int = 0
    edges: int = 0
    slowest: float = 0.0  # seconds
    memory: int = 0  # MB
    crashes: list[Path] = field(default_factory=list)
    failure: str = ""


def corpus_of(name: str) -> Path:
    """Return the folder with the corpus of a target, and fill it the first time."""
    folder = BUILD / "corpus" / name
    folder.mkdir(parents=True, exist_ok=True)
    packed = CORPORA / f"{name}.zip"
    if packed.exists():
        with zipfile.ZipFile(packed) as archive:
            archive.extractall(folder)
    if not any(folder.iterdir()):
        import seeds

        for data in getattr(seeds, name)():
            (folder / hashlib.sha1(data, usedforsecurity=False).hexdigest()).write_bytes(data)
    return folder


def command(name: str) -> list[str]:
    """Return the command of a target, without options."""
    if name in NATIVE:
        return [str(BUILD / "native" / name)]
    return [sys.executable, str(HERE / "python_targets.py"), name]


def environment(scratch: str) -> dict[str, str]:
    """Return the environment of a target."""
    return {
        **os.environ,
        "ASAN_OPTIONS": "quarantine_size_mb=16",
        "UBSAN_OPTIONS": "print_stacktrace=1",
        "COFRAME_FUZZ_SCRATCH": scratch,
        "TMPDIR": scratch,
        "PYTHONHASHSEED": "0",
    }


def fuzz(name: str, seconds: int, seed: int, extra: list[Path]) -> Outcome:
    """Run a target for a few seconds; a seed of 0 is a random one."""
    if name in UNGUIDED:
        return run_unguided(name, seconds, seed)
    folder, seconds_per_input = corpus_of(name), SLOW.get(name, MAX_SECONDS)
    log = BUILD / f"{name}.log"
    options = [
        f"-max_total_time={seconds}",
        f"-seed={seed}",
        f"-timeout={seconds_per_input}",
        f"-rss_limit_mb={MAX_MEMORY}",
        f"-max_len={MAX_INPUT_BYTES.get(name, 8000)}",
        f"-artifact_prefix={BUILD}/{name}-",
        "-print_final_stats=1",
        "-reload=0",
    ]
    with scratch_folder() as scratch, log.open("wb") as output:
        ended = subprocess.run(
            [*command(name), *options, str(folder), *map(str, extra)],
            stdout=output,
            stderr=subprocess.STDOUT,
            env=environment(scratch),
            timeout=3 * seconds + 600,
            check=False,
        )
    return read_log(name, log, ended.returncode)


def run_unguided(name: str, seconds: int, seed: int) -> Outcome:
    """Run a script for a few seconds, which names the case that has failed in its last line."""
    log = BUILD / f"{name}.log"
    command = [sys.executable, str(HERE / f"{name}.py"), "--seconds", str(seconds), "--seed", str(seed)]
    with scratch_folder() as scratch, log.open("wb") as output:
        ended = subprocess.run(
            command,
            stdout=output,
            stderr=subprocess.STDOUT,
            env=environment(scratch),
            timeout=3 * seconds + 600,
            check=False,
        )
    return read_log(name, log, ended.returncode)


@contextlib.contextmanager
def scratch_folder():
    """Create a folder for the files of a target, in memory where the system has such a folder."""
    memory = Path("/dev/shm")
    with tempfile.TemporaryDirectory(prefix="coframe-fuzz-", dir=memory if memory.is_dir() else None) as folder:
        yield folder


def read_log(name: str, log: Path, code: int) -> Outcome:
    """Return what libFuzzer has written."""
    text = log.read_text("utf-8", "replace")
    outcome = Outcome(name)
    statistics = dict(_STATISTIC.findall(text))
    outcome.inputs = int(statistics.get("number_of_executed_units", 0))
    outcome.memory = int(statistics.get("peak_rss_mb", 0))
    outcome.slowest = float(statistics.get("slowest_unit_time_sec", 0))
    for edges, corpus in _STATUS.findall(text):
        outcome.edges, outcome.corpus = int(edges), int(corpus)
    outcome.crashes = [Path(path) for path in _ARTIFACT.findall(text) if "slow-unit" not in path]
    if code != 0 and not outcome.crashes:
        outcome.failure = f"ended with exit code {code}; see {log}"
    return outcome


def keep(name: str) -> str:
    """Minimize the corpus of a target and pack it into the repository."""
    folder, packed = corpus_of(name), CORPORA / f"{name}.zip"
    with scratch_folder() as scratch:
        merged = Path(scratch) / "merged"
        merged.mkdir()
        options = [f"-timeout={SLOW.get(name, MAX_SECONDS)}", f"-max_len={MAX_INPUT_BYTES.get(name, 8000)}", "-merge=1"]
        subprocess.run(
            [*command(name), *options, str(merged), str(folder)],
            capture_output=True,
            env=environment(scratch),
            check=False,
        )
        CORPORA.mkdir(exist_ok=True)
        if not any(merged.iterdir()):
            return f"{name}: the inputs cannot be merged; the corpus in the repository is unchanged"
        files, size = sorted(merged.iterdir(), key=lambda file: (file.stat().st_size, file.name)), 0
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
            for count, file in enumerate(files):
                before = packed.stat().st_size
                if before > MAX_CORPUS_BYTES:
                    return f"{name}: {count} of {len(files)} inputs, {before} bytes"
                archive.writestr(zipfile.ZipInfo(file.name), file.read_bytes(), zipfile.ZIP_DEFLATED)
                size += 1
    return f"{name}: {size} inputs, {packed.stat().st_size} bytes"


def table(outcomes: list[Outcome]) -> str:
    """Return the table of a run."""
    heads = ("target", "inputs", "corpus", "edges", "crashes", "slowest", "peak memory")
    rows = [
        (one.name, f"{one.inputs}", f"{one.corpus}", f"{one.edges}", f"{len(one.crashes)}", f"{one.slowest:g} s",
         f"{one.memory} MB")
        for one in outcomes
    ]  # fmt: skip
    rows.append(("total", f"{sum(one.inputs for one in outcomes)}", "", "", f"{sum(len(o.crashes) for o in outcomes)}",
                 f"{max((o.slowest for o in outcomes), default=0):g} s",
                 f"{max((o.memory for o in outcomes), default=0)} MB"))  # fmt: skip
    widths = [max(len(row[i]) for row in [heads, *rows]) for i in range(len(heads))]
    lines = [" | ".join([row[0].ljust(widths[0]), *map(str.rjust, row[1:], widths[1:])]) for row in [heads, *rows]]
    lines.insert(1, "-|-".join("-" * width for width in widths))
    return "\n".join(f"| {line} |" for line in lines)


def reproduction(name: str, file: Path) -> str:
    """Return the command that runs one input again."""
    once = [] if name in NATIVE else ["--once"]
    parts = [*command(name), *once, str(file)]
    return " ".join(os.path.relpath(part) if Path(part).is_absolute() else part for part in parts)


def available(names: list[str]) -> list[str]:
    """Return the targets that can run here, and say what the others need."""
    if importlib.util.find_spec("atheris") is None and (left := [name for name in names if name in PYTHON]):
        print(f"fuzz: atheris is not installed: {len(left)} targets in Python are skipped")
        names = [name for name in names if name not in left]
    if wanted := [name for name in names if name in NATIVE]:
        built = subprocess.run(
            ["make", "-s", "-j2", "-C", HERE / "native"], capture_output=True, text=True, check=False
        )
        if built.returncode != 0:
            reason = built.stderr.strip().splitlines()
            print(f"fuzz: the native targets cannot be built and are skipped: {reason[0] if reason else ''}")
            print("      They need clang with libFuzzer. On Debian: sudo apt-get install clang-14 libclang-rt-14-dev")
            names = [name for name in names if name not in wanted]
    return names


def main() -> int:
    """Run what the command line says."""
    parser = argparse.ArgumentParser(
        description="Fuzz coframe's decoders and readers.", epilog="Example: make fuzz SECONDS=600 ARGS='mcap urdf'"
    )
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=f"default: all of {', '.join(ALL)}")
    parser.add_argument("--seconds", type=int, default=60, help="total time, divided between the targets (60)")
    parser.add_argument("--seed", type=int, default=0, help="repeat the mutations of a run (default: random)")
    parser.add_argument("--extra", type=Path, action="append", default=[], help="a folder with more seeds")
    parser.add_argument("--keep", action="store_true", help="minimize the corpora into the repository; no fuzzing")
    options = parser.parse_args()
    if unknown := set(options.targets) - set(ALL):
        parser.error(f"unknown targets: {', '.join(sorted(unknown))}. Known: {', '.join(ALL)}")
    BUILD.mkdir(parents=True, exist_ok=True)
    names = available(options.targets or ALL)
    if options.keep:
        for name in names:
            if name not in UNGUIDED:
                print(keep(name), flush=True)
        return 0
    outcomes = []
    for name in names:
        started = time.monotonic()
        outcomes.append(fuzz(name, max(options.seconds // len(names), 1), options.seed, options.extra))
        print(
            f"{name}: {outcomes[-1].inputs} inputs in {time.monotonic() - started:.0f} s", file=sys.stderr, flush=True
        )
    print(table(outcomes))
    for outcome in outcomes:
        for crash in outcome.crashes:
            print(f"{outcome.name} failed. Reproduce: {reproduction(outcome.name, crash)}")
            print(f"The input in base64: {base64.b64encode(crash.read_bytes()).decode()}")
        if outcome.failure:
            print(f"{outcome.name} {outcome.failure}")
    return int(any(outcome.crashes or outcome.failure for outcome in outcomes))


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
