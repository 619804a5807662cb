# SPDX-License-Identifier: Apache-2.0
"""Worker process that queries recordings: it reads the arguments of calls from standard input and writes the results.

First it reads folders with modules of classes that the arguments may use, and appends them to the search path.
"""

from __future__ import annotations

import os
import pickle
import sys
from typing import Any

from coframe.bags.batch import query_recording


def main() -> None:
    """Process calls until standard input ends."""
    output = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # Output of libraries must not be mistaken for a result.
    sys.path += [folder for folder in _receive() if folder not in sys.path]
    while True:
        try:
            job = _receive()
        except EOFError:
            return
        pickle.dump(query_recording(*job), output)
        output.flush()


def _receive() -> Any:
    return pickle.load(sys.stdin.buffer)  # noqa: S301 - from the process that has started this one


if __name__ == "__main__":
    main()
