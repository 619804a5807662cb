# SPDX-License-Identifier: Apache-2.0
"""The plugin for pytest: starts launch fixtures, and runs tests during the launch and after it.

A test that is a function runs in a thread, while the event loop of the launch runs in the main thread. A coroutine runs
in that event loop. The part of a generator or asynchronous generator after its first ``yield`` runs after the shutdown.
"""

from __future__ import annotations

import asyncio
import contextlib
import functools
import inspect
import threading
from typing import TYPE_CHECKING, Any

import pytest

from launch_pytest import _fixtures
from launch_pytest._running_launch import RunningLaunch, launch_of, options_of
from launch_pytest.fixture import LaunchFixture, launch_fixture_of

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

__all__: list[str] = []

_FIXTURES = "launch_pytest.fixtures"
_SHUTDOWN_SUFFIX = "[shutdown_test]"


def pytest_configure(config: pytest.Config) -> None:
    """Declare the mark."""
    config.addinivalue_line(
        "markers",
        "launch(fixture, shutdown=False): run the test while the processes of a launch fixture run, or after them",
    )


@pytest.hookimpl(hookwrapper=True)
def pytest_fixture_setup(fixturedef: pytest.FixtureDef[Any], request: Any) -> Generator[None, Any, None]:
    """Start the launch of a launch fixture."""
    options = launch_fixture_of(fixturedef.func)
    outcome = yield
    if options is None or outcome.excinfo is not None:
        return
    launch = RunningLaunch(options)
    fixturedef.addfinalizer(launch.close)
    try:
        launch.start(outcome.get_result())
    except BaseException as error:  # noqa: BLE001 - pytest reports it as an error of the fixture
        fixturedef.cached_result = (None, fixturedef.cache_key(request), (error, error.__traceback__))
        outcome.force_exception(error)


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: Any, name: str, obj: Any) -> list[pytest.Function] | None:
    """Let marked tests use their launch fixture, and split generators that continue after the shutdown."""
    if not (collector.funcnamefilter(name) and inspect.isroutine(obj)):
        return None
    mark = _launch_mark(collector, obj)
    if mark is None:
        return None
    manager = collector.config.pluginmanager
    if not manager.has_plugin(_FIXTURES):
        manager.register(_fixtures, _FIXTURES)
    options = options_of(mark, f"{collector.nodeid}::{name}")
    function = pytest.mark.usefixtures(options.name)(_as_plain_function(obj))
    items = list(collector._genfunctions(name, function))  # noqa: SLF001 - pytest has no public name
    if _is_generator(obj) and not mark.kwargs.get("shutdown", False):
        return [part for item in items for part in _split_item(item, options)]
    return items


def _as_plain_function(test: Any) -> Any:
    """Return a function with the signature of a test, because pytest does not accept generators as tests."""

    @functools.wraps(test)
    def function(*args: Any, **kwargs: Any) -> Any:
        return test(*args, **kwargs)

    function._coframe_test = test  # type: ignore[attr-defined] # noqa: SLF001 - an attribute of this plugin
    # The marks of the test stay as they are.
    function.pytestmark = list(getattr(test, "pytestmark", []))  # type: ignore[attr-defined]
    return function


def _test_of(item: pytest.Function) -> Any:
    """Return the function of a test that the user has written, bound to the instance of its class."""
    test = getattr(item.obj, "_coframe_test", item.obj)
    return test if item.instance is None or hasattr(test, "__self__") else test.__get__(item.instance)


def _launch_mark(collector: Any, obj: Any) -> pytest.Mark | None:
    marks = [mark for mark in getattr(obj, "pytestmark", []) if mark.name == "launch"]
    inherited: pytest.Mark | None = collector.get_closest_marker("launch")
    return marks[-1] if marks else inherited


def _is_generator(function: Any) -> bool:
    return inspect.isgeneratorfunction(function) or inspect.isasyncgenfunction(function)


def _split_item(item: pytest.Function, options: LaunchFixture) -> list[pytest.Function]:
    """Return the item, and a second item for the part after the shutdown if other tests may use the launch."""
    definitions = _definitions(item, options)
    if not definitions or definitions[-1].scope == "function":
        return [item]
    rest = pytest.Function.from_parent(
        item.parent,
        name=f"{item.name}{_SHUTDOWN_SUFFIX}",
        callobj=item.obj,
        fixtureinfo=item._fixtureinfo,  # noqa: SLF001
    )
    if hasattr(item, "callspec"):
        rest.callspec = item.callspec
    rest._coframe_first_part = item  # type: ignore[attr-defined] # noqa: SLF001 - an attribute of this plugin
    item._coframe_is_split = True  # type: ignore[attr-defined] # noqa: SLF001
    return [item, rest]


