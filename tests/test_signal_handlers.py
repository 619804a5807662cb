# SPDX-License-Identifier: Apache-2.0
"""Signal handlers of a process and of the processes that are forked from it."""

import os
import subprocess
import sys
import textwrap

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork()")

START = """
    import os, signal, sys, threading, time
    from coframe._process.signal_handlers import SignalHandlers

    def ended_by(number, prepare=lambda: None):
        ready, write = os.pipe()
        child = os.fork()
        if child == 0:
            prepare()
            os.write(write, b"x")
            while True:
                time.sleep(60)
        os.read(ready, 1)
        os.kill(child, number)
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
"""


def run(program):
    """Run a program and return its output."""
    code = textwrap.dedent(START) + textwrap.dedent(program)
    command = [sys.executable, "-W", "ignore:This process:DeprecationWarning", "-c", code]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
    return ended.stdout


def test_forked_processes_have_the_previous_handlers():
    assert run("""
        signal.signal(signal.SIGINT, lambda *_: os._exit(3))
        outer, inner = SignalHandlers(), SignalHandlers()
        outer.install(signal.SIGTERM, lambda *_: print("outer", flush=True))
        inner.install(signal.SIGTERM, lambda *_: print("inner", flush=True))
        inner.install(signal.SIGINT, lambda *_: print("inner", flush=True))
        print(ended_by(signal.SIGTERM), ended_by(signal.SIGINT), flush=True)
        thread = threading.Thread(target=lambda: print(ended_by(signal.SIGTERM), flush=True))
        thread.start()
        thread.join()
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(0)
        inner.restore()
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(0)
        outer.restore()
        assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
        assert not outer.active and not inner.active
    """).split() == ["-15", "3", "-15", "inner", "outer"]


def test_handlers_that_others_have_set_since_stay():
    assert run("""
        handlers = SignalHandlers()
        handlers.install(signal.SIGTERM, print)
        mine = lambda *_: os._exit(4)
        signal.signal(signal.SIGTERM, mine)
        print(ended_by(signal.SIGTERM), flush=True)
        print(ended_by(signal.SIGTERM, lambda: signal.signal(signal.SIGTERM, lambda *_: os._exit(5))))
        handlers.restore()
        assert signal.getsignal(signal.SIGTERM) is mine
    """).split() == ["4", "5"]


INTERRUPTED = """
    from coframe.cli.lifecycle import run_until_interrupted

    def main():
        # What an import does that generates code, such as that of a dataclass.
        with run_until_interrupted():
            exec("raise KeyboardInterrupt")
"""


@pytest.mark.parametrize("module", ["coframe.workspace.entry_point", "command"])
def test_an_interrupt_that_was_handled_in_generated_code_is_not_the_end(module, tmp_path):
    (tmp_path / "program.py").write_text(textwrap.dedent(INTERRUPTED))
    (tmp_path / "command.py").write_text(
        "import coframe.cli, coframe.cli.command_line, program\n"
        "coframe.cli.command_line.CommandLine = lambda *_: lambda words, prog_name: program.main()\n"
        "coframe.cli.run([])\n"
    )
    command = [sys.executable, "-m", module, "program:main"]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, cwd=tmp_path)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")
