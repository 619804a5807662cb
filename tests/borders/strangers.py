# SPDX-License-Identifier: Apache-2.0
"""What the tests of borders share: modules of strangers, and environments to meet them in."""

import os
import subprocess
from pathlib import Path
from typing import NamedTuple

PROOF = "PROOF_OF_EXECUTION"
# A module of a stranger: it leaves a file behind wherever it is imported, and stops the program.
HOSTILE = f"""
import os
open(os.environ.get("{PROOF}", os.devnull), "a").write(__file__ + "\\n")
raise SystemExit("*** imported " + __file__)
"""


class Environment(NamedTuple):
    """A virtual environment: its interpreter, and the folder of its packages."""

    python: Path
    packages: Path

    def run(self, *words: object, cwd: Path, **variables: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [str(self.python), *map(str, words)],
            cwd=cwd,
            env=clean_environment(**variables),
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )


def clean_environment(**variables: str) -> dict[str, str]:
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "COFRAME", "AMENT"))}
    return {**kept, **variables}
