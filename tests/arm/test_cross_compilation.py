# SPDX-License-Identifier: Apache-2.0
"""Wheels and the DDS library for other processors than this one, and what the wheel for 64-bit ARM does there."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SKIPPED = re.compile(r"^test-arm: skipped: (.+)$", re.MULTILINE)

# What scripts/build_cyclonedds.sh builds, as small as possible.
SMALL_LIBRARY = """
cmake_minimum_required(VERSION 3.16)
project(small VERSION 11.0.1 LANGUAGES C)
add_library(ddsc SHARED small.c)
set_target_properties(ddsc PROPERTIES VERSION 11.0.1 SOVERSION 11)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a library of Linux")
@pytest.mark.timeout(600)
def test_the_dds_library_of_another_processor_needs_no_strip_of_this_one(tmp_path):
    if shutil.which("cmake") is None or shutil.which("cc") is None:
        pytest.skip("needs CMake and a C compiler")
    source, tools = tmp_path / "source", tmp_path / "tools"
    header = source / "src/core/ddsc/include/dds/dds.h"
    header.parent.mkdir(parents=True)
    header.touch()
    (source / "LICENSE").write_text("license")
    (source / "CMakeLists.txt").write_text(SMALL_LIBRARY)
    (source / "small.c").write_text("static int hidden_number = 1; int dds_number(void) { return hidden_number; }\n")
    tools.mkdir()
    strip = tools / "strip"
    strip.write_text('#!/bin/sh\necho "strip: Unable to recognise the format of the input file" >&2\nexit 1\n')
    strip.chmod(0o755)
    path = f"{tools}{os.pathsep}{os.environ['PATH']}"
    command = ["sh", ROOT / "scripts/build_cyclonedds.sh", source, tmp_path / "bundle"]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PATH": path}, check=False)
    assert done.returncode == 0, done.stderr
    library = Path(done.stdout.strip())
    assert library == tmp_path / "bundle/libddsc.so.11.0.1"
    assert (tmp_path / "bundle/LICENSE.cyclonedds").read_text() == "license"
    content = library.read_bytes()
    assert b"dds_number" in content
    assert b"hidden_number" not in content, "symbols of debuggers"


@pytest.mark.slow
@pytest.mark.timeout(7200)
def test_the_wheel_for_arm():
    done = subprocess.run([sys.executable, "-m", "scripts.arm"], cwd=ROOT, capture_output=True, text=True, check=False)
    if reason := SKIPPED.search(done.stdout):
        pytest.skip(reason[1])
    assert done.returncode == 0, (done.stdout + done.stderr)[-8000:]
    minor = int(re.search(r"manylinux_2_(\d+)_aarch64", done.stdout)[1])
    assert minor <= 28
