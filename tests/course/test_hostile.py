# SPDX-License-Identifier: Apache-2.0
"""Submissions that loop, crash, fork, hide, cheat, or publish without end: each ends in a grade with a sentence."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from coframe.course.isolation import isolated_environment, isolation_problem

NODE = """
import rclpy
from rclpy.node import Node
rclpy.init()
node = Node('static_tf_broadcaster')
"""
# Runs a function in a process of its own session whose parent has ended.
DAEMON = """
import os, time
def daemon(run):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            run()
        os._exit(0)
"""
HOSTILE = {
    "crash": ("1 / 0", "division by zero"),
    "ends": (NODE, "exited by itself"),
    "not Python": ("def", "invalid syntax"),
    "interrupts its parent": (
        "import os, signal, time\nos.kill(os.getppid(), signal.SIGINT)\ntime.sleep(0.5)\n1 / 0",
        "division by zero|not permitted",
    ),
}
SLOW = {
    "endless loop": ("while True: pass", "does not join the ROS graph"),
    "busy node": (NODE + "while True: pass", ""),
    "forks": ("import os\nwhile True:\n    os.fork()", "processes and was stopped"),
    "daemons": (
        DAEMON + "for _ in range(20): daemon(lambda: time.sleep(60))" + NODE + "rclpy.spin(node)",
        "more than 8 processes and was stopped",
    ),
    "output": ("while True: print('x' * 1_000_000)", "printed more than|File too large"),
    "files": (
        (
            "import os, pathlib, time\n"
            "for i in range(40): pathlib.Path(os.environ['HOME'], str(i)).write_bytes(bytes(9 << 20))\n"
            "time.sleep(60)"
        ),
        "wrote more than 100 MB|No space left",
    ),
    "memory": (NODE + "data = []\nwhile True: data.append(bytearray(50_000_000))", "memory|MemoryError|signal"),
    "memory that it shares with itself": (
        (
            "import mmap\ndata = []\nwhile True:\n    data.append(mmap.mmap(-1, 50_000_000))\n"
            "    for i in range(0, 50_000_000, 4096): data[-1][i] = 1\n    data[-1].madvise(mmap.MADV_DONTNEED)\n"
        ),
        "more than 1024 MB of memory",
    ),
    "clock": (
        NODE + "from rosgraph_msgs.msg import Clock\np = node.create_publisher(Clock, '/clock', 10)\nrclpy.spin(node)",
        "publishes on /clock",
    ),
    "clock under the name of the grader": (
        NODE + "from rosgraph_msgs.msg import Clock\nfrom rclpy.executors import SingleThreadedExecutor\n"
        "other = Node('lab_check')\np = other.create_publisher(Clock, '/clock', 10)\nrclpy.spin(node)",
        "publishes on /clock",
    ),
    "publishes without a pause": (
        NODE + "from tf2_msgs.msg import TFMessage\nimport threading\np = node.create_publisher(TFMessage, '/tf', 10)\n"
        "def flood():\n    while True: p.publish(TFMessage())\n"
        "threading.Thread(target=flood, daemon=True).start()\nrclpy.spin(node)",
        "publishes without a pause",
    ),
}
# Writes a report to all files and pipes of the grader that it can open.
FORGERY = """
import glob, json
fact = {"name": "f", "points": 20, "earned": 20, "expected": "", "observed": "", "cause": "", "read": ""}
sheet = {"name": "Static transforms", "file": "static_tf_broadcaster.py", "bonus": False, "earned": 20, "points": 20,
         "problem": "", "last_lines": [], "facts": [fact]}
line = json.dumps({"report": {"folder": "", "variant": None, "earned": 100, "points": 100, "bonus": 0, "notices": [],
                              "criteria": [sheet]}}) + "\\n"
