# SPDX-License-Identifier: Apache-2.0
"""What the tests of launch files share."""

import os
import re

import pytest

import launch.logging
from launch import LaunchContext, LaunchDescription, LaunchService
from launch.frontend import Parser
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


@pytest.fixture(autouse=True)
def _surroundings(tmp_path, monkeypatch):
    """Log files go to the folder of the test, and environment variables are restored."""
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    monkeypatch.delenv("COFRAME_PACKAGE_PATH", raising=False)
    before = dict(os.environ)
    yield
    launch.logging.reset()
    os.environ.clear()
    os.environ.update(before)


@pytest.fixture
def context():
    return LaunchContext()


@pytest.fixture
def perform(context):
    """Perform substitutions in the context of the test."""
    return lambda subs: perform_substitutions(context, normalize_to_list_of_substitutions(subs))


@pytest.fixture
def launched(capfd):
    """Launch entities until the system is idle; return the exit code and the lines on the screen."""

    def run(*entities, **configurations):
        service = LaunchService()
        service.context.launch_configurations.update(configurations)
        service.include_launch_description(LaunchDescription(entities))
        code = service.run()
        text = re.sub(r"pid \[?\d+", "pid PID", capfd.readouterr().out)
        return code, text.splitlines()

    return run


@pytest.fixture
def parse():
    """Read a launch file from text, in XML if it begins with a tag, otherwise in YAML."""

    def read(text, folder):
        file = folder / ("test.launch.xml" if text.lstrip().startswith("<") else "test.launch.yaml")
        file.write_text(text)
        root, parser = Parser.load(str(file))
        return parser.parse_description(root)

    return read
