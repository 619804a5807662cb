# SPDX-License-Identifier: Apache-2.0
"""Long-running commands return freed memory."""

import platform
import subprocess
import sys

import pytest

MEMORY = """
import os, sys
from pathlib import Path
import numpy as np
from coframe._process.freed_memory import return_freed_arrays, return_freed_blocks

def memory():
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
"""
ARRAYS = """
if sys.argv[1] == "returned":
    return_freed_arrays()
np.ones(1_000_000)  # From now on, glibc keeps blocks of up to 8 MB.
before = memory()
arrays = [np.ones(250_000) for _ in range(51)]
last = arrays.pop()  # at the end of the heap, which glibc would return otherwise
arrays.clear()
print(memory() - before)
"""
BLOCKS = """
before = memory()
arrays = [np.ones(6000) for _ in range(1000)]
last = arrays.pop()  # at the end of the heap, which glibc would return otherwise
arrays.clear()
if sys.argv[1] == "returned":
    return_freed_blocks()
print(memory() - before)
"""
CYCLES = """
import gc
return_freed_blocks()
gc.collect()
for _ in range(20):
    return_freed_blocks()
print(gc.collect())
"""


def kept(script, how):
    done = subprocess.run([sys.executable, "-c", MEMORY + script, how], capture_output=True, text=True, check=True)
    return int(done.stdout)


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="about the allocator of glibc")
def test_freed_arrays_are_returned_to_the_system():
    assert kept(ARRAYS, "kept") > 50e6
    assert kept(ARRAYS, "returned") < 10e6


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="about the allocator of glibc")
def test_freed_blocks_below_another_one_are_returned_to_the_system():
    assert kept(BLOCKS, "kept") > 30e6
    assert kept(BLOCKS, "returned") < 15e6


def test_returning_memory_leaves_nothing_for_the_cyclic_garbage_collector():
    assert kept(CYCLES, "") == 0
