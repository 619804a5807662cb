# SPDX-License-Identifier: Apache-2.0
"""Tests of the native core under sanitizers: concurrent readers and writers, damaged messages, and writers that die.

`make sanitize` runs the same programs. The results of the build stay in build/sanitize.
"""

import fcntl
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.timeout(600)  # includes the first build

FOLDER = Path(__file__).parent
BUILD = FOLDER.parents[1] / "build" / "sanitize"
FLAGS = {"thread": "-fsanitize=thread", "address": "-fsanitize=address,undefined", "plain": "-pthread"}
on_linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="transforms are shared on Linux only")


def build(kind, tmp_path):
    if not (shutil.which("make") and shutil.which("c++")):
        pytest.skip("the sanitizers need make and a C++ compiler")
    probe = tmp_path / "probe.cpp"
    probe.write_text("int main() {}")
    command = ["c++", FLAGS[kind], probe, "-o", probe.with_suffix("")]
    if subprocess.run(command, capture_output=True, check=False).returncode != 0:
        pytest.skip(f"the C++ compiler cannot build with {FLAGS[kind]}")
    BUILD.mkdir(parents=True, exist_ok=True)
    with (BUILD / "lock").open("w") as lock:  # another test run may use this folder
        fcntl.flock(lock, fcntl.LOCK_EX)
        made = subprocess.run(
            ["make", "-s", "-j2", "-C", FOLDER, kind, f"BUILD={BUILD}"], capture_output=True, text=True, check=False
        )
    assert made.returncode == 0, made.stderr


def run(kind, program, amount):
    command = [BUILD / kind / program, str(amount)]
    if kind in ("thread", "address"):
        command.insert(0, FOLDER / "sanitized.sh")
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    print(ended.stdout)
    assert (ended.returncode, ended.stderr) == (0, ""), ended.stderr


@pytest.mark.slow
def test_concurrent_readers_and_writers_have_no_data_race(tmp_path):
    build("thread", tmp_path)
    run("thread", "stress", 60)


@pytest.mark.slow
def test_concurrent_readers_and_writers_have_no_memory_error(tmp_path):
    build("address", tmp_path)
    run("address", "stress", 20)


@pytest.mark.slow
def test_latest_transform_is_available_while_samples_are_dropped(tmp_path):
    build("address", tmp_path)
    run("address", "latest", 10)


@pytest.mark.slow
def test_damaged_messages_cause_no_memory_error(tmp_path):
    build("address", tmp_path)
    run("address", "fuzz_ingest", 200_000)


@pytest.mark.slow
def test_damaged_frozen_buffers_cause_no_memory_error(tmp_path):
    build("address", tmp_path)
    run("address", "fuzz_frozen", 3000)


@on_linux
@pytest.mark.slow
def test_readers_of_a_shared_tree_have_no_data_race(tmp_path):
    build("thread", tmp_path)
    run("thread", "shared_stress", 10)


@on_linux
@pytest.mark.slow
def test_another_writer_continues_after_every_instruction_of_a_change(tmp_path):
    build("plain", tmp_path)
    run("plain", "crash", 0)


@on_linux
@pytest.mark.slow
def test_readers_see_whole_samples_in_every_order_of_steps(tmp_path):
    build("plain", tmp_path)
    run("explored", "explore", 0)


@on_linux
@pytest.mark.slow
def test_nothing_is_lost_when_writers_are_killed(tmp_path):
    build("plain", tmp_path)
    run("plain", "kill_writer", 100)
