# SPDX-License-Identifier: Apache-2.0
"""Long-running commands return the memory of freed arrays."""

import platform
import subprocess
import sys

import pytest

ARRAYS = """
import os, sys
from pathlib import Path
import numpy as np
from coframe.freed_memory import return_freed_arrays

def memory():
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

if sys.argv[1] == "returned":
    return_freed_arrays()
np.ones(1_000_000)  # From now on, glibc keeps blocks of up to 8 MB.
before = memory()
arrays, small = [], []
for _ in range(50):
    arrays.append(np.ones(250_000))
    small.append(bytes(50_000))
arrays.clear()
print(memory() - before)
"""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="about the allocator of glibc")
def test_freed_arrays_are_returned_to_the_system():
    def kept(how):
        done = subprocess.run([sys.executable, "-c", ARRAYS, how], capture_output=True, text=True, check=True)
        return int(done.stdout)

    assert kept("kept") > 50e6
    assert kept("returned") < 10e6
