# SPDX-License-Identifier: Apache-2.0
"""A process under test and tests of it, as tutorials of launch_testing write them."""

import sys
import unittest

import pytest

import launch
import launch_testing
import launch_testing.actions
import launch_testing.asserts
import launch_testing.markers
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

PROGRAM = """
import signal, sys, time
signal.signal(signal.SIGINT, lambda *_: (print("the end"), sys.exit(0)))
print("hello", *sys.argv[1:], flush=True)
print("a warning", file=sys.stderr, flush=True)
time.sleep(60)
"""


@pytest.mark.launch_test
@launch_testing.parametrize("word", ["one", "two"])
def generate_test_description(word):
    process = ExecuteProcess(
        cmd=[sys.executable, "-c", PROGRAM, word, LaunchConfiguration("name")], name="greeter", output="screen"
    )
    other = launch_testing.util.KeepAliveProc()
    entities = [DeclareLaunchArgument("name", default_value="world"), process, other]
    return launch.LaunchDescription([*entities, launch_testing.actions.ReadyToTest()]), {"process": process}


class TestWhileRunning(unittest.TestCase):
    attempts = 0

    @classmethod
    def setUpClass(cls, word):
        cls.chosen = word

    def setUp(self, proc_info):
        assert proc_info is self.proc_info

    def test_output(self, proc_output, process, word, test_args):
        name = test_args.get("name", "world")
        proc_output.assertWaitFor(f"hello {word} {name}", process=process, timeout=30, stream="stdout")
        self.proc_output.assertWaitFor("a warning", process="greeter", timeout=30)
        assert not proc_output.waitFor("nothing", timeout=0.05, stream="stdout")
        assert self.chosen == word
        with self.assertRaisesRegex(AssertionError, "'nothing' is not in the stdout of greeter-"):
            proc_output.assertWaitFor("nothing", process, timeout=0.05, stream="stdout")

    def test_another_process(self, launch_service, proc_info, proc_output):
        action = ExecuteProcess(cmd=[sys.executable, "-c", "print(6 * 7)"], name="calculator")
        with launch_testing.tools.launch_process(launch_service, action, proc_info, proc_output) as calculator:
            assert calculator.wait_for_output("42", timeout=30)
            assert calculator.wait_for_shutdown(timeout=30)
        assert calculator.exit_code == launch_testing.asserts.EXIT_OK
        assert launch_testing.tools.expect_output(expected_lines=["42"], text=calculator.output, strict=True)

    @launch_testing.markers.retry_on_failure(times=3)
    def test_that_succeeds_at_last(self):
        type(self).attempts += 1
        self.assertEqual(self.attempts, 3)


@launch_testing.post_shutdown_test()
class TestAfterShutdown(unittest.TestCase):
    def test_exit_codes_and_order_of_output(self, proc_info, proc_output, process):
        launch_testing.asserts.assertExitCodes(proc_info)
        launch_testing.asserts.assertInStdout(proc_output, "the end", process)
        launch_testing.asserts.assertInStderr(proc_output, "warning", "greeter")
        with launch_testing.asserts.assertSequentialStdout(proc_output, process) as checker:
            checker.assertInStdout("hello")
            checker.assertInStdout("the end")
            with self.assertRaisesRegex(AssertionError, "'hello' was not found in output after the previous"):
                checker.assertInStdout("hello")
        with self.assertRaisesRegex(Exception, "Did not find any process matching name 'nobody'"):
            launch_testing.asserts.assertExitCodes(proc_info, process="nobody")
