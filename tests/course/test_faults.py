# SPDX-License-Identifier: Apache-2.0
"""The doctor is the hint for the faulty systems of ``coframe lab break``."""

import json
import subprocess
import sys

import pytest

from coframe.course import _faulty_node as faulty_node

COFRAME = (sys.executable, "-m", "coframe.cli")
CODES = dict(enumerate(("TF014", "TF014", "TF008", "TF014", "TF003", "TF013", "TF023", "TF023", "TF023", "TF026"), 1))

CAUSES = {
    3: "behind the clock on arrival",
    7: "if its quaternion is read as w, x, y, z",
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
