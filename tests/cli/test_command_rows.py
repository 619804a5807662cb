# SPDX-License-Identifier: Apache-2.0
"""Each command has one row, and what the row says is true."""

import importlib
import importlib.metadata
import inspect
import pkgutil
import re
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

import coframe.cli
from coframe._process.optional_imports import EXTRAS, extra_of, pip_install
from coframe.cli.app import app
from coframe.cli.command_line import CommandLine
from coframe.cli.commands import COMMANDS, joins_graph
from coframe.wire.selection import alternatives

try:
    import tomllib
except ImportError:  # Python 3.10
    tomllib = None

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "src"
# Commands that join without --domain and --spin-time: they start nodes as processes, or wait for one server.
WITHOUT_OPTIONS = {("launch",), ("run",), ("service", "call"), ("action", "send_goal")}
# The decorator text_options combines these options to one argument, text_format.
TEXT_OPTIONS = {"csv", "full_length", "truncate_length", "no_arr", "no_str", "flow_style"}
# These modules start the nodes of the lab, which import ROS packages, as processes.
LAUNCHERS = {"coframe.lab.launcher", "coframe.course.running"}


def leaves(command=app, path=()):
    """Yield the words that call each command, and the command."""
    if path and not isinstance(command, click.Group):
        yield path, command
    for name, inner in getattr(command, "commands", {}).items():
        yield from leaves(inner, (*path, name))


LEAVES = dict(leaves())


def modules():
    prefix = "coframe.cli."
    return [each.name for each in pkgutil.walk_packages(coframe.cli.__path__, prefix) if "__main__" not in each.name]


@pytest.mark.parametrize("name", modules())
def test_every_command_of_a_module_has_a_row(name):
    module = importlib.import_module(name)
    reachable = {id(command) for command in [*LEAVES.values(), *app.commands.values()]}
    commands = {
        each: value
        for each, value in vars(module).items()
        if isinstance(value, click.Command) and not isinstance(value, CommandLine) and each in module.__all__
    }
    missing = [each for each, command in commands.items() if id(command) not in reachable]
    assert not missing, f"{', '.join(missing)} in {name} has no row in coframe/cli/commands.py"


@pytest.mark.parametrize("name", COMMANDS)
def test_rows_are_complete(name):
    row = COMMANDS[name]
    assert re.fullmatch(r"[A-Z].{10,60}\.", row.line)
    assert app.commands[name].name == name
    assert set(row.extras) <= set(EXTRAS) - {"cli"}
    assert len(set(row.extras)) == len(row.extras)
    if not isinstance(row.graph, bool):
        assert row.graph <= set(app.commands[name].commands)


@pytest.mark.parametrize("path", LEAVES, ids=" ".join)
def test_commands_that_join_the_graph_have_the_option_wire(path):
    command = LEAVES[path]
    names = {name for parameter in command.params for name in parameter.opts}
    if path == ("static",):  # reads its own options
        names = set(re.findall(r"--[a-z-]+", CliRunner().invoke(app, ["static", "--help"]).output))
    joins = bool({"--domain", "--spin-time"} & names) or path in WITHOUT_OPTIONS or path[0] == "lab"
    assert joins_graph(path) == joins, f"the row of {path[0]} says otherwise"
    assert ("--wire" in CliRunner().invoke(app, [*path, "--help"], prog_name="coframe").output) == joins
    if joins:
        result = CliRunner().invoke(app, [*path, "--wire", "pigeons"], prog_name="coframe")
        assert result.exit_code == 2
        assert f"'pigeons' is not {alternatives()}." in result.output


@pytest.fixture(scope="module")
def imports():
    grimp = pytest.importorskip("grimp", reason="the imports are read by grimp")
    if tomllib is None:
        pytest.skip("needs tomllib")
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    packages = settings["root_packages"]
    return grimp.build_graph(*packages, exclude_type_checking_imports=True, cache_dir=None), {*packages} - {"coframe"}


@pytest.mark.parametrize("name", COMMANDS)
def test_only_commands_that_say_so_stand_on_ros_packages(name, imports):
    graph, ros_packages = imports
    needed = graph.find_upstream_modules(f"coframe.cli.{COMMANDS[name].module}")
    found = {each for each in needed if each.partition(".")[0] in ros_packages} | (needed & LAUNCHERS)
    assert bool(found) == COMMANDS[name].ros, sorted(found)[:3]


@pytest.mark.parametrize("path", LEAVES, ids=" ".join)
def test_every_declared_parameter_is_a_parameter_of_the_function(path):
    command = LEAVES[path]
    accepted = set(inspect.signature(inspect.unwrap(command.callback)).parameters) - {"context"}
    if "text_format" in accepted:
        accepted = accepted - {"text_format"} | TEXT_OPTIONS
    assert accepted == {parameter.name for parameter in command.params if parameter.expose_value}


@pytest.mark.skipif(tomllib is None, reason="needs tomllib")
@pytest.mark.parametrize("extra", EXTRAS)
def test_the_extras_are_those_of_the_package(extra):
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    assert set(EXTRAS) == set(declared) - {"all", "dev"}
    required = {re.match(r"[\w.-]+", line)[0].lower() for line in declared[extra]}
    distributions = importlib.metadata.packages_distributions()
    for module in EXTRAS[extra]:
        if module in distributions:
            assert required & {each.lower() for each in distributions[module]}, f"{module} is not in {extra}"
    assert len(EXTRAS[extra]) == len(required)


def test_the_extra_of_a_command_is_preferred():
    assert extra_of("yaml") == "bags"
    assert extra_of("yaml", ("viewer", "dds")) == "viewer"
    assert extra_of("left_pad") is None
    with pytest.raises(ValueError, match="coframe has no extra 'bag'"):
        pip_install("bag")


def test_how_to_install_an_extra_is_written_once():
    texts = {path: path.read_text(encoding="utf-8") for path in SOURCES.rglob("*.py")}
    places = [path.name for path, text in texts.items() if re.search(r"pip install '?coframe\[(?!all)", text)]
    assert places == ["optional_imports.py"]
