# SPDX-License-Identifier: Apache-2.0
"""Commands print hostile names and texts of files and of the graph without control characters, line by line."""

import json
import os
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest
from cases import LIVE, OWN_TEXT_ONLY, RECORDED
from click.testing import CliRunner
from hostile_names import NAMES, NEWLINE, problems

import coframe
from coframe.bags import Writer
from coframe.cli.app import app
from coframe.messages import find, serialize

# XML cannot contain ESC, but these.
URDF = """<robot name="{0}"><link name="{0}"/><link name="{0}tip"/><joint name="{0}turn" type="continuous">
<parent link="{0}"/><child link="{0}tip"/><limit lower="0" upper="1"/></joint>{1}</robot>"""
NAME_IN_XML = "esc&#x202e;&#x9b;2J&#10;two&#10;forged line"


def commands(command, path=()):
    """Yield the path of each command, such as "bag info"."""
    for name, inner in getattr(command, "commands", {}).items():
        yield from commands(inner, (*path, name))
    if not hasattr(command, "commands"):
        yield " ".join(path)


def test_every_command_has_a_case():
    every = set(commands(app))
    assert every == LIVE.keys() | RECORDED.keys() | OWN_TEXT_ONLY.keys()
    assert not OWN_TEXT_ONLY.keys() & (LIVE.keys() | RECORDED.keys())


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A recording, robot descriptions and other files with hostile names."""
    folder = tmp_path_factory.mktemp("hostile")
    with Writer(folder / "run.mcap") as writer:
        topic = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        texts = writer.add_topic("/text", "std_msgs/msg/String")
        for second in range(1, 4):
            moment = coframe.Buffer()
            for name in NAMES:
                moment.set("map", name, coframe.Transform(), second * 10**9)
                writer.write(texts, serialize(find("std_msgs/msg/String")(data=name)), second * 10**9)
            writer.write(topic, moment.encode(static=False), received=second * 10**9)
    (folder / "robot.urdf").write_text(URDF.format(NAME_IN_XML, ""))
    (folder / "broken.urdf").write_text(URDF.format(NAME_IN_XML, f"<link name='{NAME_IN_XML}'/>"))
    (folder / "parameters.yaml").write_text(f"/talker:\n  ros__parameters:\n    {NEWLINE!r}: 1\n    evil: x\n")
    required = "".join(f"- {{parent: map, child: {json.dumps(f'{name}x')}}}\n" for name in NAMES)
    (folder / "contract.yaml").write_text(f"transforms:\n{required}")
    (folder / "hostile.launch.xml").write_text(
        f"<launch><node pkg='{NAME_IN_XML}' exec='x'/><log message='{NAME_IN_XML}'/></launch>"
    )
    return {
        "{bag}": folder / "run.mcap",
        "{urdf}": folder / "robot.urdf",
        "{broken_urdf}": folder / "broken.urdf",
        "{parameters}": folder / "parameters.yaml",
        "{contract}": folder / "contract.yaml",
        "{launch_file}": folder / "hostile.launch.xml",
    }


def filled(words, files, folder):
    words = [str(files.get(word, word)) for word in words]
    return [word.replace("{output}", str(folder / "output")) for word in words]


def each(table, quick=()):
    """Return the cases as parameters; those of other than quick commands are slow."""
    return [
        pytest.param(case, id=f"{command}-{number}", marks=() if command in quick else pytest.mark.slow)
        for command, cases in table.items()
        for number, case in enumerate(cases)
    ]


@pytest.mark.parametrize("case", each(RECORDED, quick={"frames", "doctor", "why", "lookup", "bag info"}))
def test_texts_of_files(files, tmp_path, case):
    result = CliRunner().invoke(app, filled(case.words, files, tmp_path))
    assert result.exit_code in {0, 1, 2}, result.exception
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert problems(result.output, is_data=case.is_data) == []


@pytest.fixture(scope="module")
def graph(claim_domain):
    """A process with hostile nodes in its own domain; the environment of its neighbors."""
    pytest.importorskip("dds_library", reason="nodes are found over DDS")
    program = [sys.executable, str(Path(__file__).with_name("hostile_node.py"))]
    with claim_domain() as domain:
        environment = {**os.environ, "ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        with subprocess.Popen(program, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            assert process.stdout.readline() == b"ready\n"
            yield environment
            process.stdin.close()


@pytest.mark.parametrize(
    "words", [["node", "list"], ["topic", "list", "-t"], ["lookup", "map", NEWLINE, "--duration", "5s"]]
)
def test_names_on_the_graph(graph, monkeypatch, words):
    for name, value in graph.items():
        monkeypatch.setenv(name, value)
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output[-1000:]
    assert problems(result.output) == []


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals in Python")
@pytest.mark.parametrize("in_terminal", [True, False], ids=["terminal", "pipe"])
@pytest.mark.parametrize("case", each(LIVE))
def test_texts_of_the_graph(graph, files, tmp_path, case, in_terminal):
    from terminal import run

    words = filled(case.words, files, tmp_path)
    output, code = run(words, graph, until=case.until, in_terminal=in_terminal)
    assert code in {0, 1, 2, 130}, (code, output[-1000:])
    assert problems(output, is_data=case.is_data, is_text=case.is_text) == []
    assert case.until in output


class _Tags(HTMLParser):
    """The names of all elements of a page."""

    def __init__(self):
        super().__init__()
        self.found = set()

    def handle_starttag(self, tag, _attributes):
        self.found.add(tag)


IMAGE, TWO = (f"{{bag}}:map:{name}" for name in ("<img src=x onerror=alert(1)>", NEWLINE))


@pytest.mark.parametrize(
    ("words", "suffixes"),
    [
        (["frames", "{bag}"], [".svg", ".gv", ".mmd", ".md", ".json"]),
        (
            ["plot", "{bag}", *(f"map:{name}.x" for name in ("<img src=x onerror=alert(1)>", NEWLINE))],
            [".html", ".svg"],
        ),
        (["compare", IMAGE, TWO], [".html", ".svg", ".csv", ".json"]),
    ],
    ids=["frames", "plot", "compare"],
)
def test_files_that_commands_write(files, tmp_path, words, suffixes):
    written = [tmp_path / f"out{suffix}" for suffix in suffixes]
    command = [word.replace("{bag}", str(files["{bag}"])) for word in words]
    result = CliRunner().invoke(app, [*command, *(word for file in written for word in ("-o", str(file)))])
    assert result.exit_code == 0, result.output[-1000:]
    for file in written:
        text = file.read_text(encoding="utf-8")
        assert not {*"\x1b\x07\x9b\u202e"} & {*text}, file.name
        if file.suffix != ".html":  # where a line end is a space
            assert not [line for line in text.splitlines() if "forged line" in line and "two" not in line], file.name
        if file.suffix == ".svg":
            assert "img" not in {element.tag.rpartition("}")[2] for element in ElementTree.fromstring(text).iter()}
        if file.suffix in {".html", ".md"}:
            tags = _Tags()
            tags.feed(text)
            assert "img" not in tags.found
