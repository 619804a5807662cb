# SPDX-License-Identifier: Apache-2.0
"""launch_testing and launch_pytest: tests of launched systems, run by their own command and by pytest."""

import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

FILES = Path(__file__).with_name("testing")


@pytest.fixture
def execute(tmp_path):
    """Run Python with some words in an empty folder, and return the exit code and the output."""

    def call(*words, **environment):
        done = subprocess.run(
            [sys.executable, *map(str, words)],
            cwd=tmp_path,
            env={**os.environ, "PYTEST_ADDOPTS": "", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=110,
            check=False,
        )
        return done.returncode, done.stdout

    return call


@pytest.fixture
def run_pytest(execute, tmp_path):
    """Run pytest on a copy of a file of tests, without the settings of this project."""

    def call(source, *words, **environment):
        text = source.read_text() if isinstance(source, Path) else source
        (tmp_path / "test_it.py").write_text(text)
        (tmp_path / "pytest.ini").touch()
        return execute("-m", "pytest", "-p", "no:cacheprovider", "-v", "test_it.py", *words, **environment)

    return call


def file_with(folder, description, tests=""):
    file = folder / "broken.py"
    head = "import launch, launch_testing, launch_testing.actions, launch_testing.markers, sys, unittest\n"
    process = "from launch.actions import ExecuteProcess, TimerAction\n"
    file.write_text(head + process + description + "\n" + tests)
    return file


def test_tests_run_during_the_launch_and_after_it(execute, tmp_path):
    words = ("-m", "launch_testing.launch_test", FILES / "hello.py", "--junit-xml", "out/results.xml")
    code, output = execute(*words, "--package-name", "demo")
    assert code == 0, output
    root = ET.parse(tmp_path / "out" / "results.xml").getroot()
    assert root.get("name") == "demo.hello.launch_tests"
    assert [(suite.get("name"), suite.get("tests"), suite.get("failures")) for suite in root] == [
        (f"demo.hello.launch_tests[word={word}]", "4", "0") for word in ("one", "two")
    ]
    assert "test_output[word=one]" in {case.get("name") for case in root.iter("testcase")}


def test_pytest_collects_files_with_the_mark(run_pytest):
    code, output = run_pytest(FILES / "hello.py", "-p", "launch_testing", "--launch-args", "name:=robot")
    assert code == 0, output
    code, output = run_pytest(FILES / "hello.py", "--strict-markers")
    assert code == 0, output
    assert re.search(r"test_it.py::test_it PASSED", output)


def test_a_failing_test_is_reported_by_both(execute, run_pytest):
    text = (FILES / "hello.py").read_text().replace("self.attempts, 3", "self.attempts, 4")
    code, output = run_pytest(text)
    assert code == 1
    assert "AssertionError: 3 != 4" in output
    assert "some test cases have failed in test_it" in output
    assert execute("-m", "launch_testing.launch_test", "test_it.py")[0] == 1


@pytest.mark.parametrize(
    ("description", "message"),
    [
        ("", "is missing generate_test_description function"),
        (
            "def generate_test_description():\n  return launch.LaunchDescription([])",
            "must return LaunchDescription containing a ReadyToTest action",
        ),
        ("def generate_test_description(speed):\n  pass", "unexpected extra argument 'speed'"),
        ("1 / 0", "cannot be imported: ZeroDivisionError: division by zero"),
    ],
)
def test_faulty_files_end_with_a_sentence(execute, tmp_path, description, message):
    code, output = execute("-m", "launch_testing.launch_test", file_with(tmp_path, description))
    assert code == 2
    assert message in output.splitlines()[-1]
    assert "Traceback" not in output


PROCESS_THAT_ENDS = """
def generate_test_description():
    process = ExecuteProcess(cmd=[sys.executable, "-c", "print('I am done')"], name="quick")
    ready = TimerAction(period=0.0, actions=[launch_testing.actions.ReadyToTest()])
    return launch.LaunchDescription([process, ready])
"""
TEST_OF_ITS_END = """
class TestIt(unittest.TestCase):
    def test_wait(self, proc_info, proc_output):
        proc_info.assertWaitForShutdown(process="quick", timeout=30)
        assert not proc_output.waitFor("other", timeout=3.0, stream="stdout")
"""


def test_processes_that_end_too_early_fail_the_tests(execute, tmp_path):
    file = file_with(tmp_path, PROCESS_THAT_ENDS, TEST_OF_ITS_END)
    code, output = execute("-m", "launch_testing.launch_test", file)
    assert code == 1
    assert "Processes under test stopped before tests completed" in output
    assert "exited with 0" in output
    assert "I am done" in output


def test_a_launch_can_be_kept_alive(execute, tmp_path):
    description = "\n@launch_testing.markers.keep_alive" + PROCESS_THAT_ENDS
    code, output = execute("-m", "launch_testing.launch_test", file_with(tmp_path, description, TEST_OF_ITS_END))
    assert code == 0, output


@pytest.mark.parametrize(
    "handler",
    [
        "OnProcessStart(target_action=process, on_start=[launch_testing.actions.ReadyToTest()])",
        (
            "launch_testing.event_handlers.StdoutReadyListener(target_action=process, ready_txt='up', "
            "actions=[launch_testing.actions.ReadyToTest()])"
        ),
    ],
)
def test_the_tests_may_start_at_an_event(execute, tmp_path, handler):
    description = (
        "from launch.actions import RegisterEventHandler\nfrom launch.event_handlers import OnProcessStart\n"
        "def generate_test_description():\n"
        "    program = 'import time; print(\"is up\"); time.sleep(60)'\n"
        "    process = ExecuteProcess(cmd=[sys.executable, '-u', '-c', program])\n"
        f"    return launch.LaunchDescription([process, RegisterEventHandler({handler})])\n"
    )
    test = (
        "class TestIt(unittest.TestCase):\n    def test_it(self, proc_output):\n"
        "        proc_output.assertWaitFor('is up', timeout=30, stream='stdout')\n"
    )
    code, output = execute("-m", "launch_testing.launch_test", file_with(tmp_path, description, test))
    assert code == 0, output


def test_arguments_are_shown(execute):
    code, output = execute("-m", "launch_testing.launch_test", FILES / "hello.py", "--show-args")
    assert code == 0
    assert "'name':" in output
    assert "(default: 'world')" in output


def test_launch_fixtures(run_pytest):
    code, output = run_pytest(FILES / "fixtures.py")
    assert code == 0, output
    ran = re.findall(r"::(\S+) PASSED", output)
    assert len(ran) == 6 + 2 * 4
    for name in ("one", "two"):
        # The tests of one launch run one after the other, those after its shutdown last.
        mine = [test for test in ran if f"[{name}]" in test]
        assert mine[:2] == [f"test_common_generator[{name}]", f"TestCommon::test_still_running[{name}]"] or mine[
            :2
        ] == [f"TestCommon::test_still_running[{name}]", f"test_common_generator[{name}]"]
        assert set(mine[2:]) == {
            f"test_common_generator[{name}][shutdown_test]",
            f"test_common_after_the_shutdown[{name}]",
        }


def test_failures_in_both_parts_of_a_generator_are_reported(run_pytest):
    text = (FILES / "fixtures.py").read_text().replace('b"the end" in', 'b"never" in')
    code, output = run_pytest(text, "-k", "generator")
    assert code == 1
    assert set(re.findall(r"::(\S+) FAILED", output)) == {
        "test_a_generator",
        "test_common_generator[one][shutdown_test]",
        "test_common_generator[two][shutdown_test]",
    }


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("None", "must return a LaunchDescription, or a tuple or list that begins with one"),
        ("LaunchDescription([OpaqueFunction(function=len)])", "has ended before ReadyToTest"),
    ],
)
def test_faulty_launch_fixtures(run_pytest, value, message):
    text = (
        "import launch_pytest, pytest\nfrom launch import LaunchDescription\n"
        "from launch.actions import OpaqueFunction\n"
        f"@launch_pytest.fixture\ndef it():\n    return {value}\n"
        "@pytest.mark.launch(fixture=it)\ndef test_it(): pass\n"
    )
    code, output = run_pytest(text)
    assert code == 1
    assert message in output


