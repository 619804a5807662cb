# SPDX-License-Identifier: Apache-2.0
"""The doctor is the hint for the faulty systems of ``coframe lab break``."""

import json
import subprocess
import sys

import pytest
from click.testing import CliRunner

from coframe.cli.app import app
from coframe.course import _faulty_node as faulty_node
from coframe.course.faults import FAULTS, draw, named_fault

COFRAME = (sys.executable, "-m", "coframe.cli")
CODES = [
    "TF014",
    "TF014",
    "TF008",
    "TF014",
    "TF003",
    "TF013",
    "TF023",
    "TF023",
    "TF023",
    "TF026",
    "TF019",
    "TF019",
    "TF006",
    "TF021",
    "TF002",
    "TF014",
    "TF018",
    "TF008",
    "TF008",
    "TF011",
    "TF020",
    "TF023",
    "TF023",
    "TF023",
    "TF004",
    "TF021",
    "TF014",
    "TF002",
    "TF023",
    "TF026",
]
CODES = dict(enumerate(CODES, 1))

CAUSES = {
    3: "behind the clock on arrival",
    7: "if its quaternion is read as w, x, y, z",
    14: "was 53.85 mm",
    22: "if the angle in the quaternion is halved",
    23: "opposite sign",
    26: "was 90 degrees intended?",
    8: "if the joint positions are used in radians: their values in degrees were used as radians",
}


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
@pytest.mark.parametrize("number", CODES)
def test_the_doctor_finds_the_fault(number):
    with subprocess.Popen([*COFRAME, "lab", "break", str(number)], stdout=subprocess.PIPE, text=True) as system:
        try:
            lines = iter(system.stdout.readline, "")
            assert any("started" in line or "PublishResult" in line for line in lines)
            command = [*COFRAME, "doctor", "--duration", "6s", "--json"]
            report = json.loads(subprocess.run(command, capture_output=True, check=False).stdout)
        finally:
            system.terminate()
    texts = [finding["text"] for finding in report["findings"] if finding["code"] == CODES[number]]
    assert texts
    assert any(CAUSES.get(number, "") in text for text in texts), texts


def test_ctrl_c_during_a_fault_ends_the_node_without_a_traceback(monkeypatch):
    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(faulty_node.time, "sleep", interrupted)
    monkeypatch.setattr(sys, "argv", ["faulty_node", "late", "static_tf_broadcaster"])
    with pytest.raises(SystemExit) as ended:
        faulty_node.main()
    assert ended.value.code == 130


def test_answers_are_understood_in_other_words():
    assert len(FAULTS) == len({fault.name for fault in FAULTS}) == len(CODES) == 30
    for fault in FAULTS:
        for name in (fault.name, *fault.other_names, fault.name.upper(), f"It has a {fault.name}!"):
            assert named_fault(name) is fault, name
    for answer, name in (
        ("two publishers", "second publisher"),
        ("there is a typo in the frame name", "misspelled frame"),
        ("The quaternion is w,x,y,z", "swapped quaternion order"),
        ("clock is 5 s behind", "clock offset"),
        ("degrees", "degrees"),
    ):
        assert named_fault(answer).name == name
    assert named_fault("gremlins") is None


def test_a_seed_draws_the_same_fault_everywhere():
    drawn = [draw(f"{number}") for number in range(300)]
    assert set(drawn) == set(range(1, 31))
    assert [draw("student 1"), draw("student 2")] == [draw("student 1"), draw("student 2")]
    words = ["lab", "break", "--random", "4711", "--answer"]
    fault = FAULTS[draw("4711") - 1]
    assert CliRunner().invoke(app, [*words, fault.name]).output == f"Right: {fault.explanation}\n"
    assert CliRunner().invoke(app, ["lab", "break"]).exit_code == 2
