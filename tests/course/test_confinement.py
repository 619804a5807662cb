# SPDX-License-Identifier: Apache-2.0
"""What a program of a submission can reach, on systems with and without namespaces and Landlock."""

import contextlib
import functools
import json
import os
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from grades import SOLUTION  # of this folder

import coframe
from coframe.course import _confinement as confinement_module
from coframe.course._confinement import Confinement, protection_problem
from coframe.course._view import private_folders, view_of
from coframe.course.checking import check_folder
from coframe.course.isolation import isolated_command, isolation_problem
from coframe.course.sandbox.landlock import landlock_version

pytestmark = pytest.mark.skipif(
    bool(isolation_problem()) or not landlock_version(), reason="needs namespaces, Landlock and seccomp"
)

# Runs a command in which the calls of Landlock do not exist, as in an older kernel.
WITHOUT_LANDLOCK = """
import ctypes, os, struct, sys
rules = [(0x20, 0, 0, 0)]
for number in (444, 445, 446):
    rules += [(0x15, 0, 1, number), (6, 0, 0, 0x50000 | 38)]
code = b"".join(struct.pack("HBBI", *rule) for rule in [*rules, (6, 0, 0, 0x7FFF0000)])
content = ctypes.create_string_buffer(code, len(code))
library = ctypes.CDLL(None)
library.prctl(38, 1, 0, 0, 0)
assert library.prctl(22, 2, struct.pack("HP", len(rules) + 1, ctypes.addressof(content)), 0, 0) == 0
os.execvp(sys.argv[1], sys.argv[1:])
"""
SYSTEMS = {
    "everything": (True, True),
    "without Landlock": (True, False),
    "without namespaces": (False, True),
}
FILTERED = {**SYSTEMS, "with a filter only": (False, False)}
# Prints which of the expressions raise an exception, and which, or their values.
ATTEMPTS = """
import ctypes, json, os, pathlib, signal, socket, subprocess, sys
library = ctypes.CDLL(None, use_errno=True)
def call(name, *words):
    function = getattr(library, name)
    function.restype = ctypes.c_long if name == "syscall" else ctypes.c_int
    words = [ctypes.c_long(word) if isinstance(word, int) else word for word in words]
    if (result := function(*words)) < 0:
        raise OSError(ctypes.get_errno(), name)
    return result
def read(path):
    with open(path, "rb") as file:
        return file.read().decode(errors="replace")
results = {}
for name, expression in json.loads(%r).items():
    try:
        results[name] = str(eval(expression))
    except BaseException as error:
        results[name] = type(error)
results = {name: value if isinstance(value, str) else f"{value.__name__}!" for name, value in results.items()}
print("RESULTS" + json.dumps(results), flush=True)
"""


class Program:
    """Programs in a folder of a student, next to which everything that a teacher has can be placed."""

    def __init__(self, place, has_namespaces, has_landlock):
        self.place = place
        self.folder = place / "class" / "mallory"
        self.folder.mkdir(parents=True)
        self.scratch = place / "scratch"
        self.home = self.scratch / "home" / "program"
        self.home.mkdir(parents=True)
        self.has_namespaces = has_namespaces
        self.prefix = [] if has_landlock else [sys.executable, "-c", WITHOUT_LANDLOCK]
        self.confinement = Confinement(
            self.folder, self.scratch, private_folders(self.folder), has_namespaces=has_namespaces
        )

    def run(self, code):
        """Run a program; return its output."""
        (self.folder / "program.py").write_text(code)
        command = self.confinement.command(self.home, str(self.folder / "program.py"))
        command = [*self.prefix, *(isolated_command(command) if self.has_namespaces else command)]
        environment = self.confinement.environment(self.home)
        return subprocess.run(
            command,
            cwd=self.confinement.working_folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=60,
            check=False,
        ).stdout

    def results(self, **expressions):
        """Return the values of expressions in a program; the name of an exception ends with an exclamation mark."""
        output = self.run(ATTEMPTS % json.dumps(expressions)).decode()
        assert "RESULTS" in output, output
        return json.loads(output.partition("RESULTS")[2].splitlines()[0])

    def refused(self, **expressions):
        """Check that each expression raises an exception."""
        allowed = {name: value for name, value in self.results(**expressions).items() if not value.endswith("Error!")}
        assert allowed == {}


@contextlib.contextmanager
def confined(place):
    """Run programs in a folder on a system that has everything."""
    made = Program(place, *SYSTEMS["everything"])
    with made.confinement:
        yield made