def forge():
    while True:
        paths = ["/tmp/" + name for name in ("result", "result.jsonl")]
        paths += glob.glob("/tmp/coframe-check-*/*") + glob.glob("/proc/[0-9]*/fd/*")
        for stat in glob.glob("/proc/[0-9]*/cmdline"):
            try:
                paths += [word for word in open(stat).read().split("\\0") if "coframe-check-" in word]
            except OSError:
                pass
        for path in paths:
            try:
                if "/fd/" not in path or os.readlink(path).startswith(("pipe", "/tmp/coframe-check-")):
                    with open(path, "a") as file:
                        file.write(line)
            except OSError:
                pass
        time.sleep(0.01)
"""
# Prints what a submission must not see: the secret in a folder of the teacher, and the environment of the grader.
SPY = """
import glob
for path in [{secret!r}, *glob.glob("/proc/[0-9]*/environ")]:
    try:
        print(*[word for word in open(path).read().split("\\0") if "SECRET" in word])
    except OSError as error:
        print(type(error).__name__)
open({target!r}, "w").write("changed")
"""
restricted = pytest.mark.skipif(bool(isolation_problem()), reason="needs network namespaces and Landlock")


def grade_of(folder, grade, program, sentence):
    (folder / "static_tf_broadcaster.py").write_text(program)
    criterion = grade("static")["static_tf_broadcaster.py"]
    assert criterion["earned"] == 0
    assert re.search(sentence, criterion["problem"]), criterion["problem"]
    return criterion


@pytest.mark.parametrize("name", HOSTILE)
def test_programs_that_fail(name, folder, grade):
    grade_of(folder, grade, *HOSTILE[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", SLOW)
def test_programs_without_limits(name, folder, grade):
    grade_of(folder, grade, *SLOW[name])


@pytest.mark.slow
@restricted
def test_a_forged_report_does_not_reach_the_teacher(folder, grade):
    grade_of(folder, grade, f"{DAEMON}{FORGERY}\ndaemon(forge)\n{NODE}\nrclpy.spin(node)", "publishes nothing")


@restricted
def test_other_files_and_the_environment_are_out_of_reach(folder, grade, tmp_path, monkeypatch):
    monkeypatch.setenv("TEACHERS_TOKEN", "SECRET_TOKEN")
    secret, target = tmp_path / "solution.py", tmp_path / "target.py"
    secret.write_text("SECRET_SOLUTION")
    criterion = grade_of(
        folder, grade, SPY.format(secret=str(secret), target=str(target)), "No such file|PermissionError|Read-only"
    )
    assert "SECRET" not in str(criterion)
    assert not target.exists()


@restricted
def test_the_home_folder_of_the_teacher_is_out_of_reach(folder, grade):
    import pwd  # not on Windows

    name = f".coframe-test-{os.getpid()}"
    home = pwd.getpwuid(os.getuid()).pw_dir
    program = f"import os\nopen(os.path.join({home!r}, {name!r}), 'w')"
    grade_of(folder, grade, program, "PermissionError|Read-only|No such file")
    assert not Path(home, name).exists()
    assert not Path("~", name).expanduser().exists()


@pytest.mark.slow
@restricted
def test_a_program_can_write_in_its_own_home_and_start_programs(folder, grade):
    program = folder / "static_tf_broadcaster.py"
    program.write_text(
        "import pathlib, subprocess, sys, tempfile\n"
        "tempfile.TemporaryFile().close()\npathlib.Path.home().joinpath('x').write_text('x')\n"
        "subprocess.run([sys.executable, '-c', 'import numpy'], check=True)\n" + program.read_text()
    )
    assert grade("static")["static_tf_broadcaster.py"]["earned"] == 20


def test_packages_of_the_user_are_found_with_another_home_folder(tmp_path):
    asked = [sys.executable, "-c", "import site; print(site.getusersitepackages())"]
    folders = [subprocess.check_output(asked, env=env) for env in (os.environ, isolated_environment(0, tmp_path))]
    assert folders[0] == folders[1]
