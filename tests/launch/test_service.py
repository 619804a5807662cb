# SPDX-License-Identifier: Apache-2.0
"""The launch service: order of visiting, scopes, events, processes and their end."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from launch import LaunchDescription, LaunchService
from launch.actions import (
    AppendEnvironmentVariable,
    DeclareLaunchArgument,
    EmitEvent,
    ExecuteProcess,
    ForEach,
    ForLoop,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueCoroutine,
    OpaqueFunction,
    PopLaunchConfigurations,
    PushLaunchConfigurations,
    RegisterEventHandler,
    ResetLaunchConfigurations,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
    UnregisterEventHandler,
    UnsetEnvironmentVariable,
    UnsetLaunchConfiguration,
)
from launch.conditions import IfCondition
from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown
from launch.events import Shutdown as ShutdownEvent
from launch.events import matches_action
from launch.events.process import ProcessStdin, ShutdownProcess, SignalProcess, matches_name
from launch.substitutions import EnvironmentVariable, LaunchConfiguration, LocalSubstitution, ThisLaunchFileDir


def python(code, *arguments, **options):
    return ExecuteProcess(cmd=[sys.executable, "-c", code, *arguments], **{"output": "screen", "name": "p", **options})


def messages(lines):
    """Return the texts that LogInfo has logged."""
    return [line.removeprefix("[INFO] [launch.user]: ") for line in lines if "[launch.user]" in line]


def show(name):
    return LogInfo(msg=[name, "=", LaunchConfiguration(name, default="unset")])


def test_groups_have_launch_configurations_and_an_environment_of_their_own(launched):
    code, lines = launched(
        SetLaunchConfiguration("a", "1"),
        SetEnvironmentVariable("COFRAME_X", "out"),
        GroupAction(
            [
                SetLaunchConfiguration("a", "2"),
                AppendEnvironmentVariable("COFRAME_X", "in", separator="+"),
                AppendEnvironmentVariable("COFRAME_X", "front", prepend=True, separator="+"),
                show("a"),
                LogInfo(msg=EnvironmentVariable("COFRAME_X")),
                GroupAction([SetLaunchConfiguration("b", "3")], scoped=False),
                show("b"),
            ]
        ),
        LogInfo(msg=EnvironmentVariable("COFRAME_X")),
        show("a"),
        show("b"),
        GroupAction(
            [show("a"), show("c")], forwarding=False, launch_configurations={"c": ["c", LaunchConfiguration("a")]}
        ),
        PushLaunchConfigurations(),
        UnsetLaunchConfiguration("a"),
        show("a"),
        PopLaunchConfigurations(),
        show("a"),
        ResetLaunchConfigurations({"d": "4"}),
        show("a"),
        show("d"),
        UnsetEnvironmentVariable("COFRAME_X"),
        LogInfo(msg=EnvironmentVariable("COFRAME_X", default_value="none")),
        LogInfo(msg="not shown", condition=IfCondition("false")),
    )
    assert code == 0
    assert messages(lines) == [
        *("a=2", "front+out+in", "b=3", "out", "a=1", "b=unset", "a=unset", "c=c1"),
        *("a=unset", "a=1", "a=unset", "d=4", "none"),
    ]


def test_arguments_and_includes(launched, tmp_path):
    (tmp_path / "inner.launch.py").write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import DeclareLaunchArgument, LogInfo\n"
        "from launch.substitutions import LaunchConfiguration, ThisLaunchFileDir\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([DeclareLaunchArgument('x'), DeclareLaunchArgument('y', default_value='dy'),\n"
        "        LogInfo(msg=[LaunchConfiguration('x'), LaunchConfiguration('y'), ThisLaunchFileDir()])])\n"
    )
    (tmp_path / "middle.launch.xml").write_text(
        "<launch><arg name='x'/><include file='$(dirname)/inner.launch.py'><arg name='x' value='$(var x)+'/></include>"
        "<log message='$(filename)'/></launch>"
    )
    code, lines = launched(
        IncludeLaunchDescription([str(tmp_path), "/middle.launch.xml"], launch_arguments={"x": "1"}.items()),
        show("y"),
    )
    assert code == 0
    assert messages(lines) == [f"1+dy{tmp_path}", f"{tmp_path}/middle.launch.xml", "y=dy"]
    code, lines = launched(IncludeLaunchDescription(str(tmp_path / "middle.launch.xml")))
    assert code == 1
    assert "Included launch description missing required argument 'x' (description: 'no description" in lines[0]
    code, lines = launched(IncludeLaunchDescription(str(tmp_path / "midle.launch.xml")))
    assert "No launch file " in lines[0]
    assert "Did you mean 'middle.launch.xml' or " in lines[0]
    code, lines = launched(DeclareLaunchArgument("needed", description="why"))
    assert "Required launch argument 'needed' (description: 'why') was not provided" in lines[0]
    code, lines = launched(DeclareLaunchArgument("mode", choices=["slow", "fast"]), mode="medium")
    assert "Argument \"mode\" provided value \"medium\" is not valid. Valid options are: ['slow', 'fast']" in lines[0]
    with pytest.raises(ValueError, match="is not in provided choices"):
        DeclareLaunchArgument("mode", choices=["slow"], default_value="fast")


def test_functions_coroutines_and_loops(launched):
    async def wait(_context, text):
        print(text)

    def entities(context, *args, **kwargs):
        return [LogInfo(msg=[context.launch_configurations["a"], *args, kwargs["k"]])]

    code, lines = launched(
        SetLaunchConfiguration("a", "1"),
        OpaqueFunction(function=entities, args=["2"], kwargs={"k": "3"}),
        OpaqueCoroutine(coroutine=wait, args=["from the coroutine"]),
        ForLoop(LaunchConfiguration("a"), function=lambda i: LogInfo(msg=f"loop {i}")),
        ForEach("{name: 'x', n: 1};{name: 'y', n: 2}", function=lambda n, name: [LogInfo(msg=f"{name}{n}")]),
    )
    assert code == 0
    assert messages(lines) == ["123", "loop 0", "x1", "y2"]
    assert "from the coroutine" in lines
    code, lines = launched(ForEach("{name: 'x'}", function=lambda name, n: None))  # noqa: ARG005
    assert code == 1
    assert "the function has the arguments ['n', 'name'], but the values are ['name']" in lines[0]


@pytest.mark.parametrize("length", ["10001", "1000000000"])
def test_a_loop_has_a_limited_length(launched, length):
    code, lines = launched(ForLoop(length, function=lambda i: None))  # noqa: ARG005
    assert code == 1
    assert f"ForLoop has the length {length}, which exceeds the limit of 10000" in lines[0]


def test_output_of_processes(launched, tmp_path):
    code, lines = launched(
        python("import sys; print('out'); sys.stderr.write('err'); sys.exit(3)", cwd=str(tmp_path)),
        python("import sys; print('not on the screen'); sys.stderr.write('logged err')", output="log"),
        python("import os; print(os.environ['A'], os.environ.get('HOME'))", env={"A": "x"}),
        python("import os; print(os.environ['A'] + os.environ['PATH'])", additional_env={"A": "y"}),
        python("import sys; print(sys.stdout.isatty())", emulate_tty=True),
        ExecuteProcess(cmd=["echo $((40 + 2)) 'in the shell'"], shell=True, output="screen", name="shell"),
        ExecuteProcess(cmd=["/no/such/program"], output="screen"),
        python("print('own format')", output_format="<{line}>"),
    )
    assert code == 0
    text = "\n".join(lines)
    assert "process has died [pid PID, exit code 3, cmd '" in text
    assert "process cannot be started: /no/such/program: No such file or directory" in text
    assert "<own format>" in lines
    ends = {line.partition("] ")[2] for line in lines if line.startswith(("[p-", "[shell-"))}
    assert {"out", "err", "logged err", "x None", "True", "42 in the shell", f"y{os.environ['PATH']}"} == ends
    (log,) = (tmp_path / "log").glob("*/launch.log")
    assert "not on the screen" in log.read_text()


def test_handlers_of_processes_run_in_order(launched):
    first = python("print('ready'); print(input())")
    late = LogInfo(msg="late")
    started = OnProcessStart(target_action=first, on_start=[LogInfo(msg="started")])
    code, lines = launched(
        RegisterEventHandler(started),
        RegisterEventHandler(
            OnProcessIO(
                target_action=first,
                on_stdout=lambda event: (
                    EmitEvent(event=ProcessStdin(text=b"typed\n", process_matcher=matches_action(first)))
                    if b"ready" in event.text
                    else LogInfo(msg=f"output {event.text.decode().strip()}")
                ),
            )
        ),
        RegisterEventHandler(
            OnProcessExit(
                target_action=first,
                on_exit=lambda event, _: [
                    LogInfo(msg=f"exit {event.returncode}"),
                    python("raise SystemExit(4)", on_exit=[LogInfo(msg=LocalSubstitution("event.returncode"))]),
                ],
            )
        ),
        RegisterEventHandler(OnExecutionComplete(target_action=late, on_completion=LogInfo(msg="complete"))),
        RegisterEventHandler(OnShutdown(on_shutdown=lambda event, _: LogInfo(msg=f"shutdown {event.reason}"))),
        first,
        TimerAction(period=0.01, actions=[late]),
        RegisterEventHandler(OnProcessExit(on_exit=LogInfo(msg="never")), condition=IfCondition("false")),
    )
    assert code == 0
    found = messages(lines)
    assert {"late", "complete"} <= set(found)
    assert [each for each in found if each not in {"late", "complete"}] == [
        *("started", "output typed", "exit 0", "4", "shutdown idle"),
    ]
    service = LaunchService()
    service.include_launch_description(
        LaunchDescription([RegisterEventHandler(started), UnregisterEventHandler(started)])
    )
    assert service.run() == 0


def test_a_required_process_ends_the_system_and_its_timers(launched):
    start = time.monotonic()
    code, lines = launched(
        python("import time; time.sleep(60)", name="worker"),
        python("raise SystemExit(7)", name="required", on_exit=Shutdown(reason="the required process has ended")),
        TimerAction(period=60.0, actions=[LogInfo(msg="never")]),
    )
    assert code == 0
    assert time.monotonic() - start < 10
    text = "\n".join(lines)
    assert "was required: shutting down launched system" in text
    assert "sending signal 'SIGINT' to process[worker-" in text
    assert messages(lines) == []


def test_a_process_that_ignores_signals_is_killed_with_its_children(launched, tmp_path):
    file = tmp_path / "pid"
    ignore = "import os, signal, subprocess, sys, time\nfor n in (2, 15): signal.signal(n, signal.SIG_IGN)\n"
    child = f"{ignore}open({str(file)!r}, 'w').write(str(os.getpid())); print('child', flush=True); time.sleep(60)"
    code, lines = launched(
        python(
            f"{ignore}subprocess.run([sys.executable, '-c', {child!r}])",
            sigterm_timeout="0.2",
            sigkill_timeout=["0.", "2"],
            name="stubborn",
        ),
        RegisterEventHandler(
            OnProcessIO(on_stdout=lambda event: EmitEvent(event=ShutdownEvent()) if b"child" in event.text else None)
        ),
    )
    assert code == 0
    text = "\n".join(lines)
    assert "failed to terminate '0.2' seconds after receiving 'SIGINT', escalating to 'SIGTERM'" in text
    assert "failed to terminate '0.2' seconds after receiving 'SIGTERM', escalating to 'SIGKILL'" in text
    assert "exit code -9" in text
    assert not is_running(int(file.read_text()))


def test_children_of_a_killed_process_are_ended(launched, tmp_path):
    file = tmp_path / "pid"
    code, lines = launched(
        python(
            "import os, subprocess, sys, time\n"
            "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)'])\n"
            f"open({str(file)!r}, 'w').write(str(child.pid)); os.kill(os.getpid(), 9)"
        )
    )
    assert code == 0
    assert any("exit code -9" in line for line in lines)
    assert not is_running(int(file.read_text()))


def is_running(pid):
    """Return whether a process is there that is not a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_respawn(launched, tmp_path):
    file = tmp_path / "count"
    code, lines = launched(
        python(
            f"f = open({str(file)!r}, 'a'); f.write('x')",
            respawn=True,
            respawn_delay=0.01,
            respawn_max_retries=2,
        )
    )
    assert code == 0
    assert file.read_text() == "xxx"
    assert sum("process started" in line for line in lines) == 3


