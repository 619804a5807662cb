# SPDX-License-Identifier: Apache-2.0
"""A process that queries recordings: it reads the arguments of calls from its standard input, and writes the results.

Before these, it reads the folders of the modules whose classes the arguments may have. They come after all others.
"""

from __future__ import annotations

import os
import pickle
import sys
from typing import Any

from coframe.bags.batch import query_recording


def main() -> None:
    """Work until the standard input ends."""
    output = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # What libraries print is not a result.
    sys.path += [folder for folder in _received() if folder not in sys.path]
    while True:
        try:
            job = _received()
        except EOFError:
            return
        pickle.dump(query_recording(*job), output)
        output.flush()


def _received() -> Any:
    return pickle.load(sys.stdin.buffer)  # noqa: S301 - from the process that has started this one


if __name__ == "__main__":
    main()
