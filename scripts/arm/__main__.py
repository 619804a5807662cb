# SPDX-License-Identifier: Apache-2.0
"""Cross-compile the wheel for 64-bit ARM, install it in a root of Debian, and run tests there, emulated by QEMU.

    python -m scripts.arm                            all tests of TESTS and BOTH
    python -m scripts.arm tests/sensors -k deskew    these arguments of pytest instead, emulated

Nothing is installed on this machine: everything is in build/arm, and stays there for the next time. The root has the
Python of Debian 12 or 13, so this runs with Python 3.11 or 3.13. If something is missing, one sentence says what.

Emulation shows that the code is correct for ARM's instructions. It does not show how fast it is, and not what its weak
memory order does: QEMU keeps that of this machine.
"""

from __future__ import annotations

import hashlib
import shlex
import subprocess
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from scripts.arm.debian import UnavailableError, last_line, unpack
from scripts.arm.namespace import Namespace

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).resolve().parents[2]
WORK = ROOT / "build/arm"
SUITES = {(3, 11): "bookworm", (3, 13): "trixie"}
DDS = {"bookworm": "libddsc0debian", "trixie": "libddsc0t64"}
PACKAGES = """
base-files base-passwd bash coreutils dash findutils grep hostname iproute2 procps sed util-linux
python3-venv python3-pip-whl
"""
QEMU_SUITE = "trixie"  # QEMU 7.2 of Debian 12 does not know the option of sockets by which DDS chooses an interface.
PLATFORMS = [f"manylinux{name}_aarch64" for name in ("2014", "_2_17", "_2_24", "_2_26", "_2_27", "_2_28")]
EXTRAS = ["bags", "viewer", "robots", "cli", "params", "pdf"]  # `all`, but for cyclonedds: it has no wheels for ARM
TEST_PACKAGES = ("pytest", "hypothesis", "scipy", "rosbags", "mcap")

# What the tests in the root are about, and which they are. All of tests/ would take hours.
TESTS = {
    "the installed package": "installed",
    "core": "core",
    "messages": "messages",
    "sensors": "sensors/test_kernels.py sensors/test_deskew.py sensors/test_scans.py robots/test_kinematics.py",
    "recordings": "bags/test_real.py bags/test_formats.py bags/test_writer.py",
    "DDS": "wire/test_library.py wire/test_tf_reader.py wire/test_connection.py wire/test_shared_transforms.py",
    "rclpy": "rclpy/test_services.py rclpy/test_pubsub.py rclpy/test_parameters.py rclpy/test_executors.py",
    "launch": "launch/test_substitutions.py launch/test_service.py launch/test_launch_ros.py",
    "commands": "cli/test_echo.py cli/test_help.py cli/test_streams.py cli/test_command_rows.py",
}
# Tests between a process of this machine and an emulated one, run by this machine's Python.
BOTH = ["-m", "", "-k", "another_python", "tests/wire/test_library_versions.py"]
PYTEST = ["-q", "-rs", "-p", "no:cacheprovider", "--timeout", "900"]
INSTALL = """
set -e
for name in passwd group; do cp /usr/share/base-passwd/$name.master /etc/$name; done
rm -rf /environment
python3 -m venv --without-pip /environment
pip=$(ls /usr/share/python-wheels/pip-*.whl)
/environment/bin/python "$pip/pip" install --quiet --no-compile --no-index --find-links /packages "$@"
"""


def main() -> None:
    arguments = sys.argv[1:]
    if arguments in (["-h"], ["--help"]):
        print(__doc__)
        return
    try:
        namespace, native = prepare()
    except UnavailableError as missing:
        print(f"test-arm: skipped: {missing}.")
        return
    if arguments:
        sys.exit(run(shlex.join(arguments), namespace.command(*namespace.in_root(*emulated(arguments)))))
    results = []
    for name, files in TESTS.items():
        tests = ["-n", "2", "--dist", "loadfile", *(f"tests/{file}" for file in files.split())]
        results.append(run(name, namespace.command(*namespace.in_root(*emulated(tests)))))
    results.append(run("both processors", namespace.command(*native)))
    sys.exit(max(results))


