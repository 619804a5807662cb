# SPDX-License-Identifier: Apache-2.0
"""Logging of a launched system: messages and the output of processes, on the screen and in a log file."""

from __future__ import annotations

import datetime
import logging
import os
import socket
import sys
import tempfile
from pathlib import Path
from typing import Any, Final

from coframe._files.bounded_lines import print_bounded

__all__ = ["ProcessOutput", "get_logger", "get_output_loggers", "launch_config", "reset"]

_SCREEN_FORMATS: Final = {
    "default": "[{levelname}] [{name}]: {message}",
    "verbose": "{asctime} [{levelname}] [{name}]: {message}",
    "default_with_timestamp": "{created:.7f} [{levelname}] [{name}]: {message}",
}
_FILE_FORMAT: Final = "{created:.7f} [{levelname}] [{name}]: {message}"
_LEVEL_COLORS: Final = {logging.WARNING: "33", logging.ERROR: "31", logging.CRITICAL: "31;1"}
_PROCESS_COLORS: Final = ("36", "32", "35", "34", "96", "92", "95", "94")
# Where the keywords of `output=` send the two streams.
_OUTPUTS: Final[dict[str, dict[str, set[str]]]] = {
    "screen": {"both": {"screen"}},
    "log": {"both": {"log"}, "stderr": {"screen"}},
    "both": {"both": {"log", "screen"}},
    "own_log": {"both": {"own_log"}, "stdout": {"own_log"}, "stderr": {"own_log"}},
    "full": {"both": {"screen", "log", "own_log"}, "stdout": {"own_log"}, "stderr": {"own_log"}},
}


class LaunchConfig:
    """Settings of the logging: the level and the folder of the log files."""

    def __init__(self) -> None:
        self._log_dir: Path | None = None
        self._root = logging.RootLogger(logging.INFO)
        self._manager = logging.Manager(self._root)
        self._screen = _ScreenHandler()
        self._root.addHandler(self._screen)

    @property
    def level(self) -> int:
        """The lowest level that is logged."""
        return self._root.level

    @level.setter
    def level(self, level: int | str) -> None:
        self._root.setLevel(level)

    @property
    def log_dir(self) -> str:
        """The folder of the log files of this run. It is created at the first use."""
        if self._log_dir is None:
            self.log_dir = str(_new_log_folder())
        return str(self._log_dir)

    @log_dir.setter
    def log_dir(self, folder: str) -> None:
        self.reset_log_dir()
        self._log_dir = Path(folder)
        self._log_dir.mkdir(parents=True, exist_ok=True)
        file = logging.FileHandler(self._log_dir / "launch.log", encoding="utf-8", errors="replace", delay=True)
        file.setFormatter(logging.Formatter(os.environ.get("OVERRIDE_LAUNCH_LOG_FORMAT", _FILE_FORMAT), style="{"))
        self._root.addHandler(file)

    def reset_log_dir(self) -> None:
        """Close the log file, and choose a new folder at the next use."""
        self._log_dir = None
        for handler in [each for each in self._root.handlers if isinstance(each, logging.FileHandler)]:
            self._root.removeHandler(handler)
            handler.close()

    def reset(self) -> None:
        """Forget the folder of the log files, and restore the level and the formats."""
        self.reset_log_dir()
        self.level = logging.INFO
        self._screen.format_name = None

    def get_screen_handler(self) -> logging.Handler:
        """Return the handler that prints messages on the screen."""
        return self._screen

    def get_log_file_handler(self, file_name: str = "launch.log") -> logging.Handler:
        """Return the handler that writes messages to a file of this run."""
        path = Path(self.log_dir) / file_name
        known = (each for each in self._root.handlers if isinstance(each, logging.FileHandler))
        found = next((each for each in known if Path(each.baseFilename) == path.absolute()), None)
        return found or logging.FileHandler(path, encoding="utf-8", errors="replace", delay=True)

    def set_screen_format(self, screen_format: str, *, screen_style: str | None = None) -> None:
        """Set the format of messages on the screen: ``default``, ``verbose``, or a format of ``str.format``."""
        del screen_style
        self._screen.format_name = screen_format

    def set_log_format(self, log_format: str, *, log_style: str | None = None) -> None:
        """Set the format of messages in the log file: ``default``, or a format of ``str.format``."""
        del log_style
        text = _FILE_FORMAT if log_format == "default" else log_format
        self.get_log_file_handler().setFormatter(logging.Formatter(text, style="{"))

    def get_log_file_path(self, file_name: str = "launch.log") -> str:
        """Return the path of a log file of this run."""
        return str(Path(self.log_dir) / file_name)

    def get_logger(self, name: str) -> logging.Logger:
        """Return the logger with this name."""
        return self._manager.getLogger(name)

    def log_line(self, name: str, line: str) -> None:
        """Write a line of a process only to the log file."""
        record = logging.LogRecord(name, logging.INFO, "", 0, line, (), None)
        for handler in self._root.handlers:
            if isinstance(handler, logging.FileHandler):
                handler.handle(record)


class _ScreenHandler(logging.Handler):
    """Prints messages on the present standard output, which a program may replace."""

    format_name: str | None = None

    def emit(self, record: logging.LogRecord) -> None:
        chosen = os.environ.get("OVERRIDE_LAUNCH_SCREEN_FORMAT", self.format_name or "default")
        text = logging.Formatter(_SCREEN_FORMATS.get(chosen, chosen), style="{").format(record)
        _print(text, _LEVEL_COLORS.get(record.levelno, ""))


