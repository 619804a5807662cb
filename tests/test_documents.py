# SPDX-License-Identifier: Apache-2.0
"""Every example in the README, the docs and the public docstrings is run."""

import doctest
import importlib
import importlib.metadata
import importlib.util
import itertools
import json
import os
import pkgutil
import re
import shlex
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import click
import pytest
from click.testing import CliRunner
from document_blocks import BLOCK, DOCUMENTS, ROOT, all_blocks, blocks, name_of

import coframe
from coframe.cli.app import app

RUN, CHECKED, PARSED, SHOWN = {"python"}, {"console", "bash"}, {"yaml", "json", "xml"}, {"text"}
COMMAND_LINE = app
# Programs of others in the examples. What coframe provides is checked.
OTHER_PROGRAMS = {
    "apt",
    "apt-get",
    "cd",
    "docker",
    "export",
    "git",
    "openssl",
    "pip",
    "ros2",
    "rviz2",
    "source",
    "uv",
    "xcode-select",
}
# Where other distributions add something; not modules.
ENTRY_POINT_GROUPS = {f"coframe.{name}" for name in ("checks", "commands", "messages", "middlewares", "recordings")}


def with_blocks(*languages):
    documents = [document for document in DOCUMENTS if blocks(document, languages)]
    return pytest.mark.parametrize("document", documents, ids=name_of)


@with_blocks(*RUN)
@pytest.mark.usefixtures("domain_id")
def test_python_examples_run_and_print_what_they_say(document, capsys):
    pytest.importorskip("dds_library", reason="some examples join the ROS graph")
    source = "\n".join(block.text for block in blocks(document, RUN))
    exec(compile(source, document.name, "exec"), {"__name__": document.name})  # the examples of one page go together
    printed = capsys.readouterr().out.splitlines()
    promised = re.findall(r"print\(.*\) +# (.*)", source)
    for line, promise in zip(printed, promised, strict=False):
        assert line.startswith(promise.removesuffix("...").rstrip()), f"prints {line!r}, the page says {promise!r}"


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_no_block_is_skipped_without_a_reason(document):
    text = document.read_text(encoding="utf-8")
    found = list(all_blocks(document))
    assert len(found) * 2 == len(re.findall(r"^[ \t]*```", text, re.MULTILINE)), (
        "a block is not closed as it was opened"
    )
    for block in found:
        known = block.language in RUN | CHECKED | PARSED | SHOWN
        assert known or block.reason, f"{block.language or 'no language'}: no test handles {block.text[:60]!r}"
    assert text.count("<!-- not run:") == sum(bool(block.reason) for block in found), "a reason is not above a block"


def test_most_blocks_are_run_or_checked():
    found = [block for document in DOCUMENTS for block in all_blocks(document)]
    tested = [block for block in found if block.language in RUN | CHECKED | PARSED and not block.reason]
    assert len(tested) > 130
    assert len([block for block in found if block.reason]) <= 4


@with_blocks(*CHECKED)
def test_commands_of_shell_examples_exist(document):
    for block in blocks(document, CHECKED):
        for line in block.text.replace("\\\n", " ").splitlines():
            words = shlex.split(re.sub(r"^\$ ", "", line), comments=True)
            while words and re.match(r"\w+=", words[0]):  # a variable of the environment
                words = words[1:]
            if words:
                assert (problem := problem_of_command(words)) == "", f"{line}: {problem}"


def problem_of_command(words):
    """Return what is wrong with a command that coframe or Python provides; "" if it exists."""
    program, *arguments = words
    if program == "coframe":
        return problem_of_coframe(arguments)
    if program == "make":
        targets = re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
        return "" if not arguments or arguments[0] in targets or "=" in arguments[0] else "no such target"
    if program == "python" and arguments[0] == "-m":
        return "" if arguments[1] in {"pip", "venv"} or importlib.util.find_spec(arguments[1]) else "no such module"
    if program == "pip" and "install" in arguments:
        extras = set(re.findall(r"^(\w+) = \[", (ROOT / "pyproject.toml").read_text("utf-8"), re.MULTILINE))
        named = {extra for word in arguments for each in re.findall(r"\[([\w,]+)\]", word) for extra in each.split(",")}
        return f"no extra {named - extras}" if named - extras else ""
    scripts = {entry.name for entry in importlib.metadata.distribution("coframe").entry_points}
    return "" if program in OTHER_PROGRAMS | scripts | {"python"} else "unknown program"


