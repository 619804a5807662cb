# SPDX-License-Identifier: Apache-2.0
"""Tests with launch fixtures, as tutorials of launch_pytest write them."""

import sys

import pytest

import launch_pytest
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch_pytest.tools import process as process_tools

PROGRAM = """
import signal, sys, time
signal.signal(signal.SIGINT, lambda *_: (print("the end"), sys.exit(0)))
print("hello", *sys.argv[1:], flush=True)
time.sleep(60)
"""


@pytest.fixture
def greeter():
    return ExecuteProcess(cmd=[sys.executable, "-c", PROGRAM], cached_output=True)


@launch_pytest.fixture
def description(greeter):
    return LaunchDescription([greeter, launch_pytest.actions.ReadyToTest()])


@pytest.mark.launch(fixture=description)
def test_a_function(greeter, launch_context):
    def validate(output):
        assert output.splitlines() == ["hello"]

    process_tools.assert_output_sync(launch_context, greeter, validate, timeout=30)
    assert not process_tools.wait_for_exit_sync(launch_context, greeter, timeout=0.05)


@pytest.mark.launch(fixture=description)
async def test_a_coroutine(greeter, launch_context, launch_service, event_loop):
    assert await process_tools.wait_for_output(launch_context, greeter, lambda output: "hello" in output, timeout=30)
    assert not await process_tools.wait_for_output(launch_context, greeter, lambda _: False, timeout=0.05)
    assert launch_service.context is launch_context
    assert launch_context.asyncio_loop is event_loop


@pytest.mark.launch(fixture=description)
def test_a_generator(greeter, launch_context):
    assert process_tools.wait_for_output_sync(launch_context, greeter, lambda output: "hello" in output, timeout=30)
    yield
    assert greeter.return_code == 0
    assert b"the end" in greeter.get_stdout()


@pytest.mark.launch(fixture=description)
async def test_an_asynchronous_generator(greeter, launch_context):
    await process_tools.assert_output(launch_context, greeter, lambda output: "hello" in output, timeout=30)
    yield
    assert greeter.return_code == 0


@pytest.mark.launch(fixture=description, shutdown=True)
def test_after_the_shutdown(greeter):
    assert greeter.return_code is not None


@launch_pytest.fixture(scope="module", params=["one", "two"])
def common(request):
    process = ExecuteProcess(cmd=[sys.executable, "-c", PROGRAM, request.param], cached_output=True)
    return LaunchDescription([process]), process  # ReadyToTest is added


@pytest.mark.launch(fixture=common)
def test_common_generator(common, launch_context):
    _, process = common
    assert process_tools.wait_for_output_sync(launch_context, process, lambda output: "hello" in output, timeout=30)
    yield
    assert b"the end" in process.get_stdout()


@pytest.mark.launch(fixture=common, shutdown=True)
def test_common_after_the_shutdown(common):
    assert common[1].return_code == 0


@pytest.mark.launch(fixture=common)
class TestCommon:
    def test_still_running(self, common):
        assert common[1].return_code is None


@launch_pytest.fixture(auto_shutdown=False)
def short():
    process = ExecuteProcess(cmd=[sys.executable, "-c", "print('done')"], cached_output=True)
    return LaunchDescription([process]), process


@pytest.mark.launch(fixture=short, shutdown=True)
def test_after_its_own_end(short):
    assert short[1].get_stdout().split() == [b"done"]
    assert short[1].return_code == 0