def prepare() -> tuple[Namespace, list[str]]:
    """Return the namespace in which everything is installed, and the command of the tests of both processors.

    Raises:
        UnavailableError: Something is missing that cannot be had.
    """
    suite = SUITES.get(sys.version_info[:2])
    if not sys.platform.startswith("linux") or suite is None:
        versions = " or ".join(".".join(map(str, version)) for version in SUITES)
        raise UnavailableError(f"it needs Linux and Python {versions}, which Debian has")
    WORK.mkdir(parents=True, exist_ok=True)
    root, qemu = WORK / suite, WORK / "qemu"
    step("QEMU", lambda: unpack(qemu, QEMU_SUITE, "amd64", ["qemu-user"], only="./usr/bin/qemu-aarch64"))
    step("root", lambda: unpack(root, suite, "arm64", [*PACKAGES.split(), DDS[suite]]))
    packages, wheel = WORK / f"packages-{suite}", WORK / f"wheel-{suite}"
    mounts = {"/project": ROOT, "/packages": packages, "/wheel": wheel}
    if (ROOT.parent / "shared").is_dir():
        mounts["/shared"] = ROOT.parent / "shared"
    for folder in mounts.values():
        folder.mkdir(parents=True, exist_ok=True)
    namespace = Namespace(root, qemu / "usr/bin/qemu-aarch64", mounts)
    namespace.check()
    step("packages", lambda: download_packages(packages))
    step("wheel", lambda: build_wheel(wheel))
    step("installation", lambda: install(namespace, packages, wheel))
    other = shlex.join(["chroot", str(root), "/environment/bin/python"])  # with the variables of the test
    return namespace, ["env", f"COFRAME_TEST_OTHER_PYTHON={other}", sys.executable, "-m", "pytest", *PYTEST, *BOTH]


def step(name: str, call: Callable[[], bool]) -> None:
    """Do what has not been done before, and print how long it took."""
    start = time.monotonic()
    if call():
        print(f"test-arm: {name}: {time.monotonic() - start:.0f} s", flush=True)


def requirements() -> list[str]:
    """Return what is installed in the root besides coframe."""
    import tomllib  # noqa: PLC0415 - Python 3.10 does not have it, and gets a sentence that says so

    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    tests = [each for each in extras["dev"] if each.startswith(TEST_PACKAGES)]
    return sorted({*project["dependencies"], *(each for name in EXTRAS for each in extras[name]), *tests})


def download_packages(folder: Path) -> bool:
    """Download the wheels for ARM of all packages, unless they are there.

    Raises:
        UnavailableError: The package index does not have them.
    """
    wanted, stamp = "\n".join(requirements()), folder / "complete.txt"
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == wanted:
        return False
    for wheel in folder.glob("*.whl"):
        wheel.unlink()
    platforms = [word for name in PLATFORMS for word in ("--platform", name)]
    options = ["--quiet", "--only-binary", ":all:", "--implementation", "cp", *platforms, "--dest", str(folder)]
    command = [sys.executable, "-m", "pip", "download", *options, *requirements()]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise UnavailableError(f"the package index does not have the wheels for ARM: {last_line(done.stderr)}")
    stamp.write_text(wanted, encoding="utf-8")
    return True


def build_wheel(folder: Path) -> bool:
    """Cross-compile the wheel into a folder. What has been compiled before is not compiled again."""
    options = ["--machine", "aarch64", "--out", str(folder)]
    command = [sys.executable, str(ROOT / "scripts/wheels.py"), *options, sys.executable]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.returncode)
    print(f"test-arm: {done.stdout.strip()}", flush=True)
    return True


def install(namespace: Namespace, packages: Path, folder: Path) -> bool:
    """Install the wheel and all packages in the root with pip, unless exactly these are installed."""
    (wheel,) = folder.glob("*_aarch64.whl")
    contents = hashlib.sha256(wheel.read_bytes()).hexdigest() + (packages / "complete.txt").read_text(encoding="utf-8")
    stamp = WORK / "installed.txt"
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == contents:
        return False
    words = [f"/wheel/{wheel.name}[all]", *requirements()]
    done = run("pip install", namespace.command(*namespace.in_root("sh", "-c", INSTALL, "sh", *words)))
    if done != 0:
        sys.exit(done)
    stamp.write_text(contents, encoding="utf-8")
    return True


def emulated(arguments: list[str]) -> list[str]:
    """Return the command of pytest in the root."""
    return ["sh", "-c", 'cd /project && exec python -m pytest "$@"', "sh", *PYTEST, *arguments]


def run(name: str, command: list[str]) -> int:
    """Run tests, print their output and how long they took, and return their exit code."""
    print(f"test-arm: {name}", flush=True)
    start = time.monotonic()
    code = subprocess.run(command, cwd=ROOT, check=False).returncode
    outcome = "passed" if code == 0 else f"failed ({code})"
    print(f"test-arm: {name}: {outcome}, {time.monotonic() - start:.0f} s", flush=True)
    return code


if __name__ == "__main__":
    main()