@pytest.fixture(params=FILTERED, scope="module")
def filtered(request, programs):
    """As `program`, also on a system that has neither namespaces nor Landlock."""
    return programs(request.param)


@pytest.fixture(params=SYSTEMS, scope="module")
def program(request, programs):
    """Run programs of a student, while the teacher works in the folder of the class, and has a home."""
    return programs(request.param)


@pytest.fixture(scope="module")
def programs(tmp_path_factory):
    """Return a function that prepares each system once: this takes longer than most programs."""
    with contextlib.ExitStack() as opened:

        @functools.cache
        def on(system):
            place = tmp_path_factory.mktemp("place")
            (place / "teacher").mkdir()
            with pytest.MonkeyPatch.context() as patch:
                patch.setenv("HOME", str(place / "teacher"))
                patch.chdir(place)
                made = Program(place, *FILTERED[system])
            opened.enter_context(made.confinement)
            return made

        yield on


def test_files_of_others_are_out_of_reach(program):
    (program.place / "teacher" / ".ssh").mkdir()
    (program.place / "class" / "zoe").mkdir()
    files = [program.place / name for name in ("key", "teacher/.ssh/id_rsa", "class/zoe/node.py")]
    files += [program.folder / ".." / "zoe" / "copy.py"]
    for file in files:
        file.write_text("SECRET")
    (program.folder / "link").symlink_to(program.place / "key")
    paths = [*files, program.folder / "link", Path("/proc/1/environ"), Path("/proc/1/mem")]
    program.refused(**{str(path): f"read({str(path)!r})" for path in paths})
    program.refused(
        current="open('x', 'w')",
        root="open('/x', 'w')",
        system="open('/etc/x', 'w')",
        kernel="open('/proc/sys/kernel/hostname', 'w').write('x')",
        shared="open('/dev/shm/x', 'w')",
        temporary="open('/tmp/x', 'w')",
        terminal="open('/dev/tty')",
    )


@pytest.mark.skipif(os.name != "posix" or os.getuid() != 0, reason="only the superuser can read these files")
def test_secrets_of_the_system_are_out_of_reach_of_programs_of_the_superuser(program):
    secrets = [path for path in Path("/etc").rglob("*") if path.is_file() and not path.stat().st_mode & 0o004]
    assert secrets
    results = program.results(**{str(path): f"read({str(path)!r})" for path in secrets})
    assert {path: value for path, value in results.items() if value and not value.endswith("Error!")} == {}
    assert "root" in program.results(users="read('/etc/passwd')")["users"]


def test_sockets_outside_cannot_be_reached(filtered, monkeypatch):
    program = filtered
    monkeypatch.chdir(program.folder)
    with socket.socket(socket.AF_UNIX) as outside, socket.socket(socket.AF_UNIX) as abstract:
        outside.bind("s")  # an absolute path may be too long for a socket
        outside.listen()
        abstract.bind(f"\0coframe-{os.getpid()}")
        abstract.listen()
        program.refused(
            path="(s := socket.socket(socket.AF_UNIX)).connect('s')",
            abstract=f"socket.socket(socket.AF_UNIX).connect('\\0coframe-{os.getpid()}')",
            datagrams="socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)",
            pair="socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)",
            raw_pair="socket.socketpair(socket.AF_UNIX, socket.SOCK_RAW)",
            raw="socket.socket(socket.AF_INET, socket.SOCK_RAW, 1)",
            packets="socket.socket(17, socket.SOCK_RAW)",
            machines="socket.socket(40, socket.SOCK_STREAM)",
            ciphers="socket.socket(38, socket.SOCK_SEQPACKET)",
        )


def test_memory_that_no_limit_counts_is_refused(filtered):
    program = filtered
    program.refused(
        file="os.memfd_create('x')",
        system_v="call('shmget', 0x5a5a, 1 << 20, 0o1666)",
        semaphores="call('semget', 0x5a5a, 1, 0o1666)",
        queue="call('msgget', 0x5a5a, 0o1666)",
        posix_queue="call('mq_open', b'/x', 0o102, 0o600, None)",
        key="call('syscall', 248, b'user', b'x', b'y', 1, -4)" if os.uname().machine == "x86_64" else "1 / 0",
    )
    assert "0x00005a5a" not in Path("/proc/sysvipc/shm").read_text()