def test_a_mark_without_a_launch_fixture_is_explained(run_pytest):
    text = "import launch_pytest, pytest\n@pytest.mark.launch(fixture=print)\ndef test_it(): pass\n"
    code, output = run_pytest(text)
    assert code == 2
    assert "test_it.py::test_it: @pytest.mark.launch needs fixture=, a function that is declared with" in output


def test_launch_fixtures_may_be_in_conftest(run_pytest, tmp_path):
    source = (FILES / "fixtures.py").read_text()
    head, _, rest = source.partition("@pytest.mark.launch(fixture=description)\ndef test_a_function")
    (tmp_path / "conftest.py").write_text(head)
    tests = "import pytest\nfrom conftest import description, process_tools\n\n\n"
    tests += "@pytest.mark.launch(fixture=description)\ndef test_a_function" + rest.partition("@pytest.mark")[0]
    code, output = run_pytest(tests, "--strict-markers")
    assert code == 0, output
    assert "1 passed" in output


def test_pytest_is_named_where_it_is_missing(execute):
    program = (
        "import sys; sys.modules['pytest'] = None\n"
        "import importlib.util; find = importlib.util.find_spec\n"
        "importlib.util.find_spec = lambda name, package=None: None if name == 'pytest' else find(name, package)\n"
        "import launch_testing, launch_testing_ros\nimport launch_pytest\n"
    )
    _, output = execute("-c", program)
    last = "ModuleNotFoundError: launch_pytest needs pytest, which is not installed: pip install pytest"
    assert output.splitlines()[-1] == last
