# SPDX-License-Identifier: Apache-2.0
"""Compile extension modules for Linux on another processor, with Zig's compiler (the package `ziglang`).

Zig has the headers of every C library and its own C++ library, which it links statically. So the modules need no newer
glibc than `GLIBC`, regardless of the distribution of this machine.
"""

from __future__ import annotations

import json
import os
import pprint
import subprocess
from pathlib import Path

TOOLS = ["ziglang>=0.17,<0.18"]
GLIBC = "2.28"
CACHE = "ZIG_GLOBAL_CACHE_DIR"  # Zig's own variable: it compiles its C++ library once
MACHINES = ["aarch64"]
# Of the Python that compiles: its configuration, and Debian's header that includes another one for each processor.
PROBE = """
import json, importlib, sysconfig
name = sysconfig._get_sysconfigdata_name()
version = sysconfig.get_config_var("py_version_short")
header = f"{sysconfig.get_config_var('MULTIARCH')}/python{version}{sysconfig.get_config_var('ABIFLAGS')}/pyconfig.h"
print(json.dumps({
    "variables": importlib.import_module(name).build_time_vars,
    "multiarch": sysconfig.get_config_var("MULTIARCH"),
    "header": header,
}))
"""


def environment(python: str | Path, folder: Path, machine: str) -> dict[str, str]:
    """Return the variables with which ``pip wheel`` compiles for another processor.

    Args:
        python: An interpreter of this machine, of the version for which the modules are, with TOOLS installed.
        folder: Gets the files to which the variables refer.
        machine: One of MACHINES.
    """
    folder.mkdir(parents=True, exist_ok=True)
    command = [str(python), "-c", PROBE]
    facts = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    triplet = f"{machine}-linux-gnu"
    variables = {
        name: value.replace(facts["multiarch"], triplet) if isinstance(value, str) else value
        for name, value in facts["variables"].items()
    }
    data = f"_sysconfigdata__{triplet}"
    write(folder / "python" / f"{data}.py", f"build_time_vars = {pprint.pformat(variables)}\n")
    own = Path("/usr/include") / facts["header"]
    if own.is_file():  # The processors differ in definitions that only CPython itself uses.
        write(folder / "include" / facts["header"].replace(facts["multiarch"], triplet), f'#include "{own}"\n')
    return {
        CACHE: os.environ.get(CACHE, str(Path(__file__).resolve().parents[1] / "build" / "zig")),
        "CMAKE_TOOLCHAIN_FILE": str(toolchain(Path(python), folder, machine)),
        "PYTHONPATH": str(folder / "python"),
        "_PYTHON_HOST_PLATFORM": f"linux-{machine}",
        "_PYTHON_SYSCONFIGDATA_NAME": data,
    }


def toolchain(python: Path, folder: Path, machine: str) -> Path:
    """Write a file for CMake that names Zig's programs; return its path."""
    command = [str(python), "-c", "import ziglang; print(ziglang.__path__[0])"]
    zig = Path(subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()) / "zig"
    target = f" -target {machine}-linux-gnu.{GLIBC}"
    programs = {}
    for name, options in (("cc", target), ("c++", target), ("ar", ""), ("ranlib", "")):
        programs[name] = folder / name
        write(programs[name], f'#!/bin/sh\nexec "{zig}" {name}{options} "$@"\n')
        programs[name].chmod(0o755)
    file = folder / f"{machine}.cmake"
    lines = [
        "set(CMAKE_SYSTEM_NAME Linux)",
        f"set(CMAKE_SYSTEM_PROCESSOR {machine})",
        f'set(CMAKE_C_COMPILER "{programs["cc"]}")',
        f'set(CMAKE_CXX_COMPILER "{programs["c++"]}")',
        f'set(CMAKE_AR "{programs["ar"]}")',
        f'set(CMAKE_RANLIB "{programs["ranlib"]}")',
        # For programs with symbols or without optimization, as in tests of CMake, Zig compiles another C++ library.
        f'set(CMAKE_CXX_FLAGS_INIT "-O3 -s -idirafter {folder / "include"}")',
        "set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY NEVER)",
    ]
    write(file, "\n".join(lines) + "\n")
    return file


def write(path: Path, text: str) -> None:
    """Write a file if its content differs: what was compiled with it remains valid."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