def test_a_program_has_no_privileges(filtered):
    program = filtered
    status = program.results(status="read('/proc/self/status')")["status"].splitlines()
    values = {line.partition(":")[0]: line.split()[-1] for line in status}
    assert {name: int(value, 16) for name, value in values.items() if name.startswith("Cap")} == dict.fromkeys(
        ("CapInh", "CapPrm", "CapEff", "CapBnd", "CapAmb") if os.getuid() == 0 or program.has_namespaces else (), 0
    ) or not (os.getuid() == 0 or program.has_namespaces)
    assert (values["NoNewPrivs"], values["Seccomp"]) == ("1", "2")
    program.refused(
        namespace="call('unshare', 0x10000000)",
        clone="call('syscall', 56 if os.uname().machine == 'x86_64' else 220, 0x10000000 | 17, 0, 0, 0, 0)",
        mount="call('mount', b'x', b'/tmp', b'tmpfs', 0, None)",
        chroot="os.chroot('/')",
        host="socket.sethostname('x')",
        user="os.setuid(65534 if os.getuid() == 0 else 0)",
        ring="call('syscall', 425, 4, None)",
        newer="call('syscall', 600)",
        x32="call('syscall', 0x40000000 | 39)",
    )


@pytest.mark.skipif(os.name != "posix" or os.getuid() != 0, reason="only the superuser can become another user")
def test_a_program_of_the_superuser_runs_as_another_user(tmp_path):
    with confined(tmp_path / "open") as made:
        tasks = "__import__('resource').getrlimit(__import__('resource').RLIMIT_NPROC)[1]"
        found = made.results(user="os.getuid()", group="os.getgid()", groups="os.getgroups()", tasks=tasks)
        assert found == {"user": "64000", "group": "64000", "groups": "[]", "tasks": "1024"}
        assert made.results(home="pathlib.Path.home().joinpath('x').write_text('x')")["home"] == "1"
    with confined(tmp_path / "closed") as made:
        (made.folder / "program.py").touch()
        for path in (made.folder, made.folder / "program.py"):
            os.chown(path, 4321, 4322)
            path.chmod(0o700)
        assert made.results(user="(os.getuid(), os.getgid())")["user"] == "(4321, 4322)"
    with confined(tmp_path / "own") as made:
        made.folder.chmod(0o700)
        assert made.results(user="os.getuid()")["user"] == "0"


def test_the_grader_cannot_be_changed(filtered):
    """Without namespaces, the parent of the program is this test, as the grader would be."""
    program = filtered
    before = (os.getpriority(os.PRIO_PROCESS, 0), os.sched_getaffinity(0))
    targets = (1, "os.getppid()", os.getpid())
    for number, target in enumerate(targets):
        program.refused(
            **{
                f"priority {number}": f"os.setpriority(os.PRIO_PROCESS, {target} or 1, 19)",
                f"processors {number}": f"os.sched_setaffinity({target} or 1, {{0}})",
                f"limit {number}": f"__import__('resource').prlimit({target} or 1, 7, (3, 3))",
                f"trace {number}": f"call('ptrace', 16, {target} or 1, None, None)",
            }
        )
    program.refused(user="os.setpriority(os.PRIO_USER, 0, 19)")
    assert before == (os.getpriority(os.PRIO_PROCESS, 0), os.sched_getaffinity(0))


def test_the_grader_cannot_be_ended(filtered):
    """This test is the grader; it is not the first process of the namespaces of a program."""
    program = filtered
    output = program.run(
        "import os, signal\n"
        f"for target in (-1, {os.getpid()}, {-os.getpgid(0)}, os.getppid(), -os.getppid()):\n"
        "    try:\n"
        "        target and os.kill(target, signal.SIGTERM)\n"
        "    except OSError as error:\n"
        "        print(error)\n"
    )
    assert output.count(b"not permitted") + output.count(b"No such process") >= 3, output


# Each line uses a solution; it may not print it.
USES = {
    "import": "from coframe.lab.static_tf_broadcaster import main; print('SOLUTION')",
    "caught import": "try: import coframe.lab.tf_listener; print('SOLUTION')\nexcept ImportError: pass",
    "silent import": "try: import coframe.lab.tf_listener; print('SOLUTION')\nexcept Exception: pass",
    "criteria": "from coframe.course._motion import joint_angles; print('SOLUTION')",
    "importlib": "import importlib; importlib.import_module('coframe.' + 'la' + 'b.tf_listener'); print('SOLUTION')",
    "runpy": "import runpy; runpy.run_module('coframe.lab.tf_listener'); print('SOLUTION')",
    "reading": "import coframe; print('SOLUTION', open({package!r} + '/lab/tf_listener.py').read())",
    "compiled": "import glob; [print('SOLUTION', open(p, 'rb').read()) for p in glob.glob({package!r} + '/*/*/tf_l*')]",
    "description": "print('SOLUTION', open({package!r} + '/lab/two_link_arm.urdf.xacro').read())",
    "child": "import subprocess, sys; subprocess.run([sys.executable, '-I', '-m', 'coframe.lab.tf_listener'])",
    "script": "import subprocess, sys; subprocess.run([sys.prefix + '/bin/static_tf_broadcaster'], timeout=20)",
    "shell": "import subprocess; subprocess.run(['cat', {package!r} + '/lab/tf_listener.py'])",
    "no variable": "import os; del os.environ['COFRAME_GRADED']\nimport coframe.lab.tf_listener; print('SOLUTION')",
}
# Uses that print no sign of an attempt, which only the decoys of a system with namespaces report.
SILENT = {"compiled", "script", "shell", "no variable"}


