# SPDX-License-Identifier: Apache-2.0
"""The middleware is selected by variables, by `--wire`, and by what is installed."""

import json
import os
import subprocess
import sys

import click
import pytest
from click.testing import CliRunner
from zenoh_router import Router

from coframe._process import python_children
from coframe._process.python_children import child_environment, python_environment
from coframe.cli.app import app
from coframe.errors import WireError
from coframe.wire import selection
from coframe.wire.dds.library import Place

COFRAME = [sys.executable, "-c", "from coframe.cli import main; main()"]


def test_variables_select_the_middleware() -> None:
    assert selection.select({"COFRAME_WIRE": "zenoh"}).wire == "zenoh"
    assert selection.select({"RMW_IMPLEMENTATION": "rmw_zenoh_cpp"}).wire == "zenoh"
    assert selection.select({"COFRAME_WIRE": "dds", "RMW_IMPLEMENTATION": "rmw_zenoh_cpp"}).wire == "dds"
    with pytest.raises(WireError, match=r"COFRAME_WIRE is 'ros': it must be dds.* or zenoh"):
        selection.select({"COFRAME_WIRE": "ros"})


@pytest.mark.parametrize(("installed", "wire"), [(True, "zenoh"), (False, "dds")])
def test_without_a_dds_library_zenoh_is_used_if_it_is_installed(
    monkeypatch: pytest.MonkeyPatch, installed: bool, wire: str
) -> None:
    monkeypatch.setattr(selection, "load_plugins", lambda *_: iter(()))
    monkeypatch.setattr("coframe.wire.dds.library.places", lambda _: iter([Place("the system", "/usr/lib", None)]))
    monkeypatch.setattr("coframe.wire.zenoh._library.is_installed", lambda: installed)
    assert selection.select({}).wire == wire


def parsed(name: str, *words: str) -> click.Context:
    """Return the context of a command whose arguments have been read."""
    return app.commands[name].make_context(name, list(words), parent=click.Context(app, info_name="coframe"))


def test_the_option_chooses_the_middleware(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COFRAME_WIRE", "dds")
    monkeypatch.setattr(selection, "_command_line_choice", {})
    monkeypatch.setattr(python_children, "_passed_variables", {})
    assert parsed("lookup", "a", "--wire", "zenoh", "b").params["names"] == ("a", "b")
    assert selection.select() == ("zenoh", "--wire is given")
    assert os.environ["COFRAME_WIRE"] == "dds", "a choice for this process does not change its environment"
    assert python_environment()["COFRAME_WIRE"] == "zenoh", "the processes that it starts use the same middleware"
    assert child_environment({"COFRAME_WIRE": "mine"})["COFRAME_WIRE"] == "mine", "unless they are given another one"
    assert parsed("run", "--wire=dds", "pkg", "exe").params["package"] == "pkg"
    assert selection.select().wire == "dds"
    for words in (["pkg", "exe", "--wire", "zenoh"], ["--", "pkg", "exe", "--wire", "zenoh"]):
        assert parsed("run", *words).args == ["--wire", "zenoh"], "the arguments of an executable are its own"
    assert selection.select().wire == "dds"
    with pytest.raises(click.BadParameter, match=r"'foo' is not dds.* or zenoh"):
        parsed("hub", "--wire", "foo")


def test_the_doctor_reports_the_router(router: Router, zenoh_domain: int) -> None:
    command = [*COFRAME, "doctor", "--system", "--json", "--domain", str(zenoh_domain), "--duration", "1s"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    report = json.loads(done.stdout)
    assert report["wire"] == ["zenoh", "COFRAME_WIRE is set"]
    assert report["zenoh"]["connect"] == [router.endpoint]
    assert len(report["zenoh"]["routers"]) == 1
    assert report["probe"] is None
    assert [finding["severity"] for finding in report["findings"]] == ["note"]  # RMW_IMPLEMENTATION is not set


def test_commands_join_over_zenoh(zenoh_domain: int, node, monkeypatch: pytest.MonkeyPatch) -> None:
    assert node.full_name == "/robot1/tester"
    monkeypatch.delenv("COFRAME_WIRE")
    command = [*COFRAME, "node", "info", "/robot1/tester", "--wire", "zenoh"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("/robot1/tester")
    assert zenoh_domain


def test_a_wrong_value_is_one_sentence() -> None:
    done = CliRunner().invoke(app, ["echo", "--wire", "ros", "a", "b"])
    assert done.exit_code == 2
    assert f"Invalid value for '--wire': 'ros' is not {selection.alternatives()}." in done.output


def test_help_lists_the_option_only_for_commands_that_join_the_graph() -> None:
    for words, listed in ((["echo"], True), (["topic", "list"], True), (["bag", "info"], False)):
        assert ("--wire" in CliRunner().invoke(app, [*words, "--help"]).stdout) is listed
