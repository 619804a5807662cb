# SPDX-License-Identifier: Apache-2.0
"""Check the directions of imports with import-linter; the contracts are in pyproject.toml.

An editable installation makes more folders importable than those of the sources, among them the folder around the
checkout. In a checkout named coframe, import-linter would therefore take the whole checkout for the package. So this
program starts a Python without installed search paths.

Example:
    python scripts/check_imports.py [FOLDER]    FOLDER contains pyproject.toml and src; by default this checkout
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LINT = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True))"


def main() -> int:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT).resolve()
    paths = [folder / "src", folder / "src" / "ros", sysconfig.get_path("purelib"), sysconfig.get_path("platlib")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, paths))}
    # -S ignores the files that extend the search paths of an installation.
    return subprocess.run([sys.executable, "-S", "-c", LINT], cwd=folder, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