def problem_of_coframe(arguments):
    command, path = COMMAND_LINE, ["coframe"]
    while arguments and hasattr(command, "commands") and not arguments[0].startswith("-"):
        if arguments[0] not in command.commands:
            return f"no command {arguments[0]}"
        path.append(arguments[0])
        command, arguments = command.commands[arguments[0]], arguments[1:]
    # After --ros-args, the words are those of a node.
    options = {word.partition("=")[0] for word in itertools.takewhile(lambda word: word != "--ros-args", arguments)}
    context = click.Context(command, info_name=path[-1])
    known = {option for each in command.get_params(context) for option in (*each.opts, *each.secondary_opts)}
    if command.context_settings.get("ignore_unknown_options"):  # It parses them itself; its help lists them.
        text = CliRunner().invoke(COMMAND_LINE, [*path[1:], "--help"]).output
        known |= set(re.findall(r"(?<![\w-])--?[a-zA-Z][\w-]*", text))
    wrong = [word for word in options if re.match(r"--?[a-zA-Z]", word) and word not in known]
    return f"no option {', '.join(wrong)}" if wrong else ""


@with_blocks(*PARSED)
def test_data_in_examples_is_valid(document):
    yaml = pytest.importorskip("yaml")
    for block in blocks(document, {"yaml"}):
        assert yaml.safe_load(block.text)
    for block in blocks(document, {"json"}):
        assert json.loads(block.text)
    for block in blocks(document, {"xml"}):
        assert ElementTree.fromstring(block.text) is not None


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_commands_and_links_exist(document):
    text = document.read_text(encoding="utf-8")
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for target in re.findall(r"\bmake ([a-z-]+)\b", "\n".join(re.findall(r"`[^`\n]+`", text))):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), f"{document.name} names make {target}"
    prose = BLOCK.sub("", text)
    for link in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", prose):
        assert (document.parent / link).exists(), f"{document.name} links to {link}"
    for command in re.findall(r"`coframe ([^`]+)`", prose):
        words = [word for word in shlex.split(command) if word != "..."]
        assert problem_of_coframe(words) == "", f"{document.name} names coframe {command}"


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_names_in_the_text_exist(document):
    prose = BLOCK.sub("", document.read_text(encoding="utf-8"))
    for name in re.findall(r"`(coframe(?:\.\w+)+)(?:\([^`]*\))?`", prose):
        assert name in ENTRY_POINT_GROUPS or exists(name), f"{document.name} names {name}"


def exists(name):
    """Return whether a dotted name is that of a module, or of something in one."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for part in parts[length:]:
            if not hasattr(found, part):
                return False
            found = getattr(found, part)
        return True
    return False


@pytest.mark.parametrize("script", ["handbook_figures.py", "conventions_figures.py"])
def test_figures_are_current(script):
    command = [sys.executable, ROOT / "scripts" / script, "--check"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr


def test_the_steps_of_the_architecture_exist():
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    steps = re.findall(r"`([\w/]+\.\w+)`: `(\w+)`", text)
    assert len(steps) > 20
    for path, name in steps:
        source = (ROOT / path).read_text(encoding="utf-8")
        assert re.search(rf"\b{name}\b", source), f"{path} has no {name}"


def test_every_page_is_in_the_navigation_of_the_site():
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:\n")[2]
    for page in (ROOT / "docs").rglob("*.md"):
        path = page.relative_to(ROOT / "docs")
        folder = re.search(rf"\s{re.escape(path.parent.as_posix())}/$", text, re.MULTILINE)
        named = re.search(rf"\s{re.escape(path.as_posix())}$", text, re.MULTILINE)
        assert folder or named, f"add docs/{path} to the navigation in mkdocs.yml"


def test_reference_contains_every_public_name():
    pages = "\n".join(page.read_text("utf-8") for page in (ROOT / "docs" / "reference" / "api").glob("*.md"))
    shown = set(re.findall(r"^::: ([\w.]+)$", pages, re.MULTILINE))
    for name in coframe.__all__:
        assert name == "__version__" or f"coframe.{name}" in shown, (
            f"docs/reference/api does not contain coframe.{name}"
        )
    for module in coframe._PUBLIC_MODULES:
        assert f"coframe.{module}" in shown, f"docs/reference/api does not contain coframe.{module}"


def public_modules():
    # Where coframe is installed for editing, its path also has the folder above, in which it appears again.
    folder = str(Path(coframe.__file__).parent)
    names = [module.name for module in pkgutil.walk_packages([folder], "coframe.")]
    return [name for name in names if not re.search(r"generated|__main__|\.ros\b|_core|\.lab\b", name)]


@pytest.mark.parametrize("name", ["coframe", *public_modules()])
def test_docstring_examples(name):
    module = importlib.import_module(name)
    if name == "coframe":
        for public in coframe.__all__:
            getattr(coframe, public)  # doctest finds functions that are imported on first use only after that
    elif ">>>" not in Path(module.__file__).read_text("utf-8"):
        return  # the search for docstrings takes longer than the import
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
        if name.partition(".")[0] in {"click", "rich", "typing_extensions", "rosbags", "mcap", "yaml"}:
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
    assert "Use one of these options: " in result.stdout
    assert "pip install 'coframe[cli]'" in result.stderr
    assert "Traceback" not in result.stderr
