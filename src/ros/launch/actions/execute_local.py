# SPDX-License-Identifier: Apache-2.0
"""The action that runs a process."""

from __future__ import annotations

import asyncio
import contextlib
import os
import shlex
import signal
import traceback
from typing import TYPE_CHECKING, Any

import launch.logging
from coframe._files.os_errors import explain
from coframe.workspace.entry_point import LAUNCHER
from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.actions.process_options import performed_bool, performed_float, performed_output, timeout
from launch.actions.running_process import RunningProcess
from launch.event import Event
from launch.event_handler import EventHandler
from launch.event_handlers import OnProcessExit, OnShutdown
from launch.events.process import (
    ProcessExited,
    ProcessStarted,
    ProcessStderr,
    ProcessStdin,
    ProcessStdout,
    ProcessTargetedEvent,
    ShutdownProcess,
    SignalProcess,
)
from launch.utilities import (
    create_future,
    normalize_to_list_of_entities,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from launch.descriptions import Executable
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["ExecuteLocal"]


class ExecuteLocal(Action):
    """Run a process until it ends or the system shuts down.

    Args:
        process_description: The command, its name, working directory and environment.
        shell: Run the command by the shell.
        sigterm_timeout: Seconds between SIGINT and SIGTERM at the shutdown; 5 by default.
        sigkill_timeout: Seconds between SIGTERM and SIGKILL at the shutdown; 5 by default.
        emulate_tty: Let the process believe that its output is a terminal; ignored on Windows.
        output: The destinations of its output: ``screen``, ``log``, ``both``, ``own_log``, ``full``, or a dictionary.
        output_format: Format of a line on the screen.
        cached_output: Keep the output, for `get_stdout` and `get_stderr`.
        log_cmd: Log the command before it is run.
        on_exit: Entities, or a function from event and context to entities, for when the process ends.
        respawn: Start the process again when it ends.
        respawn_delay: Seconds to wait before that.
        respawn_max_retries: The maximum number of restarts, or -1 for no limit.
        condition: Run the process only if this condition holds.
    """

    def __init__(
        self,
        *,
        process_description: Executable,
        shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType | float | None = None,
        sigkill_timeout: SomeSubstitutionsType | float | None = None,
        emulate_tty: bool | SomeSubstitutionsType | None = None,
        output: SomeSubstitutionsType | Mapping[str, Any] = "log",
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: SomeEntitiesType | Callable[[ProcessExited, LaunchContext], SomeEntitiesType | None] | None = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | SomeSubstitutionsType | None = None,
        respawn_max_retries: int = -1,
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__process_description = process_description
        self.__shell = shell
        self.__sigterm_timeout = timeout(sigterm_timeout, "sigterm_timeout")
        self.__sigkill_timeout = timeout(sigkill_timeout, "sigkill_timeout")
        self.__emulate_tty = emulate_tty
        self.__output_option = output
        self.__output_format = output_format
        self.__cached_output = cached_output
        self.__log_cmd = log_cmd
        self.__on_exit = on_exit
        self.__respawn = respawn
        self.__respawn_delay = respawn_delay
        self.__respawn_max_retries = respawn_max_retries
        self.__respawn_retries = 0
        self.__cached = {"stdout": b"", "stderr": b""}
        self.__executed = False
        self.__process: RunningProcess | None = None
        self.__details: dict[str, Any] | None = None
        self.__completed_future: asyncio.Future[None] | None = None
        self.__shutdown_future: asyncio.Future[None] | None = None
        self.__escalation: asyncio.Task[None] | None = None
        self.__handlers: list[Any] = []
        self.__end = Event()
        self.__logger = launch.logging.get_logger("launch")
        self.__output: launch.logging.ProcessOutput | None = None

    @property
    def process_description(self) -> Executable:
        """The command, its name, working directory and environment."""
        return self.__process_description

    @property
    def shell(self) -> bool:
        """Whether the command is run by the shell."""
        return self.__shell

    @property
    def emulate_tty(self) -> Any:
        """Whether the process believes that its output is a terminal."""
        return self.__emulate_tty

    @property
    def sigterm_timeout(self) -> list[Substitution]:
        """Seconds between SIGINT and SIGTERM."""
        return self.__sigterm_timeout

    @property
    def sigkill_timeout(self) -> list[Substitution]:
        """Seconds between SIGTERM and SIGKILL."""
        return self.__sigkill_timeout

    @property
    def output(self) -> Any:
        """The destinations of the output."""
        return self.__output_option

    @property
    def process_details(self) -> dict[str, Any] | None:
        """The facts about the running process: name, cmd, cwd, env and pid, or None before it was started."""
        return self.__details

    @property
    def name(self) -> Any:
        """The name of the process with its number, or the given name before it has started."""
        return self.__process_description.final_name or self.__process_description.name

    @property
    def cmd(self) -> Any:
        """The words of the command, with substitutions performed once it was started."""
        return self.__process_description.final_cmd or self.__process_description.cmd

    @property
    def cwd(self) -> Any:
        """The working directory."""
        return self.__process_description.final_cwd or self.__process_description.cwd

    @property
    def env(self) -> Any:
        """The environment."""
        return self.__process_description.final_env or self.__process_description.env

    @property
    def return_code(self) -> int | None:
        """The exit code, None while the process runs."""
        return self.__details.get("returncode") if self.__details else None

    def get_stdout(self) -> bytes:
        """Return the standard output so far; `cached_output` must be set."""
        return self.__get_cached("stdout")

    def get_stderr(self) -> bytes:
        """Return the standard error so far; `cached_output` must be set."""
        return self.__get_cached("stderr")

    def __get_cached(self, stream: str) -> bytes:
        if not self.__cached_output:
            raise RuntimeError(f"cached_output must be true in order to get {stream}, cannot proceed")
        return self.__cached[stream]

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return the future that is done when the process has ended for good."""
        return self.__completed_future

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities for when the process ends."""
        return [] if callable(self.__on_exit) else normalize_to_list_of_entities(self.__on_exit)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return nothing: the entities of this action depend on the end of the process."""
        return []

    def describe_conditional_sub_entities(self) -> list[tuple[str, list[LaunchDescriptionEntity]]]:
        """Return the entities for when the process ends."""
        return [("on_exit", self.get_sub_entities())] if self.__on_exit else []

    def prepare(self, context: LaunchContext) -> None:
        """Perform the substitutions of the command."""
        self.__process_description.prepare(context, self)
        self.__process_description.apply_context(context)

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Start the process. It runs in a task of the event loop."""
        self.prepare(context)
        name = self.__process_description.final_name
        if self.__executed:
            raise RuntimeError(f"ExecuteLocal action '{name}': executed more than once: {self.describe()}")
        self.__executed = True
        if context.is_shutdown:
            return None  # Nothing is started from now on.
        assert name is not None
        self.__logger = launch.logging.get_logger(name)
        self.__output = launch.logging.ProcessOutput(
            name,
            performed_output(context, self.__output_option),
            lambda line: self.__output_format.format(line=line, this=self),
        )
        tty = self.__emulate_tty
        if tty is None:
            tty = context.launch_configurations.get("emulate_tty", False)
        self.__use_tty = performed_bool(context, tty)
        self.__use_respawn = performed_bool(context, self.__respawn)
        delay = self.__respawn_delay
        self.__delay = 0.0 if delay is None else performed_float(context, delay)
        self.__timeouts = tuple(
            performed_float(context, each) for each in (self.__sigterm_timeout, self.__sigkill_timeout)
        )
        self.__register_handlers(context)
        self.__completed_future = create_future(context.asyncio_loop)
        # The service waits for the process even if the launch description fails after this action.
        context.add_completion_future(self.__completed_future)
        self.__shutdown_future = create_future(context.asyncio_loop)
        self.__task = asyncio.ensure_future(self.__run(context))
        return None

    def __register_handlers(self, context: LaunchContext) -> None:
        def is_target(event: Event, kind: type[ProcessTargetedEvent]) -> bool:
            return isinstance(event, kind) and event.process_matcher(self)

        def handler(matcher: Callable[[Event], bool], react: Callable[[Any, LaunchContext], None]) -> EventHandler:
            action = OpaqueFunction(function=lambda context: react(context.locals.event, context))
            return EventHandler(matcher=matcher, entities=action)

        self.__handlers = [
            handler(
                lambda event: is_target(event, ShutdownProcess), lambda _, context: self._shutdown_process(context)
            ),
            handler(lambda event: is_target(event, SignalProcess), lambda event, _: self.__signal(event.signal)),
            handler(lambda event: is_target(event, ProcessStdin), lambda event, _: self.__write(event.text)),
            handler(lambda event: event is self.__end, lambda _, context: self.__clean_up(context)),
            OnShutdown(on_shutdown=lambda event, context: self._shutdown_process(context, quiet=event.due_to_sigint)),
        ]
        if self.__on_exit is not None:
            self.__handlers.append(OnProcessExit(target_action=self, on_exit=self.__on_exit))
        for each in self.__handlers:
            context.register_event_handler(each)

    async def __run(self, context: LaunchContext) -> None:
        """Run the process, again and again if it is to be respawned."""
        assert self.__completed_future is not None
        try:
            while await self.__run_once(context):
                self.__respawn_retries += 1
                if await self.__is_shut_down_within(self.__delay):
                    break
            await self.__end_children()
        except Exception as error:  # noqa: BLE001 - the error becomes that of the action
            self.__completed_future.set_exception(error)
        # The events that the process has emitted are still in the queue, and its handlers stay until then.
        context.emit_event_sync(self.__end)

    async def __run_once(self, context: LaunchContext) -> bool:
        """Run the process, and return whether it should be started again."""
        description = self.__process_description
        assert description.final_cmd is not None
        assert description.final_env is not None
        assert self.__shutdown_future is not None
        assert self.__output is not None
        if self.__shutdown_future.done():
            return False
        command: list[str] | str = " ".join(description.final_cmd) if self.__shell else description.final_cmd
        shown = command if isinstance(command, str) else shlex.join(command)
        if self.__log_cmd:
            self.__logger.info(
                f"process details: cmd='{shown}', cwd='{description.final_cwd}', "
                f"custom_env?={'True' if description.env is not None else 'False'}"
            )
        # Programs in Python would keep their output back, because it is not a terminal.
        env = {"PYTHONUNBUFFERED": "1", **description.final_env, LAUNCHER: str(os.getpid())}
        try:
            process = await RunningProcess.start(
                command, cwd=description.final_cwd, env=env, emulate_tty=self.__use_tty
            )
        except (OSError, ValueError) as error:
            self.__logger.error(  # noqa: TRY400 - the traceback is for --debug only
                f"process cannot be started: {explain(error)}. The command was: {shown}"
            )
            self.__logger.debug(traceback.format_exc())
            return False
        self.__process = process
        details: dict[str, Any] = {
            "action": self,
            "name": description.final_name,
            "cmd": description.final_cmd,
            "cwd": description.final_cwd,
            "env": description.final_env,
            "pid": process.pid,
        }
        self.__details = dict(details)
        self.__logger.info(f"process started with pid [{process.pid}]")
        context.emit_event_sync(ProcessStarted(**details))
        if self.__shutdown_future.done():  # The system was shut down while the process was being started.
            self.__begin_escalation()
        code = await process.wait(lambda stream, data: self.__on_output(context, details, stream, data))
        self.__output.flush()
        if self.__escalation is not None:
            self.__escalation.cancel()
        if code == 0:
            self.__logger.info(f"process has finished cleanly [pid {process.pid}]")
        else:
            self.__logger.error(f"process has died [pid {process.pid}, exit code {code}, cmd '{shown}'].")
        self.__details["returncode"] = code
        if process.has_children():  # They have lost their parent.
            process.send_signal(signal.SIGTERM)
        context.emit_event_sync(ProcessExited(returncode=code, **details))
        limit = self.__respawn_max_retries
        may_respawn = self.__use_respawn and (limit < 0 or self.__respawn_retries < limit)
        return may_respawn and not context.is_shutdown and not self.__shutdown_future.done()

    async def __is_shut_down_within(self, seconds: float) -> bool:
        assert self.__shutdown_future is not None
        with contextlib.suppress(asyncio.TimeoutError):
            await asyncio.wait_for(asyncio.shield(self.__shutdown_future), max(seconds, 0.001))
        return self.__shutdown_future.done()

    def __clean_up(self, context: LaunchContext) -> None:
        for handler in self.__handlers:
            with contextlib.suppress(ValueError):
                context.unregister_event_handler(handler)
        if self.__completed_future is not None and not self.__completed_future.done():
            self.__completed_future.set_result(None)

    async def __end_children(self) -> None:
        """Kill the children of the process that are still there although it has ended."""
        process = self.__process
        if process is not None and process.has_children():
            await self.__is_group_gone_within(process, self.__timeouts[0])
            process.send_signal(getattr(signal, "SIGKILL", signal.SIGTERM))

    async def __is_group_gone_within(self, process: RunningProcess, seconds: float) -> None:
        loop = asyncio.get_running_loop()
        deadline = loop.time() + seconds
        while process.has_children() and loop.time() < deadline:  # noqa: ASYNC110 - the system has no event for it
            await asyncio.sleep(0.02)

    def __on_output(self, context: LaunchContext, details: dict[str, Any], stream: str, data: bytes) -> None:
        assert self.__output is not None
        self.__output.write(stream, data)
        if self.__cached_output:
            self.__cached[stream] += data
        kind, fd = (ProcessStdout, 1) if stream == "stdout" else (ProcessStderr, 2)
        event = kind(text=data, fd=fd, **details)
        if context.would_handle_event(event):
            context.emit_event_sync(event)

    def _shutdown_process(self, context: LaunchContext, *, quiet: bool = False) -> None:
        """Send SIGINT, then SIGTERM and SIGKILL if the process does not end."""
        del context
        if self.__shutdown_future is None or self.__shutdown_future.done():
            return
        self.__shutdown_future.set_result(None)
        if self.__process is not None and self.__process.is_running:
            self.__begin_escalation(quiet=quiet)

    def __begin_escalation(self, *, quiet: bool = True) -> None:
        self.__signal(signal.SIGINT, quiet=quiet)
        self.__escalation = asyncio.ensure_future(self.__escalate())

    async def __escalate(self) -> None:
        name = self.__process_description.final_name
        last = "SIGINT"
        for seconds, number in zip(self.__timeouts, (signal.SIGTERM, getattr(signal, "SIGKILL", 9)), strict=True):
            await asyncio.sleep(seconds)
            following = "SIGKILL" if last == "SIGTERM" else "SIGTERM"
            self.__logger.error(
                f"process[{name}] failed to terminate '{seconds:g}' seconds after receiving '{last}', "
                f"escalating to '{following}'"
            )
            self.__signal(number)
            last = following

    def __signal(self, number: int, *, quiet: bool = False) -> None:
        if self.__process is None or not self.__process.is_running:
            return
        if not quiet:
            name = signal.Signals(number).name if os.name == "posix" else str(number)
            self.__logger.info(f"sending signal '{name}' to process[{self.__process_description.final_name}]")
        self.__process.send_signal(number)

    def __write(self, text: bytes) -> None:
        if self.__process is not None and self.__process.is_running:
            self.__process.write(text)