def test_signals_to_single_processes(launched):
    code, lines = launched(
        python("import time; print('one', flush=True); time.sleep(60)", name="one"),
        python("import time; print('two', flush=True); time.sleep(60)", name="two"),
        RegisterEventHandler(
            OnProcessIO(
                on_stdout=lambda event: EmitEvent(
                    event=SignalProcess(signal_number="SIGTERM", process_matcher=matches_name("one"))
                    if b"one" in event.text
                    else ShutdownProcess(process_matcher=matches_name("two"))
                )
            )
        ),
    )
    assert code == 0
    text = "\n".join(lines)
    assert "exit code -15" in text
    assert "sending signal 'SIGINT' to process[two-" in text


@pytest.mark.parametrize("error", ["launch file raises", "action raises"])
def test_an_error_ends_the_system_with_exit_code_1(launched, tmp_path, error):
    file = tmp_path / "broken.launch.py"
    file.write_text("raise KeyError('missing')" if error == "launch file raises" else "x = 1")
    code, lines = launched(python("import time; time.sleep(60)"), IncludeLaunchDescription(str(file)))
    assert code == 1
    text = "\n".join(lines)
    expected = "'missing'" if error == "launch file raises" else "does not contain the required function"
    assert "Caught exception in launch (see debug for traceback): " in text
    assert expected in text
    assert "process started" not in text or "process has died" in text


