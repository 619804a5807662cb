# SPDX-License-Identifier: Apache-2.0
"""What Windows and macOS do not have, on Linux: no module needs it, and only functions that check first use it."""

import ast
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import coframe
from coframe import Transform
from coframe._files import complete_files
from coframe._process.own_group import own_group
from coframe.buffer import frozen

SOURCES = Path(__file__).parents[2] / "src"

# Not on Windows; the second list is on Linux only.
POSIX = """
os.fork os.forkpty os.geteuid os.getgid os.getuid os.kill os.killpg os.mkfifo os.openpty os.pread os.pwrite os.setsid
os.setuid os.statvfs os.sysconf os.uname os.register_at_fork os.O_NOFOLLOW os.O_NONBLOCK os.O_CLOEXEC os.O_DIRECTORY
signal.SIGKILL signal.SIGHUP signal.SIGQUIT signal.SIGUSR1 signal.SIGALRM signal.pthread_kill signal.pthread_sigmask
signal.setitimer signal.alarm socket.AF_UNIX socket.SO_REUSEPORT
"""
LINUX = "os.O_PATH os.sched_getaffinity os.sched_setaffinity os.memfd_create os.eventfd os.pidfd_open os.unshare"
POSIX_MODULES = {"fcntl", "grp", "pty", "pwd", "resource", "termios", "tty"}

# Each with the reason for which it is not reached on the systems that do not have it.
ALLOWED = {
    "coframe/_files/temporary_folders.py": "returns before on Windows",
    "coframe/_process/keys.py": "catches the ImportError",
    "coframe/_process/signal_handlers.py": "checks with hasattr",
    "coframe/bags/storage.py": "checks with hasattr",
    "coframe/buffer/dispatcher.py": "checks with hasattr",
    "coframe/connection/shared_transforms.py": "shared transforms are for Linux only",
    "coframe/course/_processes.py": "checks os.name",
    "coframe/course/_program.py": "checks os.name",
    "coframe/course/_view.py": "catches the ImportError",
    "coframe/course/isolation.py": "returns before on other systems than Linux",
    "coframe/interfaces/ownership.py": "returns before on Windows",
    "coframe/lab/run_node.py": "checks with hasattr",
    "coframe/robots/xacro_process.py": "is started on POSIX only",
    "coframe/system/network.py": "catches the AttributeError",
    "coframe/viewer/server/_connections.py": "returns before on Windows",
    "coframe/wire/participant.py": "checks with hasattr",
    "coframe/workspace/entry_point.py": "checks os.name",
    "ros/launch/actions/running_process.py": "checks sys.platform",
}
ALLOWED_FOLDER = "coframe/course/sandbox/"  # Linux's sandbox: isolation.py


def uses(path):
    """Yield the lines of a module that use what Windows does not have, with its name."""
    names = {*POSIX.split(), *LINUX.split()}
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            if f"{node.value.id}.{node.attr}" in names:
                yield node.lineno, f"{node.value.id}.{node.attr}"
        elif isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names if alias.name in POSIX_MODULES)
        elif isinstance(node, ast.ImportFrom) and node.module in POSIX_MODULES:
            yield node.lineno, node.module
        elif isinstance(node, ast.keyword) and node.arg in {"start_new_session", "preexec_fn", "pass_fds"}:
            yield node.lineno, node.arg


def test_only_modules_that_check_first_use_what_windows_does_not_have():
    found = {}
    for path in sorted(SOURCES.rglob("*.py")):
        name = path.relative_to(SOURCES).as_posix()
        if "/generated/" in name or name.startswith(ALLOWED_FOLDER):
            continue
        if lines := list(uses(path)):
            found[name] = lines
    assert {name: lines for name, lines in found.items() if name not in ALLOWED} == {}
    assert sorted(set(ALLOWED) - set(found)) == [], "these need no exception"


IMPORT_ALL = """
import importlib, os, pkgutil, signal, socket, sys
platform, posix, modules = sys.argv[1], sys.argv[2].split(), sys.argv[3].split(",")
import coframe, rclpy
from coframe.workspace.ros_folders import ros_folder
packages = [("coframe.", coframe.__path__[0])]
folders = [path for path in sorted(ros_folder().iterdir()) if (path / "__init__.py").is_file()]
packages += [(f"{path.name}.", str(path)) for path in folders]

def import_all():
    failed = {}
    for prefix, folder in packages:
        names = [prefix[:-1], *(each.name for each in pkgutil.walk_packages([folder], prefix, onerror=lambda _: None))]
        for name in names:
            if "__main__" in name or name.endswith((".start", ".keep_alive", ".xacro_process")) or ".sandbox" in name:
                continue
            try:
                importlib.import_module(name)
            except BaseException as error:
                failed[name] = f"{type(error).__name__}: {error}"
    return failed

before = import_all()  # with the standard library and all packages, which have other files for other systems
own = tuple(prefix for prefix, _ in packages)
for name in [name for name in sys.modules if f"{name}.".startswith(own) and not name.startswith("coframe._core")]:
    del sys.modules[name]
for name in posix:
    module, _, attribute = name.partition(".")
    if hasattr(sys.modules[module], attribute):
        delattr(sys.modules[module], attribute)
for name in modules if platform == "win32" else ():
    sys.modules[name] = None
sys.platform = platform
after = import_all()
for name in sorted(after.keys() - before.keys()):
    print(name, after[name])
print(sum(f"{name}.".startswith(own) for name in sys.modules))
"""


