# SPDX-License-Identifier: Apache-2.0
"""Run one of the programs that were recorded on ROS 2 Humble: `run_program.py PROGRAM [ARGUMENT ...]`.

The programs import a module `h` with one function, which prints the result of a call or the exception it raised. It is
defined here, so that the programs run with any Python and any folder.
"""

from __future__ import annotations

import os
import re
import runpy
import sys
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable


def show(text: str) -> str:
    """Return the text without addresses and folders, which differ between runs and machines."""
    text = re.sub(r"0x[0-9a-f]{6,}", "0xADDR", text)
    return re.sub(r"/[^ ]*?/(rclpy|tf2_ros|[a-z_]+msgs)", r"LIB/\1", text)


def T(label: str, call: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:  # noqa: N802 - the programs use this name
    """Print the result of a call, or the exception that it raised."""
    try:
        result = call(*args, **kwargs)
        print(f"{label}: {show(repr(result))}")
    except BaseException as error:  # noqa: BLE001 - KeyboardInterrupt is a result as well
        print(f"{label}: !! {type(error).__module__}.{type(error).__name__}: {show(str(error))}")
        return None
    return result


if __name__ == "__main__":
    program = Path(sys.argv[1]).resolve()
    helper = ModuleType("h")
    helper.T = T  # type: ignore[attr-defined]
    sys.modules["h"] = helper
    sys.argv = [program.name, *sys.argv[2:]]
    sys.dont_write_bytecode = True
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    os.chdir(program.parent)
    runpy.run_path(str(program), run_name="__main__")