class ProcessOutput:
    """The two streams of a process: complete lines go to the screen, to launch.log and to their own files.

    Args:
        name: Name of the process, the prefix of its lines on the screen.
        output: A keyword such as ``"screen"``, or a dictionary of streams and destinations.
        line_format: Function that returns the text for a line.
    """

    def __init__(self, name: str, output: str | dict[str, Any], line_format: Any) -> None:
        self._name = name
        self._destinations = _destinations(output)
        self._line_format = line_format
        self._pending = {"stdout": b"", "stderr": b""}
        _ = launch_config.log_dir  # The log file is there as soon as a process is.
        # The number at the end of the name gives neighbors different colors.
        number = name.rpartition("-")[2]
        self._color = _PROCESS_COLORS[int(number) % len(_PROCESS_COLORS)] if number.isdecimal() else ""

    def write(self, stream: str, data: bytes) -> None:
        """Write the complete lines that a stream has received so far."""
        *lines, self._pending[stream] = (self._pending[stream] + data).split(b"\n")
        for line in lines:
            self._write_line(stream, line)

    def flush(self) -> None:
        """Write the last lines, which have no line end."""
        for stream, rest in self._pending.items():
            if rest:
                self._write_line(stream, rest)
                self._pending[stream] = b""

    def _write_line(self, stream: str, data: bytes) -> None:
        line = data.decode(errors="replace").rstrip("\r")
        destinations = self._destinations[stream]
        text = self._line_format(line)
        if "screen" in destinations:
            prefix = f"[{self._name}]"
            if text.startswith(prefix) and self._color:
                _print(text, self._color, colored=len(prefix))
            else:
                _print(text)
        if "log" in destinations:
            launch_config.log_line(self._name, line)
        if "own_log" in destinations:
            for file_name in (f"{self._name}-{stream}.log", f"{self._name}-combined.log"):
                with Path(launch_config.log_dir, file_name).open("a", encoding="utf-8") as file:
                    file.write(line + "\n")


def _destinations(output: str | dict[str, Any]) -> dict[str, set[str]]:
    output = os.environ.get("OVERRIDE_LAUNCH_PROCESS_OUTPUT", output)
    if isinstance(output, str):
        if output not in _OUTPUTS:
            raise ValueError(
                f"'{output}' is not a valid standard output config, expected one of: {', '.join(_OUTPUTS)}"
            )
        chosen: dict[str, Any] = _OUTPUTS[output]
    else:
        chosen = output
    if unknown := set(chosen) - {"stdout", "stderr", "both"}:
        raise ValueError(f"{sorted(unknown)} are not streams of a process, expected 'stdout', 'stderr' or 'both'")
    found: dict[str, set[str]] = {"stdout": set(), "stderr": set()}
    for stream, destinations in chosen.items():
        words = {destinations} if isinstance(destinations, str) else set(destinations)
        if unknown := words - {"screen", "log", "own_log"}:
            raise ValueError(f"{sorted(unknown)} are not outputs, expected 'screen', 'log' or 'own_log'")
        for name in ("stdout", "stderr") if stream == "both" else (stream,):
            found[name] |= words
    return found


def _print(text: str, color: str = "", *, colored: int | None = None) -> None:
    if color and _use_color():
        end = len(text) if colored is None else colored
        text = f"\x1b[{color}m{text[:end]}\x1b[0m{text[end:]}"
    try:
        print_bounded(text)
    except UnicodeEncodeError:
        print_bounded(text.encode("ascii", "replace").decode())
    except (BrokenPipeError, ValueError):  # The reader of the output is gone; the processes continue.
        pass


def _use_color() -> bool:
    choice = os.environ.get("RCUTILS_COLORIZED_OUTPUT", "")
    if choice in {"0", "1"}:
        return choice == "1"
    return "NO_COLOR" not in os.environ and sys.stdout.isatty()


def _new_log_folder() -> Path:
    home = os.environ.get("ROS_HOME") or str(Path("~", ".ros").expanduser())
    base = Path(os.environ.get("ROS_LOG_DIR") or str(Path(home, "log"))).expanduser()
    now = datetime.datetime.now().astimezone().strftime("%Y-%m-%d-%H-%M-%S-%f")
    folder = base / f"{now}-{socket.gethostname()}-{os.getpid()}"
    try:
        folder.mkdir(parents=True)
    except OSError:  # a read-only home
        folder = Path(tempfile.mkdtemp(prefix="launch_logs_"))
    return folder


launch_config = LaunchConfig()


def get_logger(name: str | None = None) -> logging.Logger:
    """Return the logger with this name, whose messages go to the screen and to launch.log."""
    return launch_config.get_logger(name or "launch")


def get_output_loggers(process_name: str, output_config: str | dict[str, Any]) -> tuple[logging.Logger, logging.Logger]:
    """Return loggers for the lines of standard output and standard error of a process."""
    _destinations(output_config)
    return get_logger(f"{process_name}-stdout"), get_logger(f"{process_name}-stderr")


def reset() -> None:
    """Forget the folder of the log files, and restore the level and the formats."""
    launch_config.reset()
