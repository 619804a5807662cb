# SPDX-License-Identifier: Apache-2.0
"""Check that each source file names its license in one of its first lines.

Example:
    python scripts/check_spdx.py          list the files without an SPDX line
    python scripts/check_spdx.py --fix    add the line to them
"""

from __future__ import annotations

import fnmatch
import sys
from pathlib import Path

from tracked_files import tracked

ROOT = Path(__file__).resolve().parents[1]
LINE = "SPDX-License-Identifier: Apache-2.0"
COMMENTS = {
    **dict.fromkeys((".py", ".pyi", ".sh", ".yml", ".yaml", ".cff", ".toml"), "# {}"),
    **dict.fromkeys((".cpp", ".hpp", ".inc", ".ts"), "// {}"),
    ".css": "/* {} */",
}
# Generated files, data, and files whose format has no room for it.
SKIPPED = (
    "*/generated/*",
    "src/ros/*_msgs/*",
    "src/ros/*_interfaces/*",
    "src/ros/std_srvs/*",
    "src/ros/robot_localization/*",
    "src/ros/unitree_go/*",
    "src/ros/rmw_dds_common/*",
    *(f"src/ros/turtlesim/{part}" for part in ("__init__.py", "msg/*", "srv/*", "action/*")),
    "*/static/*",
)


def main() -> int:
    missing = [path for path in tracked() if is_checked(path) and not has_line(ROOT / path)]
    if "--fix" in sys.argv:
        for path in missing:
            add_line(ROOT / path)
        return 0
    for path in missing:
        print(f"{path}: no line with {LINE!r}")
    return 1 if missing else 0


def is_checked(path: str) -> bool:
    return Path(path).suffix in COMMENTS and not any(fnmatch.fnmatch(path, pattern) for pattern in SKIPPED)


def has_line(file: Path) -> bool:
    text = file.read_text("utf-8", errors="replace")
    return not text or LINE in "\n".join(text.splitlines()[:3])


def add_line(file: Path) -> None:
    first, rest = "", file.read_text(encoding="utf-8")
    if rest.startswith("#!"):
        first, _, rest = rest.partition("\n")
        first += "\n"
    file.write_text(f"{first}{COMMENTS[file.suffix].format(LINE)}\n{rest}", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
