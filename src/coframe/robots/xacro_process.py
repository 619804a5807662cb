# SPDX-License-Identifier: Apache-2.0
"""Expand one xacro file in a separate process with limited memory. See :mod:`coframe.robots.files`.

With arguments, it runs them as a command with the same limits. Otherwise the request and the answer are JSON on
standard input and output. The file is run as a script, and imports the native core only for ``$(find PACKAGE)``,
because that import takes longer than everything else.
"""

from __future__ import annotations

import contextlib
import io
import json
import os
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["MAX_MEMORY", "MAX_OUTPUT", "MAX_SECONDS"]

MAX_SECONDS = 20.0
MAX_MEMORY = 2 << 30  # bytes
MAX_OUTPUT = 64 << 20  # characters of a URDF


def _answer(request: Mapping[str, Any]) -> dict[str, Any]:
    import xacro  # noqa: PLC0415 - found in the folders of the request
    from xacro import substitution_args  # noqa: PLC0415

    from coframe._files.regular_files import read_regular_text  # noqa: PLC0415

    def find(name: str) -> str:
        from coframe.robots._packages import Packages  # noqa: PLC0415

        return str(Packages(request["path"], request["packages"]).find(name))

    # xacro has no public hooks for its files and for $(find PACKAGE), which otherwise requires an installed ROS.
    substitution_args._eval_find = find  # noqa: SLF001
    xacro.open = lambda path: io.StringIO(read_regular_text(path, MAX_OUTPUT))
    try:
        text = xacro.process_file(request["path"], mappings=request["arguments"]).toprettyxml(indent="  ")
    except OSError as error:
        return {"os_error": [error.errno, error.strerror or str(error), error.filename]}
    except Exception as error:  # noqa: BLE001 - Python expressions in the file can raise any exception
        cause = getattr(error, "exc", None) or error  # xacro wraps exceptions
        if isinstance(cause, MemoryError):
            return {"error": f"xacro: the file needs more memory than the maximum of {MAX_MEMORY >> 30} GiB"}
        if isinstance(cause, RecursionError):
            hint = "Check whether a macro or an included file contains itself, directly or through others."
            return {"error": "xacro: the file is nested too deeply to be expanded", "hint": hint}
        return {"error": f"xacro: {_reason(error, cause)}", "hint": getattr(cause, "hint", "")}
    if len(text) > MAX_OUTPUT:
        return {"error": f"the expanded file is larger than the maximum of {MAX_OUTPUT >> 20} MiB"}
    return {"text": text}


def _reason(error: Exception, cause: Exception) -> str:
    """Return the message of an exception, without the class and the repeated cause that xacro adds."""
    text = str(error)
    if cause is not error and text.startswith("<class "):
        text = " ".join(filter(None, (str(cause), getattr(error, "suffix", None))))
    return text or type(error).__name__


def _main() -> None:
    with contextlib.suppress(ImportError):  # Windows has no such limits.
        import resource  # noqa: PLC0415

        _, most = resource.getrlimit(resource.RLIMIT_AS)
        with contextlib.suppress(ValueError, OSError):  # macOS rejects the limit.
            resource.setrlimit(resource.RLIMIT_AS, (MAX_MEMORY, most))
        _, most = resource.getrlimit(resource.RLIMIT_FSIZE)
        with contextlib.suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_FSIZE, (MAX_OUTPUT, most))
    if len(sys.argv) > 1:
        os.execv(sys.argv[1], sys.argv[1:])  # noqa: S606 - the command of the caller
    request = json.load(sys.stdin)
    sys.path[:] = request["module_folders"]
    output, sys.stdout = sys.stdout, sys.stderr  # Output printed by the file must not be mistaken for the answer.
    json.dump(_answer(request), output)


if __name__ == "__main__":
    _main()