def _runs_after_shutdown(item: pytest.Item) -> bool:
    if not isinstance(item, pytest.Function):
        return False
    mark = item.get_closest_marker("launch")
    return mark is not None and (bool(mark.kwargs.get("shutdown", False)) or hasattr(item, "_coframe_first_part"))


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Move the tests that run after the shutdown to the end of the tests of their launch."""
    last: dict[Any, int] = {}
    for index, item in enumerate(items):
        last[_launch_key(item)] = index
    order = {
        item: (last[_launch_key(item)], 1) if _runs_after_shutdown(item) else (index, 0)
        for index, item in enumerate(items)
    }
    items.sort(key=order.__getitem__)


def _launch_key(item: pytest.Item) -> object:
    """Return a value that is equal for all tests of a launch."""
    mark = item.get_closest_marker("launch") if isinstance(item, pytest.Function) else None
    if mark is None:
        return item
    options = options_of(mark, item.nodeid)
    definitions = _definitions(item, options)
    if not definitions or definitions[-1].scope == "function":
        return item
    indices = item.callspec.indices if hasattr(item, "callspec") else {}
    return definitions[-1], indices.get(options.name)


def _definitions(item: Any, options: LaunchFixture) -> Any:
    return item._fixtureinfo.name2fixturedefs.get(options.name)  # noqa: SLF001 - pytest has no public name


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run a test with the mark."""
    mark = pyfuncitem.get_closest_marker("launch")
    if mark is None:
        return None
    launch = launch_of(pyfuncitem)
    first = getattr(pyfuncitem, "_coframe_first_part", None)
    if first is not None:
        rest = getattr(first, "_coframe_rest", None)
        if rest is None:
            pytest.skip("the part before the shutdown has not run to its yield")
        launch.finish()
        rest()
        return True
    if mark.kwargs.get("shutdown", False):
        launch.finish()
    names = pyfuncitem._fixtureinfo.argnames  # noqa: SLF001 - as pytest calls a function
    arguments = {name: pyfuncitem.funcargs[name] for name in names}
    rest = _start_test(_test_of(pyfuncitem), arguments, launch)
    if getattr(pyfuncitem, "_coframe_is_split", False):
        pyfuncitem._coframe_rest = rest  # type: ignore[attr-defined] # noqa: SLF001
    elif rest is not None:
        launch.finish()
        rest()
    return True


def _start_test(function: Any, arguments: dict[str, Any], launch: RunningLaunch) -> Callable[[], None] | None:
    """Run a test, or its part before the shutdown. Return a function that runs the other part."""
    if inspect.iscoroutinefunction(function):
        launch.run(function(**arguments))
        return None
    if inspect.isasyncgenfunction(function):
        asynchronous = function(**arguments)
        launch.run(asynchronous.__anext__())
        return lambda: launch.run(_end_async_test(asynchronous))
    if inspect.isgeneratorfunction(function):
        generator = function(**arguments)
        launch.run(_run_in_thread(lambda: next(generator)))
        return lambda: launch.run(_run_in_thread(lambda: _end_test(generator)))
    launch.run(_run_in_thread(lambda: function(**arguments)))
    return None


def _end_test(generator: Any) -> None:
    with contextlib.suppress(StopIteration):
        next(generator)
        pytest.fail("a test of a launch may have only one yield", pytrace=False)


async def _end_async_test(generator: Any) -> None:
    with contextlib.suppress(StopAsyncIteration):
        await generator.__anext__()
        pytest.fail("a test of a launch may have only one yield", pytrace=False)


async def _run_in_thread(function: Callable[[], Any]) -> None:
    """Run a function in a thread, so that the event loop continues. Its exception is raised here."""
    done = asyncio.Event()
    loop = asyncio.get_running_loop()
    errors: list[BaseException] = []

    def work() -> None:
        try:
            function()
        except BaseException as error:  # noqa: BLE001 - pytest's outcomes are no Exceptions
            errors.append(error)
        finally:
            loop.call_soon_threadsafe(done.set)

    thread = threading.Thread(target=work, name="launch test", daemon=True)
    thread.start()
    await done.wait()
    thread.join()
    if errors:
        raise errors[0]
