# SPDX-License-Identifier: Apache-2.0
"""The kernels process several numbers at a time also with GCC 10 and 11, which lack a function of newer compilers."""

import shutil
import subprocess
from pathlib import Path

import pytest

NATIVE = Path(__file__).parents[2] / "native"
# With these macros, the compiler seems to have none of the functions that GCC 12 added.
OLD = ["-D__builtin_shufflevector=missing"]
LEVELS = {2: [], 4: ["-mavx2", "-mfma"], 8: ["-mavx2", "-mfma", "-mavx512f"]}

PROGRAM = """
#include "kernels/packed.hpp"

#include <cstdio>

namespace here = coframe::plain;
static_assert(here::kLanes == LANES);

// Transposes rows of numbers, and points of floats, and back.
int main() {
  double in[LANES][4], out[LANES][4] = {};
  const double* from[LANES];
  double* to[LANES];
  for (int row = 0; row < LANES; ++row) {
    for (int i = 0; i < 4; ++i) in[row][i] = 10 * row + i;
    from[row] = in[row];
    to[row] = out[row];
  }
  here::Lanes first, second;
  here::load_columns(from, 1, first, second);
  for (int row = 0; row < LANES; ++row) std::printf("%g %g ", first[row], second[row]);
  here::store_columns(first, second, to, 1);
  for (int row = 0; row < LANES; ++row) std::printf("%g %g ", out[row][1], out[row][2]);
  float points[16];
  for (int i = 0; i < 16; ++i) points[i] = i;
  char stored[16 * 4] = {};
  const auto loaded = here::load_four(reinterpret_cast<const char*>(points), 12);
  for (int i = 0; i < 4; ++i) std::printf("%g %g %g ", loaded.x[i], loaded.y[i], loaded.z[i]);
  here::store_four(loaded, stored, 12);
  for (int i = 0; i < 12; ++i) std::printf("%g ", reinterpret_cast<const float*>(stored)[i]);
}
"""


def gcc(source, *words):
    command = ["g++", "-std=c++20", "-O1", "-I", NATIVE, source, *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("lanes", LEVELS)
def test_gcc_without_shufflevector(tmp_path, lanes):
    if shutil.which("g++") is None:
        pytest.skip("needs g++")
    if lanes > 2 and "x86_64" not in subprocess.check_output(["g++", "-dumpmachine"], text=True):
        pytest.skip("processors of other kinds have two lanes")
    source, program = tmp_path / "program.cpp", tmp_path / "program"
    source.write_text(PROGRAM)
    gcc(source, *OLD, *LEVELS[lanes], f"-DLANES={lanes}", *(["-o", program] if lanes == 2 else ["-c", "-o", program]))
    if lanes > 2:  # this processor may lack the instructions
        return
    printed = [float(word) for word in subprocess.check_output([program], text=True).split()]
    assert printed == [1, 2, 11, 12] * 2 + [*range(12)] * 2
