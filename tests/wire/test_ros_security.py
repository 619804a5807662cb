# SPDX-License-Identifier: Apache-2.0
"""Security that ROS 2's environment variables request, on middlewares without it."""

import logging
import os
import subprocess
import sys

import pytest

from coframe.errors import WireError
from coframe.wire import Participant, ros_security

ENABLED = {"ROS_SECURITY_ENABLE": "true"}
ENFORCED = {**ENABLED, "ROS_SECURITY_STRATEGY": "Enforce"}


@pytest.fixture(autouse=True)
def each_warning_again(monkeypatch):
    monkeypatch.setattr(ros_security, "_warn_once", logging.getLogger("coframe.wire").warning)


@pytest.mark.parametrize(("wire", "title"), [("dds", "Cyclone DDS"), ("zenoh", "Zenoh")])
@pytest.mark.cyclone_only("chooses the middleware")
def test_a_process_that_must_not_communicate_without_security_does_not_join(wire, title, domain_id, monkeypatch):
    for name, value in ENFORCED.items():
        monkeypatch.setenv(name, value)
    with pytest.raises(
        WireError, match=f"ROS_SECURITY_ENABLE is true, but coframe has no security over {title}"
    ) as refused:
        Participant.get(domain_id, wire)
    assert "COFRAME_WIRE=fastdds" in refused.value.hint


@pytest.mark.cyclone_only("chooses the middleware")
def test_a_process_that_may_communicate_without_security_says_so(domain_id, monkeypatch, caplog):
    monkeypatch.setenv("ROS_SECURITY_ENABLE", "true")
    Participant.get(domain_id, "dds").close()
    assert "this process communicates without security. ROS_SECURITY_STRATEGY=Enforce refuses that." in caplog.text


@pytest.mark.parametrize("environment", [{}, {"ROS_SECURITY_ENABLE": "false"}, {"ROS_SECURITY_STRATEGY": "Enforce"}])
def test_without_a_request_nothing_is_said(environment, caplog):
    ros_security.report_unsupported("Cyclone DDS", environment)
    assert not caplog.text


@pytest.mark.parametrize(
    "environment", [{"ROS_SECURITY_ENABLE": "1"}, {**ENABLED, "ROS_SECURITY_STRATEGY": "enforce"}], ids=str
)
def test_values_that_ros_2_would_take_for_no_protection_are_refused(environment):
    with pytest.raises(WireError, match="it must be"):
        ros_security.report_unsupported("Cyclone DDS", environment)


@pytest.mark.cyclone_only("runs on the default middleware")
def test_a_command_is_refused_with_a_sentence():
    command = [sys.executable, "-m", "coframe.cli", "topic", "list"]
    done = subprocess.run(
        command, env={**os.environ, **ENFORCED}, capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 1
    assert done.stderr.startswith("coframe: ROS_SECURITY_ENABLE is true, but coframe has no security over Cyclone DDS.")
    assert "Traceback" not in done.stderr