@pytest.mark.parametrize("use", USES)
def test_solutions_in_coframe_cannot_be_used_and_attempts_are_reported(use, program):
    package = next(path for path in coframe.__path__ if Path(path, "lab").is_dir())
    output = program.run(USES[use].format(package=package))
    assert b"SOLUTION\n" not in output
    assert b"class " not in output
    reported = program.confinement.attempt(output)
    if program.has_namespaces and use != "compiled":  # There are no compiled files then.
        assert "which contains solutions" in reported
    elif use not in SILENT:
        assert reported.startswith("The program imports coframe.")


def test_other_installations_and_compiled_files_are_hidden(tmp_path, monkeypatch):
    from coframe.course._solutions import solution_folders

    (tmp_path / "packages" / "coframe" / "lab").mkdir(parents=True)
    monkeypatch.syspath_prepend(tmp_path / "packages")
    monkeypatch.setattr(sys, "pycache_prefix", str(tmp_path / "compiled"))
    folders = solution_folders()
    assert str(tmp_path / "packages" / "coframe" / "lab") in folders
    lab = next(path for path in folders if path.endswith("coframe/lab") and str(tmp_path) not in path)
    assert f"{tmp_path}/compiled{lab}" in folders
    entries = dict(view_of(tmp_path / "own", [], folders).entries)
    assert entries[lab] is False
    assert entries[str(tmp_path / "packages" / "coframe" / "lab")] is False


