# SPDX-License-Identifier: Apache-2.0
"""The search for users' messages: what it reads, what switches it off, and that it fails in one way only."""

import os
import shutil
import socket
import sys
from pathlib import Path

import pytest
from strangers import HOSTILE

PROGRAM = "from found_msgs.msg import A\nprint(A())\n"
FOUND = "found_msgs.msg.A(number=3)\n"
needs_root = pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can give files away")


@pytest.fixture
def workspace(tmp_path, write):
    """A folder with a program and messages, and a home folder for the settings."""
    files = {"found_msgs/msg/A.msg": "uint8 number 3\n", "program.py": PROGRAM, "home/empty.txt": ""}
    return write(tmp_path / "workspace", files)


@pytest.fixture
def run(installed, workspace, proof):
    def started(*words, cwd=workspace, **variables):
        home = str(workspace / "home")
        variables = {"HOME": home, "XDG_CONFIG_HOME": home, "PROOF_OF_EXECUTION": str(proof), **variables}
        return installed.run(*words, cwd=cwd, **variables)

    return started


def test_a_script_and_a_session_find_messages_in_their_folder(run, workspace, tmp_path):
    assert run(workspace / "program.py", cwd=tmp_path).stdout == FOUND
    assert run("-c", PROGRAM).stdout == FOUND


@pytest.mark.parametrize("flag", ["-I", "-P", "PYTHONSAFEPATH"])
def test_isolated_and_safe_paths_switch_the_search_off(run, workspace, flag):
    if flag == "-P" and sys.version_info < (3, 11):
        pytest.skip("Python 3.10 has no -P")
    variables = {flag: "1"} if not flag.startswith("-") else {}
    done = run(*([flag] if not variables else []), workspace / "program.py", **variables)
    assert "No module named 'found_msgs'" in done.stderr
    assert "searches no other one, because Python was started with -I, -P or PYTHONSAFEPATH" in done.stderr
    given = {**variables, "COFRAME_INTERFACES": str(workspace)}
    assert run(*([flag] if not variables else []), workspace / "program.py", **given).returncode == 1


def test_an_installed_command_does_not_search_the_current_folder(run, workspace, installed):
    command = installed.python.parent / "some_command"
    command.write_text(PROGRAM)
    try:
        done = run(command)
        assert "No module named 'found_msgs'" in done.stderr
        assert str(workspace) not in done.stderr
        assert run(command, COFRAME_INTERFACES=str(workspace)).stdout == FOUND
    finally:
        command.unlink()


@needs_root
@pytest.mark.parametrize("owned", ["found_msgs", "found_msgs/msg", "found_msgs/msg/A.msg"])
def test_files_of_other_users_are_skipped_with_a_sentence(run, workspace, owned):
    workspace.chmod(0o1777)
    shutil.chown(workspace / owned, "nobody")
    done = run("-c", PROGRAM + "import found_msgs.msg")
    assert "No module named 'found_msgs'" in done.stderr
    sentence = (
        f"coframe: {workspace / owned} is skipped in the search for interface packages because it belongs to the "
    )
    assert done.stderr.count(sentence + "user nobody. If you trust") == 1
    assert run("-c", PROGRAM, COFRAME_INTERFACES=str(workspace)).stdout == FOUND


@needs_root
def test_root_by_sudo_may_use_the_files_of_the_user(run, workspace):
    shutil.chown(workspace / "found_msgs", 4321)
    assert "the user with the number 4321" in run("-c", PROGRAM).stderr
    assert run("-c", PROGRAM, SUDO_UID="4321").stdout == FOUND


@pytest.mark.parametrize("content", [b"\0" * 300, b"\xff\xfe/\n", b"a\0b\n" * 1000, b"x" * (2 << 20)])
def test_a_damaged_settings_file_does_not_damage_imports(run, workspace, content):
    settings = workspace / "home/coframe/interfaces.txt"
    settings.parent.mkdir()
    settings.write_bytes(content)
    done = run("-c", "try:\n    import nothing.msg\nexcept ImportError as error:\n    print(type(error).__name__)")
    assert done.stdout == "ModuleNotFoundError\n", done.stderr
    assert len(done.stderr.splitlines()) <= 1
    assert run("-c", "import copy, json\ntry:\n    import nothing\nexcept ImportError:\n    pass").stderr == ""
    assert run("-c", PROGRAM).stdout == FOUND


@pytest.mark.parametrize("special", ["pipe", "device", "folder", "loop", "socket"])
@pytest.mark.parametrize(
    "place", ["found_msgs/package.xml", "found_msgs/msg/A.msg", "home/coframe/interfaces.txt", "other/package.xml"]
)
def test_only_regular_files_are_opened(run, workspace, special, place):
    path = workspace / place
    path.parent.mkdir(exist_ok=True)
    path.unlink(missing_ok=True)
    (workspace / "other/msg").mkdir(parents=True, exist_ok=True)
    (workspace / "other/msg/B.msg").touch()
    make_special(path, special)
    code = (
        "try:\n    from found_msgs.msg import A\nexcept Exception as error:\n    print(error)\nelse:\n    print(A())\n"
    )
    done = run("-c", code)
    assert done.returncode == 0, done.stderr
    if place in {"home/coframe/interfaces.txt", "other/package.xml"}:
        assert done.stdout == FOUND
    elif place.endswith(".msg"):
        assert "cannot" in done.stdout or "No module named" in done.stdout


def make_special(path, kind):
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    elif kind == "folder":
        path.mkdir()
    elif kind == "loop":
        path.symlink_to(path)
    else:
        here = Path.cwd()
        os.chdir(path.parent)  # The names of sockets are short.
        try:
            with socket.socket(socket.AF_UNIX) as one:
                one.bind(path.name)
        finally:
            os.chdir(here)


def test_an_unexpected_error_of_the_search_is_an_import_error(run):
    code = """
import coframe.interfaces.sources as sources
def fail(*_):
    raise RecursionError("too deep")
sources.find_folder = fail
for name in ("strange.msg", "strange_msgs.msg"):
    try:
        __import__(name)
    except ImportError as error:
        print(error.name)
"""
    done = run("-c", code)
    assert done.stdout == "strange\nstrange_msgs\n", done.stderr
    assert done.stderr == "coframe: the search for interface packages failed: RecursionError: too deep\n"


def test_code_beside_messages_is_not_imported(run, workspace, proof, write):
    write(workspace, {"found_msgs/found_msgs/helpers.py": HOSTILE, "found_msgs/found_msgs/msg.py": HOSTILE})
    assert run("-c", PROGRAM).stdout == FOUND
    assert "No module named 'found_msgs.helpers'" in run("-c", PROGRAM + "import found_msgs.helpers").stderr
    assert not proof.exists()