def test_a_service_in_another_thread_is_shut_down_from_outside(capfd):
    service = LaunchService()
    service.include_launch_description(
        LaunchDescription([python("import time; print('up', flush=True); time.sleep(60)")])
    )
    started = threading.Event()
    service.context.register_event_handler(OnProcessIO(on_stdout=lambda _: started.set()))
    codes = []
    thread = threading.Thread(target=lambda: codes.append(service.run()))
    thread.start()
    assert started.wait(20)
    service.shutdown()
    thread.join(20)
    assert codes == [0]
    assert "process has died" in capfd.readouterr().out


def test_the_folder_of_a_launch_file_is_unknown_in_a_script(launched):
    code, lines = launched(LogInfo(msg=ThisLaunchFileDir()))
    assert code == 1
    assert "used outside of a launch file" in lines[0]


def test_ctrl_c_ends_a_script_with_a_service(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "import sys\nfrom launch import LaunchDescription, LaunchService\nfrom launch.actions import ExecuteProcess\n"
        "service = LaunchService()\n"
        "code = 'import time; print(1, flush=True); time.sleep(60)'\n"
        "process = ExecuteProcess(cmd=[sys.executable, '-c', code], output='screen')\n"
        "service.include_launch_description(LaunchDescription([process]))\nsys.exit(service.run())\n"
    )
    lines = []
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        for line in running.stdout:
            lines.append(line)
            if line.endswith("] 1\n"):
                running.send_signal(signal.SIGINT)
        assert running.wait(20) == 0
    text = "".join(lines)
    assert "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)" in text
    assert "process has died [pid" in text
    assert "Traceback" not in text.replace("[python", "") or "KeyboardInterrupt" in text
