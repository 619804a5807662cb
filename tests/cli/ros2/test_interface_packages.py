# SPDX-License-Identifier: Apache-2.0
"""`coframe interface` about the user's own packages: what it prints about packages, definitions and mistakes."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from coframe.cli.app import app
from coframe.messages import packages, registry


@pytest.fixture(autouse=True)
def _workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    folder = tmp_path / "ws/src/my_msgs"
    for name, text in {
        "package.xml": "<package><name>cli_msgs</name></package>",
        "msg/Num.msg": "int64 num\nfloat64[3] v\nstd_msgs/Header header\n",
        "srv/Ask.srv": "string lambda\n---\nNum[] nums\n",
        "action/Num.action": "---\n---\nuint8 DONE=1\n",
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(Path(sys.executable).parent)  # as for an installed command
    for variable in ("XDG_CONFIG_HOME", "XDG_CACHE_HOME"):
        monkeypatch.setenv(variable, str(tmp_path / variable))
    for variable in ("COFRAME_INTERFACES", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(variable, raising=False)
    packages.forget()
    yield
    packages.forget()
    for name in [name for name in registry.classes if name.startswith("cli_msgs/")]:
        del registry.classes[name]


def run(*words: str) -> Any:
    return CliRunner().invoke(app, ["interface", *words])


def test_added_folders_are_listed_and_removed(tmp_path: Path) -> None:
    result = run("check")
    assert result.stdout.startswith("None of your packages were found. Searched: no folder\n")
    assert "visualization_msgs" in result.stdout
    result = run("add", "ws/src")
    assert (result.exit_code, result.stderr) == (0, "")
    assert f"cli_msgs: 1 msg, 1 srv, 1 action, in {tmp_path}/ws/src/my_msgs\n" in result.stdout
    assert f"Stubs of 1 package written into {tmp_path}/XDG_CACHE_HOME/coframe/stubs\n" in result.stdout
    listed = f"cli_msgs: 1 msg, 1 srv, 1 action, in {tmp_path}/ws/src/my_msgs (coframe interface add)"
    assert run("check").stdout.startswith(listed)
    assert run("remove", "ws").stderr == f"coframe: {tmp_path}/ws was not added\n  Added: {tmp_path}/ws/src.\n"
    assert run("remove", "ws/src").exit_code == 0
    packages.forget()
    assert "None of your packages were found" in run("check").stdout


def test_the_origin_of_a_definition_is_shown_on_request(tmp_path: Path) -> None:
    run("add", "ws/src")
    shown = run("show", "cli_msgs/Num", "--origin").stdout
    assert shown.startswith(f"# cli_msgs/msg/Num, {tmp_path}/ws/src/my_msgs/msg/Num.msg\n# RIHS01_")
    assert "\nint64 num\nfloat64[3] v\nstd_msgs/Header header\n\tbuiltin_interfaces/Time stamp\n" in shown
    assert run("show", "std_msgs/msg/String", "--origin", "--no-comments").stdout.splitlines() == [
        "# std_msgs/msg/String, contained in coframe",
        "# RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
        "string data",
    ]
    listed = run("package", "cli_msgs").stdout.splitlines()
    assert sorted(listed) == ["cli_msgs/action/Num", "cli_msgs/msg/Num", "cli_msgs/srv/Ask"]
    assert run("show", "cli_msgs/msg/Nun").stderr.startswith("coframe: Unknown type 'cli_msgs/msg/Nun'\n")


def test_invalid_definitions_are_reported_with_file_and_line(tmp_path: Path) -> None:
    folder = tmp_path / "ws/src/my_msgs/msg"
    (folder / "Bad.msg").write_text("int num\n")
    (folder / "Unknown.msg").write_text("uint8 a\nPose pose\n")
    result = run("add", "ws/src")
    assert result.exit_code == 1
    assert f"coframe: {folder}/Bad.msg, line 1: no type 'int'; use int32 or int64, in: int num\n" in result.stderr
    assert f"coframe: {folder}/Unknown.msg, line 2: field 'pose': no type cli_msgs/msg/Pose" in result.stderr
    assert "(Did you mean geometry_msgs/Pose or turtlesim/Pose or turtlesim_msgs/Pose?)" in result.stderr
    assert run("check").exit_code == 1
    assert run("add", "nowhere").stderr.startswith(f"coframe: There is no folder {tmp_path}/nowhere.\n")
    (tmp_path / "empty").mkdir()
    assert "no package with .msg, .srv, .action or .idl files in" in run("add", "empty").stderr


@pytest.mark.parametrize("command", ["check", "add", "stubs"])
@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("a/b/c", "There is no folder"),
        (os.devnull, "is a device, a pipe or a socket, not a folder."),
        ("pipe", "is a device, a pipe or a socket, not a folder."),
        ("ws/src/my_msgs/msg/Num.msg", "is a file, not a folder."),
        ("gone", "There is no folder"),
    ],
)
def test_paths_that_are_no_folder_are_named_for_what_they_are(
    tmp_path: Path, command: str, path: str, text: str
) -> None:
    if not hasattr(os, "mkfifo"):
        pytest.skip("no named pipes")
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "gone").symlink_to("nowhere")
    result = run(command, path)
    assert (result.exit_code, text in result.stderr) == (1, True), result.stderr
    assert "Give the folder of a program or of an interface package" in result.stderr


@pytest.mark.slow
def test_mypy_knows_the_fields_from_the_stubs(tmp_path: Path) -> None:
    run("add", "ws/src")
    assert run("stubs", "--output", "typings").exit_code == 0
    lines = [
        "from cli_msgs.action import Num as CountTo",
        "from cli_msgs.msg import Num",
        "from cli_msgs.srv import Ask",
        "Num(num=1, v=[1.0, 2.0, 3.0]).header.frame_id = 'map'",
        "Num(number=1)  # wrong",
        "Num().num = 'one'  # wrong",
        "x: float = Ask.Response(nums=[Num()]).nums[0].v[0]",
        "CountTo.Feedback.DONE + 'one'  # wrong",
    ]
    (tmp_path / "script.py").write_text("\n".join(lines))
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", str(tmp_path / "c")]
    environment = {"MYPYPATH": "typings", "PATH": "/usr/bin:/bin"}
    done = subprocess.run([*command, "script.py"], capture_output=True, text=True, check=False, env=environment)
    found = {int(line.split(":")[1]) for line in done.stdout.splitlines() if ": error:" in line}
    assert found == {5, 6, 8}, done.stdout + done.stderr
