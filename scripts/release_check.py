# SPDX-License-Identifier: Apache-2.0
"""Check a release before it is published: what is in dist/, the changelog and the documentation.

    python scripts/release_check.py [--dist dist] [--no-docs]

Prints every problem and exits with 1 if there is one. `make wheels` fills dist/; `make docs` checks the links.
"""

from __future__ import annotations

import argparse
import gzip
import json
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import venv
import zipfile
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).resolve().parents[1]
MEGABYTE = 1_000_000
# Both without Cyclone DDS, which the wheels of some platforms contain.
MAX_WHEEL = 3.1 * MEGABYTE  # the download; NumPy is the only other one
MAX_UNPACKED = 6.7 * MEGABYTE
MAX_SDIST = 10 * MEGABYTE
PAGE = "coframe/viewer/static/assets/"
BUNDLED = "coframe/_bundled/"
# Wheels for which the package cyclonedds has none: Python 3.14, without the GIL, musl, ARM.
WITHOUT_CYCLONEDDS = re.compile(r"-cp3(1[4-9]|[2-9]\d)-|-cp\d+t-|-musllinux_|-[a-z0-9_]*linux_[0-9_]*aarch64")


def check_files(dist: Path) -> Iterator[str]:
    """Check the names and versions of the files."""
    wheels, sdists = sorted(dist.glob("*.whl")), sorted(dist.glob("*.tar.gz"))
    if not wheels:
        yield f"{dist} has no wheel. Run: make wheels"
    if len(sdists) != 1:
        yield f"{dist} has {len(sdists)} source distributions instead of one. Run: make sdist"
    versions = {path.name.removesuffix(".tar.gz").split("-")[1] for path in wheels + sdists}
    if len(versions) > 1:
        yield f"the files in {dist} have different versions: {', '.join(sorted(versions))}"
    tag = os.environ.get("GITHUB_REF", "")
    if tag.startswith("refs/tags/v"):
        version = tag.removeprefix("refs/tags/v")
        if versions != {version}:
            yield f"the tag is v{version}, the files have version {', '.join(sorted(versions))}"
        if f"\n## {version}" not in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"):
            yield f"CHANGELOG.md has no section {version}"
        if any(wheel.name.endswith(("-linux_x86_64.whl", "-linux_aarch64.whl")) for wheel in wheels):
            yield "a Linux wheel was not repaired by auditwheel"


def check_wheel(path: Path) -> Iterator[str]:
    """Check sizes, and that every bundled part comes with its license."""
    with zipfile.ZipFile(path) as wheel:
        names = wheel.namelist()
        bundled = [info for info in wheel.infolist() if info.filename.startswith(BUNDLED)]
        download = path.stat().st_size - sum(info.compress_size for info in bundled)
        unpacked = sum(info.file_size for info in wheel.infolist()) - sum(info.file_size for info in bundled)
        parts = ", ".join(f"{kind} {size / MEGABYTE:.1f}" for kind, size in largest_parts(wheel))
        scripts = page_scripts(wheel)
        (metadata,) = (wheel.read(name).decode() for name in names if re.fullmatch(r"[^/]*\.dist-info/METADATA", name))
    print(f"{path.name}: {download / MEGABYTE:.1f} MB, unpacked {unpacked / MEGABYTE:.1f} MB ({parts}, ...)")
    if download > MAX_WHEEL or unpacked > MAX_UNPACKED:
        yield f"{path.name} is larger than {MAX_WHEEL / MEGABYTE:g} MB, or {MAX_UNPACKED / MEGABYTE:g} MB unpacked"
    if not any(re.fullmatch(r"coframe-[^/]*\.dist-info/licenses/LICENSE", name) for name in names):
        yield f"{path.name} has no LICENSE"
    if "coframe_ros.pth" not in names:
        yield f"{path.name} has no coframe_ros.pth: `import rclpy` would fail"
    if link := re.search(r"\]\((?!https?:|#)[^)]*\)", metadata):
        yield f"{path.name}: the description has the link {link[0][2:-1]}, which the package index does not have"
    if WITHOUT_CYCLONEDDS.search(path.name) and not any(name.startswith(BUNDLED) for name in names):
        yield f"{path.name} has no DDS library, and no package has one: set COFRAME_BUNDLE (docs/releasing.md)"
    yield from (f"{path.name}: {problem}" for problem in missing_licenses(names, scripts))


