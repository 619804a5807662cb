# SPDX-License-Identifier: Apache-2.0
"""Every example in the README, the docs and the public docstrings is run."""

import doctest
import importlib
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest
import typer

import coframe
from coframe.cli.app import app

ROOT = Path(__file__).parents[1]
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def blocks(document, language):
    return re.findall(rf"^```{language}\n(.*?)^```", document.read_text(), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("document", [d for d in DOCUMENTS if blocks(d, "python")], ids=lambda d: d.name)
@pytest.mark.usefixtures("domain_id")
def test_python_examples_run_and_print_what_they_say(document, capsys):
    pytest.importorskip("dds_library", reason="some examples join the ROS graph")
    source = "\n".join(blocks(document, "python"))
    exec(compile(source, document.name, "exec"), {"__name__": document.name})  # the examples of one page go together
    printed = capsys.readouterr().out.splitlines()
    promised = re.findall(r"print\(.*\) +# (.*)", source)
    for line, promise in zip(printed, promised, strict=False):
        assert line.startswith(promise.removesuffix("...").rstrip()), f"prints {line!r}, the page says {promise!r}"


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda d: d.name)
def test_commands_and_links_exist(document):
    text = document.read_text()
    makefile = (ROOT / "Makefile").read_text()
    for target in re.findall(r"\bmake ([a-z-]+)\b", "\n".join(re.findall(r"`[^`\n]+`", text))):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), f"{document.name} names make {target}"
    for link in re.findall(r"\]\(([^)#:]+)\)", text):
        assert (document.parent / link).exists(), f"{document.name} links to {link}"
    commands = typer.main.get_command(app).commands
    for command in re.findall(r"`coframe ([a-z0-9]+)", text):
        assert command in commands, f"{document.name} names coframe {command}"


def test_figures_of_the_handbook_are_current():
    command = [sys.executable, ROOT / "scripts" / "handbook_figures.py", "--check"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def test_the_steps_of_the_architecture_exist():
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    steps = re.findall(r"`([\w/]+\.\w+)`: `(\w+)`", text)
    assert len(steps) > 20
    for path, name in steps:
        source = (ROOT / path).read_text(encoding="utf-8")
        assert re.search(rf"\b{name}\b", source), f"{path} has no {name}"


def public_modules():
    # Where coframe is installed for editing, its path also has the folder above, in which it is once more.
    folder = str(Path(coframe.__file__).parent)
    names = [module.name for module in pkgutil.walk_packages([folder], "coframe.")]
    return [name for name in names if not re.search(r"generated|__main__|\.ros\b|_core|\.lab\b", name)]


@pytest.mark.parametrize("name", ["coframe", *public_modules()])
def test_docstring_examples(name):
    module = importlib.import_module(name)
    if name == "coframe":
        for public in coframe.__all__:
            getattr(coframe, public)  # doctest finds functions that are imported on first use only after that
    assert doctest.testmod(module).failed == 0


def test_everything_public_is_exported_and_documented():
    for name in coframe.__all__:
        thing = getattr(coframe, name)
        assert name == "__version__" or thing.__doc__, f"coframe.{name} has no docstring"


def test_importing_coframe_needs_numpy_only():
    """On a machine with the core install alone; joining the graph then says what to install."""
    code = """
import sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {"typer", "rich", "typing_extensions", "rosbags", "mcap", "yaml"}:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Missing())
import coframe
coframe.Buffer().set("a", "b", coframe.Transform(), static=True)
try:
    coframe.connect()
except coframe.WireError as error:
    print(error, error.hint)
import coframe.cli
coframe.cli.main()
"""
    absent = {**os.environ, "COFRAME_DDS_LIBRARY": "/absent/libddsc.so"}
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=absent)
    assert "Use one of these ways: " in result.stdout
    assert "pip install 'coframe[cli]'" in result.stderr
    assert "Traceback" not in result.stderr
