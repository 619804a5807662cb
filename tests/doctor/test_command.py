"""The command: texts, JSON, SARIF, exit codes, pages."""

import json
import subprocess
import sys

import pytest
from recordings import START
from runs import Run
from typer.testing import CliRunner

from coframe.cli.app import app
from coframe.doctor import codes


def command(*arguments):
    result = subprocess.run(
        [sys.executable, "-m", "coframe.cli", "doctor", *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Traceback" not in result.stderr
    return result


@pytest.fixture
def ill(tmp_path):
    run = Run.healthy(seconds=2, skip={"scan", "static"})
    run.tf("base_lnk", "lidar", START, (0.1, 0, 0), static=True)
    return run.write(tmp_path)


def test_one_finding_a_line_then_why_and_what_to_do(ill):
    result = command(ill)
    assert result.returncode == 1
    first, why, fix, *_ = result.stdout.splitlines()
    assert first.startswith("TF001 warning: 2 trees: ")
    assert first.endswith("; first stamp 1700000000.000000000")
    assert why.startswith("      why: A look-up between frames of two trees never succeeds")
    assert fix.startswith(
        "      do:  In the node that sends 'base_lnk', change the line to t.header.frame_id = 'base_link'"
    )


def test_healthy_and_left_out(ill, tmp_path):
    assert command(ill, "--ignore", "TF001").returncode == 0
    (tmp_path / "good").mkdir()
    result = command(Run.healthy(seconds=2).write(tmp_path / "good"))
    assert result.returncode == 0
    assert result.stdout.startswith("healthy: 101 transforms of 2 links, 3 frames in 1 tree, 1 sensor, ")


def test_json_on_standard_output_alone(ill):
    result = command(ill, "--json")
    data = json.loads(result.stdout)
    assert result.returncode == 1
    assert not data["healthy"]
    (finding,) = data["findings"]
    assert finding["code"] == "TF001"
    assert finding["first_stamp_ns"] == START
    assert set(data["trees"]) == {"odom", "base_lnk"}


def test_sarif_has_a_rule_for_every_code_and_a_result_for_every_finding(ill):
    data = json.loads(command(ill, "--sarif").stdout)
    assert data["version"] == "2.1.0"
    (run,) = data["runs"]
    rules = run["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == list(codes())
    (result,) = run["results"]
    assert (result["ruleId"], result["level"]) == ("TF001", "warning")
    assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].endswith("run.mcap")


def test_a_page_is_printed():
    result = command("--explain", "tf012")
    assert result.returncode == 0
    assert result.stdout.startswith("# TF012: Time jumped back\n\n## Why it matters\n")


@pytest.mark.parametrize(
    ("arguments", "code", "text"),
    [
        (["--explain", "TF999"], 2, "there is no page for 'TF999'"),
        (["--ignore", "TF999"], 2, "there is no check 'TF999'"),
        (["nowhere.mcap"], 1, "nowhere.mcap cannot be read"),
        (["--duration", "soon"], 2, "--duration"),
        (["--json", "--sarif"], 2, "exclude each other"),
    ],
)
def test_wrong_usage_is_a_sentence(arguments, code, text):
    result = CliRunner().invoke(app, ["doctor", *arguments])
    assert result.exit_code == code
    assert text in result.output