def missing_licenses(names: list[str], scripts: str) -> Iterator[str]:
    """Check that the parts by others come with their licenses: Cyclone DDS, JavaScript libraries, the viewer's page."""
    bundled = [name for name in names if name.startswith(BUNDLED)]
    if bundled and not any("licen" in name.lower() or "notice" in name.lower() for name in bundled):
        yield f"it contains {', '.join(bundled)} without a license"
    for name in names:
        if name.endswith(".min.js") and f"{name.removesuffix('.min.js')}.LICENSE" not in names:
            yield f"it contains {name} without a license"
    packages = json.loads((ROOT / "viewer/package.json").read_text(encoding="utf-8"))["dependencies"]
    for package in packages:
        short = package.rpartition("/")[2]
        if not re.search(rf"^{short}(\.js)?,", scripts, re.MULTILINE | re.IGNORECASE):
            yield f"the notice in the viewer's page does not name {package}"


def largest_parts(wheel: zipfile.ZipFile, count: int = 5) -> list[tuple[str, int]]:
    """Return the kinds of files that take most of the installed bytes, and these bytes."""
    sizes: Counter[str] = Counter()
    for info in wheel.infolist():
        if not info.filename.startswith(BUNDLED):
            sizes[Path(info.filename).suffix or "other"] += info.file_size
    return sizes.most_common(count)


def page_scripts(wheel: zipfile.ZipFile) -> str:
    """Return the JavaScript of the viewer's page."""
    names = [name for name in wheel.namelist() if name.startswith(PAGE) and name.endswith((".js", ".js.gz"))]
    files = [gzip.decompress(wheel.read(name)) if name.endswith(".gz") else wheel.read(name) for name in names]
    return b"".join(files).decode()


def check_sdist(path: Path) -> Iterator[str]:
    """Check that the sources are complete and small."""
    with tarfile.open(path) as sdist:
        names = {name.partition("/")[2] for name in sdist.getnames()}
    if path.stat().st_size > MAX_SDIST:
        yield f"{path.name} is larger than {MAX_SDIST // MEGABYTE} MB"
    for needed in ("PKG-INFO", "LICENSE", "CMakeLists.txt", "src/coframe_ros.pth.in", "native/bindings/module.cpp"):
        if needed not in names:
            yield f"{path.name} does not contain {needed}"


def check_metadata(files: list[Path]) -> Iterator[str]:
    """Run `twine check --strict`."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = Path(folder) / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
        subprocess.run([python, "-m", "pip", "install", "--quiet", "twine>=6,<8"], check=True)
        result = subprocess.run(
            [python, "-m", "twine", "check", "--strict", *files], capture_output=True, text=True, check=False
        )
    if result.returncode != 0:
        yield f"twine check failed:\n{result.stdout}{result.stderr}"


def check_documentation() -> Iterator[str]:
    """Build the site, whose warnings and broken links are errors."""
    if subprocess.run(["make", "--silent", "docs"], cwd=ROOT, check=False).returncode != 0:
        yield "make docs failed"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dist", type=Path, default=ROOT / "dist")
    parser.add_argument("--no-docs", action="store_true", help="do not build the documentation")
    arguments = parser.parse_args()
    files = sorted(arguments.dist.glob("coframe-*"))
    problems = list(check_files(arguments.dist))
    for path in files:
        problems += check_wheel(path) if path.suffix == ".whl" else check_sdist(path)
    if files:
        problems += check_metadata(files)
    if not arguments.no_docs:
        problems += check_documentation()
    for problem in problems:
        print(f"release-check: {problem}", file=sys.stderr)
    print(f"release-check: {len(files)} files, {len(problems)} problems")
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main())