@pytest.mark.slow
@pytest.mark.parametrize("platform", ["win32", "darwin"])
def test_every_module_can_be_imported_elsewhere(platform):
    # The owners of files are asked for only if os.name is "posix", which pathlib needs here.
    posix = [name for name in POSIX.split() if name != "os.geteuid"]
    missing = [*LINUX.split(), *(posix if platform == "win32" else ())]
    command = [sys.executable, "-W", "ignore", "-c", IMPORT_ALL, platform, " ".join(missing), ",".join(POSIX_MODULES)]
    *failed, imported = subprocess.check_output(command, text=True).splitlines()
    assert failed == []
    assert int(imported) > 900


def test_children_of_windows_have_a_group_of_their_own(monkeypatch):
    monkeypatch.setattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0x200, raising=False)
    assert own_group() == {"start_new_session": True}
    monkeypatch.setattr(sys, "platform", "win32")
    assert own_group() == {"creationflags": 0x200}


# A node that handles SIGTERM, where os.kill ends a process at once as on Windows.
NODE = """
import signal, sys, time

def leave(number, frame):
    print("left", flush=True)
    sys.exit()

signal.signal(signal.SIGTERM, leave)
print("ready", flush=True)
while True:
    time.sleep(0.01)
"""
AS_ON_WINDOWS = """
import os, signal, sys
del signal.pthread_kill
os.kill = lambda *_: os._exit(1)
from coframe.lab import run_node
run_node.main()
"""


@pytest.mark.parametrize("start", ["from coframe.lab import run_node; run_node.main()", AS_ON_WINDOWS])
def test_a_node_leaves_in_order_when_its_launcher_closes_its_input(tmp_path, start):
    (tmp_path / "polite_node.py").write_text(NODE)
    process = subprocess.Popen(
        [sys.executable, "-c", start, "polite_node"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        text=True,
    )
    assert process.stdout.readline() == "ready\n"
    assert process.communicate(timeout=60)[0] == "left\n"
    assert process.returncode == 0


def test_a_file_that_another_program_has_open_is_replaced_when_it_is_closed(tmp_path, monkeypatch):
    attempts, rename = [], Path.replace

    def replace(path, target):
        attempts.append(path)
        if len(attempts) < 4:
            raise PermissionError(13, "The process cannot access the file", str(path))
        return rename(path, target)

    monkeypatch.setattr(Path, "replace", replace)
    with pytest.raises(PermissionError):
        complete_files.write_complete(tmp_path / "out.txt", b"text")
    attempts.clear()
    monkeypatch.setattr(sys, "platform", "win32")
    complete_files.write_complete(tmp_path / "out.txt", b"text")
    assert [path.name for path in tmp_path.iterdir()] == ["out.txt"]
    assert (tmp_path / "out.txt").read_bytes() == b"text"


def test_a_file_that_is_never_closed_is_an_error(tmp_path, monkeypatch):
    def replace(path, _target):
        raise PermissionError(13, "The process cannot access the file", str(path))

    monkeypatch.setattr(Path, "replace", replace)
    monkeypatch.setattr(complete_files, "_PATIENCE", 0.05)
    monkeypatch.setattr(sys, "platform", "win32")
    with pytest.raises(PermissionError) as caught:
        complete_files.write_complete(tmp_path / "out.txt", b"text")
    assert caught.value.filename == str(tmp_path / "out.txt")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="no list of mapped files")
@pytest.mark.parametrize("platform", ["linux", "win32"])
def test_windows_maps_no_file_so_that_it_can_be_replaced(tmp_path, monkeypatch, platform):
    monkeypatch.setattr(frozen, "MAX_COPIED", 100)
    monkeypatch.setattr(sys, "platform", platform)
    buffer, path = coframe.Buffer(), tmp_path / "robot.cfz"
    buffer.set("odom", "base_link", Transform([1, 2, 3]), 1_000_000_000)
    buffer.save(path)
    loaded = coframe.load(path)
    assert loaded.lookup("odom", "base_link").x == 1
    assert (str(path) in Path("/proc/self/maps").read_text()) == (platform == "linux")


def test_no_signal_of_posix_is_missing_here():
    assert signal.SIGKILL == 9  # which modules write as a number
