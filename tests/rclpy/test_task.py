# SPDX-License-Identifier: Apache-2.0
"""Futures and tasks without an executor."""

import pytest

from rclpy.task import Future, Task


def test_result_and_exception():
    future = Future()
    assert (future.done(), future.result()) == (False, None)
    future.set_result(5)
    assert (future.done(), future.result(), future.exception()) == (True, 5, None)
    failed = Future()
    failed.set_exception(KeyError("x"))
    with pytest.raises(KeyError):
        failed.result()


def test_done_callbacks_run_immediately():
    future, calls = Future(), []
    future.add_done_callback(calls.append)
    assert calls == []
    future.set_result(1)
    assert calls == [future]
    future.add_done_callback(calls.append)
    assert calls == [future, future]


def test_failing_callback_does_not_stop_the_others(capsys):
    future, calls = Future(), []
    future.add_done_callback(lambda _: 1 / 0)
    future.add_done_callback(calls.append)
    future.set_result(1)
    assert calls == [future]
    assert "ZeroDivisionError" in capsys.readouterr().err


def test_unretrieved_exceptions_are_reported(capsys):
    future = Future()
    future.set_exception(RuntimeError("lost"))
    del future
    assert "The following exception was never retrieved: lost" in capsys.readouterr().err


def test_cancel():
    future = Future()
    future.cancel()
    assert future.cancelled()
    assert not future.done()
    done = Future()
    done.set_result(1)
    done.cancel()
    assert not done.cancelled()


def test_coroutines_run_by_send():
    future = Future()

    async def wait():
        return await future

    coroutine = wait()
    coroutine.send(None)
    future.set_result("there")
    with pytest.raises(StopIteration) as stop:
        coroutine.send(None)
    assert stop.value.value == "there"


def test_task_of_a_function():
    task = Task(lambda a, b: a + b, (1,), {"b": 2})
    task()
    assert task.result() == 3


def test_task_of_a_coroutine_continues_when_called_again():
    future = Future()

    async def wait(extra):
        return await future + extra

    task = Task(wait, (1,))
    task()
    assert not task.done()
    future.set_result(1)
    task()
    assert task.result() == 2


def test_task_keeps_the_exception():
    task = Task(lambda: 1 / 0)
    task()
    assert isinstance(task.exception(), ZeroDivisionError)


def test_cancelled_task_does_not_run():
    calls = []
    task = Task(lambda: calls.append(1))
    task.cancel()
    task()
    assert calls == []
