"""Times the statements of a module in this Python, for a benchmark in another one.

    python -m benchmarks.worker benchmarks.peers.tf2

Each line of the input is JSON, `[function, argument, ...]`: a function of the module that makes a `Statement`. The
answer is a line, too: `{"sample": nanoseconds}`, or `{"error": text}`.
"""

import importlib
import json
import sys
from typing import Any


def main() -> None:
    module = importlib.import_module(sys.argv[1])
    statements: dict[str, Any] = {}
    answers = sys.stdout
    sys.stdout = sys.stderr  # what the module or its libraries print
    for line in sys.stdin:
        answer: dict[str, Any]
        try:
            if line not in statements:
                function, *arguments = json.loads(line)
                statements[line] = getattr(module, function)(*arguments)
            answer = {"sample": statements[line].sample()}
        except Exception as error:  # noqa: BLE001 - whatever it is, the other side tells
            answer = {"error": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main()
