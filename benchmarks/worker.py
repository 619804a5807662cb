# SPDX-License-Identifier: Apache-2.0
"""Times the statements of a module in this Python, for a benchmark that runs in another Python.

    python -m benchmarks.worker benchmarks.peers.tf2

Each input line is JSON, `[function, argument, ...]`: a function of the module that returns a `Statement`. Each output
line is `{"sample": nanoseconds}` or `{"error": text}`.
"""

import importlib
import json
import sys
from typing import Any


def main() -> None:
    module = importlib.import_module(sys.argv[1])
    statements: dict[str, Any] = {}
    answers = sys.stdout
    sys.stdout = sys.stderr  # The module and its libraries may print.
    for line in sys.stdin:
        answer: dict[str, Any]
        try:
            if line not in statements:
                function, *arguments = json.loads(line)
                statements[line] = getattr(module, function)(*arguments)
            answer = {"sample": statements[line].sample()}
        except Exception as error:  # noqa: BLE001 - the other process reports all errors
            answer = {"error": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