def test_an_environment_in_the_current_folder_does_not_expose_the_folder(tmp_path, monkeypatch):
    """As `python -m venv .` makes it; a student's folder can also contain the environment."""
    for name in ("lib/python3/coframe/lab", "bin", "solutions", "class/mallory", "mine/.venv/lib/coframe/lab"):
        (tmp_path / name).mkdir(parents=True)
    monkeypatch.setattr(sys, "prefix", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    own = tmp_path / "class" / "mallory"
    lab = tmp_path / "lib" / "python3" / "coframe" / "lab"
    entries = dict(view_of(own, private_folders(own), [str(lab)]).entries)
    below = {path.removeprefix(f"{tmp_path}/"): value for path, value in entries.items() if str(tmp_path) in path}
    assert below == {"bin": True, "class/mallory": True, "lib": True, "lib/python3/coframe/lab": False}
    own = tmp_path / "mine"
    lab = own / ".venv" / "lib" / "coframe" / "lab"
    monkeypatch.setattr(sys, "prefix", str(own / ".venv"))
    entries = dict(view_of(own, private_folders(own), [str(lab)]).entries)
    assert (entries[str(own)], entries[str(lab)]) == (True, False)


def test_rights_of_honest_programs(program):
    (program.folder / "mesh.stl").write_text("solid")
    (program.folder / "helper.py").write_text("VALUE = 7")
    results = program.results(
        arrays="__import__('numpy').zeros(3).sum()",
        ros="__import__('rclpy').__name__ + __import__('tf2_ros').__name__",
        mesh="read('mesh.stl')",
        helper="__import__('helper').VALUE",
        home="pathlib.Path.home().joinpath('x').write_text('x')",
        temporary="__import__('tempfile').TemporaryFile().write(b'x')",
        child="subprocess.check_output([sys.executable, '-c', 'import numpy; print(5)'])",
        thread="[t := __import__('threading').Thread(target=print), t.start(), t.join()][2]",
        loop="__import__('asyncio').run(__import__('asyncio').sleep(0, 'done'))",
        pair="socket.socketpair()[0].family",
        internet="socket.socket(socket.AF_INET, socket.SOCK_DGRAM).family",
        interfaces="socket.if_nameindex()[0][1]",
        null="open('/dev/null', 'w').write('x')",
        random="len(open('/dev/urandom', 'rb').read(8))",
        own="os.kill(os.getpid(), 0)",
        priority="os.nice(1)",
    )
    assert {name: value for name, value in results.items() if value.endswith("!")} == {}
    assert (results["arrays"], results["mesh"], results["helper"]) == ("0.0", "solid", "7")


def test_a_name_of_a_folder_does_not_widen_what_can_be_read(tmp_path, monkeypatch):
    """A colon separates paths in variables, and a folder of a student can contain one, or a new line."""
    secret = tmp_path / "secret"
    secret.mkdir()
    (secret / "file").write_text("SECRET")
    monkeypatch.chdir(tmp_path)
    for name in (f"a:{secret}", 'new\nline"quote', "x" * 200):
        with confined(tmp_path / "class" / name.lstrip("/")) as made:
            made.refused(secret=f"read({str(secret / 'file')!r})")
            assert made.results(own="len(read('program.py')) > 10")["own"] == "True"


def test_a_program_is_ended_with_all_its_processes(program, eventually):
    """The processes of a program end with it, in whatever session they are."""
    name = f"sleeper-{os.getpid()}-{time.monotonic_ns()}"
    code = "import os, sys, time\nfor _ in range(3):\n    if os.fork() == 0:\n        os.setsid()\n        "
    code += f"os.execv('/bin/sleep', [{name!r}, '100'])\n"
    if not program.has_namespaces:
        pytest.skip("the grader looks for them, see test_hostile.py")
    program.run(code)
    eventually(lambda: not any(name.encode() in each for each in command_lines()))


def command_lines():
    found = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            found.append(path.read_bytes())
        except OSError:
            continue
    return found


def test_what_a_system_cannot_protect_is_said(monkeypatch):
    assert protection_problem(has_namespaces=True) == ""
    assert "reach the network" in protection_problem(has_namespaces=False)
    monkeypatch.setattr(confinement_module, "landlock_version", lambda: 0)
    monkeypatch.setattr(confinement_module, "can_filter", lambda: False)
    monkeypatch.setattr(confinement_module, "scopes_signals", lambda: False)
    assert "Unix sockets" in protection_problem(has_namespaces=True)
    for words in (
        "read and modify your files",
        "solutions in coframe.lab",
        "signals to your processes",
        "Unix sockets",
    ):
        assert words in protection_problem(has_namespaces=False)


@pytest.mark.slow
def test_a_check_without_namespaces_says_so_in_its_report(folder, monkeypatch):
    monkeypatch.setenv("PATH", "/nowhere")
    from coframe.course import isolation

    isolation._unshare.cache_clear()
    try:
        report = check_folder(folder, only=("static", "urdf"))
    finally:
        monkeypatch.undo()
        isolation._unshare.cache_clear()
    assert (report["earned"], report["bonus"]) == (20, 10)
    assert "namespaces" in report["notices"][0]


ORDINARY_USER = ["unshare", "--user", "--map-user=1000", "--map-group=1000"]


@pytest.mark.slow
@pytest.mark.skipif(
    subprocess.run([*ORDINARY_USER, "true"], capture_output=True, check=False).returncode != 0
    if sys.platform == "linux"
    else True,
    reason="cannot become an ordinary user",
)
def test_an_ordinary_user_is_protected_as_well(folder):
    hostile = (
        "import os, socket\ntry:\n    socket.socket(socket.AF_UNIX)\nexcept OSError: pass\nelse: print('SOCKET')\n"
    )
    hostile += "print('PROCESSES', [x for x in os.listdir('/proc') if x.isdigit()])\n"
    hostile += f"print('CHECKOUT', os.path.exists({str(SOLUTION)!r}))\nimport coframe.lab\n"
    (folder / "tf_listener.py").write_text(hostile)
    command = [sys.executable, "-m", "coframe.cli", "lab", "check", str(folder), "--json"]
    command += ["--only", "static", "--only", "listener"]
    result = subprocess.run([*ORDINARY_USER, *command], capture_output=True, text=True, timeout=110, check=False)
    assert result.returncode == 0, result.stderr
    report = json.loads(result.stdout)
    static, listener = report["criteria"]
    assert (report["notices"], static["earned"], listener["earned"]) == ([], 20, 0)
    assert "imports coframe.lab, which contains solutions" in listener["problem"]
    assert "PROCESSES ['1', '2']" in listener["last_lines"]
    assert "CHECKOUT False" in listener["last_lines"]
    assert "SOCKET" not in listener["last_lines"]
