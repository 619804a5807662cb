# SPDX-License-Identifier: Apache-2.0
"""The core compiles for Windows and macOS. Nothing is run there: Zig's compiler has the headers of all systems."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
NATIVE = ROOT / "native"
pytestmark = [pytest.mark.slow, pytest.mark.timeout(900)]

# What the header of Microsoft's SDK does; the one of MinGW, which Zig has, does not.
WINDOWS_H = """
#include_next <windows.h>
#ifndef NOMINMAX
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define min(a, b) (((a) < (b)) ? (a) : (b))
#endif
"""


def sources():
    """The files of the core in the order in which a unity build includes them."""
    text = (ROOT / "CMakeLists.txt").read_text("utf-8")
    (listed,) = re.findall(r"add_library\(coframe_core STATIC(.*?)\)\n", text, re.DOTALL)
    return re.findall(r"^ +native/(\S+\.cpp)", listed, re.MULTILINE)


@pytest.mark.parametrize("target", ["x86_64-windows-gnu", "aarch64-macos.11.0"])
def test_the_core_compiles_for_another_system(tmp_path, target):
    if importlib.util.find_spec("ziglang") is None:
        pytest.skip("needs the package ziglang: make test-slow installs it")
    headers, unity = tmp_path / "headers", tmp_path / "unity.cpp"
    headers.mkdir()
    if "windows" in target:
        (headers / "windows.h").write_text(WINDOWS_H)
    unity.write_text("".join(f'#include "{file}"\n' for file in sources()))
    options = ["-target", target, "-std=c++20", "-O0", "-c", "-o", tmp_path / "unity.o", "-I", headers, "-I", NATIVE]
    command = [sys.executable, "-m", "ziglang", "c++", *options, unity]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[:6000]
