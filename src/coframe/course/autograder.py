# SPDX-License-Identifier: Apache-2.0
"""Write complete packages that grade submissions elsewhere: Gradescope, GitHub Classroom, and a Docker image."""

from __future__ import annotations

import re
import shutil
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.complete_files import write_complete
from coframe.course.translation.language import ENGLISH
from coframe.errors import CourseError

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.course.translation.language import Language

__all__ = ["PLATFORMS", "needs_newest_glibc", "write_autograder"]

# The name becomes part of scripts, so it has only the characters of a version and of tags.
_WHEEL = re.compile(r"coframe-[\w.+]+(-\d\w*)?-(?P<python>\w+)-(?P<abi>\w+)-(?P<platform>[\w.]+)\.whl", re.ASCII)
_DEFAULT_PYTHON = "3.12"  # for a wheel of the stable ABI, which runs on any version
# Gradescope and GitHub run Linux on x86-64 with glibc. Docker runs the image on the processor of its machine.
_PROCESSORS = {"gradescope": ("x86_64",), "classroom": ("x86_64",), "docker": ("x86_64", "aarch64")}
_EXTRAS = "all"
_GRADESCOPE_ARCHIVE = "autograder.zip"
_EXECUTABLE = 0o755

_SETUP = """#!/usr/bin/env bash
# Gradescope runs this once, when the image of the autograder is built.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
apt-get update
if ! apt-get install -y python{python} python{python}-venv; then
    apt-get install -y software-properties-common
    add-apt-repository -y ppa:deadsnakes/ppa
    apt-get update
    apt-get install -y python{python} python{python}-venv
fi
python{python} -m venv /opt/lab
/opt/lab/bin/python -m pip install "/autograder/source/{wheel}[{extras}]"
"""
_RUN = """#!/usr/bin/env bash
# Gradescope runs this for each submission.
set -euo pipefail
mkdir -p /autograder/results
/opt/lab/bin/coframe lab check /autograder/submission{options} --gradescope /autograder/results/results.json
"""
_WORKFLOW = """name: Autograding
on: [push, workflow_dispatch, repository_dispatch]
permissions:
  checks: write
  actions: read
  contents: read
jobs:
  lab:
    runs-on: ubuntu-latest
    if: github.actor != 'github-classroom[bot]'
    timeout-minutes: 30
    steps:
      - uses: actions/checkout@v4
      - uses: actions/setup-python@v5
        with:
          python-version: "{python}"
      - name: Install coframe
        run: python -m pip install ".github/classroom/{wheel}[{extras}]"
      - name: Check the lab
        id: lab
        run: |
          cd "$RUNNER_TEMP"
          coframe lab check "$GITHUB_WORKSPACE"{options} --classroom result.json
          echo "result=$(base64 --wrap=0 result.json)" >> "$GITHUB_OUTPUT"
      - name: Report the result
        uses: classroom-resources/autograding-grading-reporter@v1
        env:
          LAB_RESULTS: ${{{{ steps.lab.outputs.result }}}}
        with:
          runners: lab
"""
_DOCKERFILE = """# Grades a class. Create the folder for the grades first: Docker would create it for root.
#   docker build -t lab . && mkdir -p grades
#   docker run --rm --network none --user "$(id -u):$(id -g)" --env HOME=/tmp \\
#     --security-opt seccomp=unconfined --security-opt apparmor=unconfined --security-opt systempaths=unconfined \\
#     -v "$PWD/submissions:/class:ro" -v "$PWD/grades:/grades" lab
# Programs of students need namespaces with mounts and a /proc of their own. Docker's default profiles for seccomp and
# AppArmor and its masked paths forbid them. Without them, the report says what is not protected.
FROM python:{python}-slim
COPY {wheel} /tmp/
RUN python -m pip install --no-cache-dir "/tmp/{wheel}[{extras}]" && rm /tmp/{wheel} \\
    && useradd --create-home grader && mkdir /class /grades && chown grader /grades
USER grader
WORKDIR /grades
ENTRYPOINT ["coframe", "lab", "check", "--all", "/class", "-o", "/grades/grades.csv", "--resume"{options}]
"""


class _Plan(NamedTuple):
    """What the files of a package contain.

    Attributes:
        wheel: The wheel.
        python: The version of Python for which the wheel is built, such as "3.12".
        variant: The seed of the variant of all submissions, or None for that in each folder.
        language: The language of the feedback.
    """

    wheel: Path
    python: str
    variant: int | None
    language: Language

    def fill(self, template: str, *, as_list: bool = False) -> str:
        """Return a template with the values."""
        options = [] if self.variant is None else [f"--variant={self.variant}"]
        options += [] if self.language is ENGLISH else [f"--language={self.language.code}"]
        words = "".join(f', "{option}"' if as_list else f" {option}" for option in options)
        return template.format(wheel=self.wheel.name, python=self.python, extras=_EXTRAS, options=words)


def write_autograder(
    platform: str, folder: Path, wheel: Path, variant: int | None = None, language: Language = ENGLISH
) -> list[Path]:
    """Write the package for a platform, and return its files; the first one is what the teacher uses.

    Args:
        platform: One of PLATFORMS.
        folder: The folder for the files.
        wheel: A wheel of coframe, which the package installs.
        variant: The variant of all submissions. None for that in each folder.
        language: The language of the feedback.

    Raises:
        CourseError: The wheel is not one of coframe or cannot be installed there, or a file already exists or cannot
            be written.
    """
    plan = _Plan(wheel, _python_of(wheel, platform), variant, language)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return PLATFORMS[platform](plan, folder)
    except OSError as error:
        raise CourseError(
            f"Cannot write {error.filename or folder}: {error.strerror}.", hint="Choose another folder."
        ) from None


def needs_newest_glibc(wheel: Path) -> bool:
    """Return whether a wheel may need the C library of the machine that built it: its name states no older one."""
    match = _WHEEL.fullmatch(wheel.name)
    return match is not None and match["platform"].startswith("linux_")


def _python_of(wheel: Path, platform: str) -> str:
    """Return the version of Python that a wheel needs."""
    match = _WHEEL.fullmatch(wheel.name)
    if match is None or not _contains_coframe(wheel):
        raise CourseError(
            f"{wheel} is not a wheel of coframe.",
            hint="Build one in a checkout of coframe: make wheels.",
        )
    version = re.fullmatch(r"cp3(\d+)", match["python"])
    if version is None or match["abi"] not in {match["python"], "abi3"}:
        raise CourseError(
            f"{wheel.name} is for {match['python']} with ABI {match['abi']}, but the graders run CPython with the GIL.",
            hint="Build the wheel with CPython: make wheels.",
        )
    usable = re.compile(rf"(many)?linux\w*_({'|'.join(_PROCESSORS[platform])})")
    if not any(map(usable.fullmatch, match["platform"].split("."))):
        processors = " or ".join(_PROCESSORS[platform])
        raise CourseError(
            f"{wheel.name} is for {match['platform']}, but {platform} runs Linux with glibc on {processors}.",
            hint="Build the wheel on such a machine: make wheels.",
        )
    return _DEFAULT_PYTHON if match["abi"] == "abi3" else f"3.{version[1]}"


def _contains_coframe(wheel: Path) -> bool:
    """Return whether a file is a zip file with the package coframe."""
    try:
        with zipfile.ZipFile(wheel) as archive:
            return "coframe/__init__.py" in archive.namelist()
    except (OSError, zipfile.BadZipFile):
        return False


def _write(path: Path, text: str, *, executable: bool = False) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.exists():
        raise CourseError(f"{path} already exists.", hint="Choose another folder: nothing is overwritten.")
    write_complete(path, text.encode())
    if executable:
        path.chmod(_EXECUTABLE)
    return path


def _copy_wheel(plan: _Plan, folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    return Path(shutil.copyfile(plan.wheel, folder / plan.wheel.name))


def _write_gradescope(plan: _Plan, folder: Path) -> list[Path]:
    """Write a zip file with the names that Gradescope expects; its entries are executable."""
    archive = folder / _GRADESCOPE_ARCHIVE
    if archive.exists():
        raise CourseError(f"{archive} already exists.", hint="Choose another folder: nothing is overwritten.")
    with zipfile.ZipFile(archive, "x", zipfile.ZIP_DEFLATED) as file:
        for name, template in (("setup.sh", _SETUP), ("run_autograder", _RUN)):
            entry = zipfile.ZipInfo(name, date_time=(2020, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100000 | _EXECUTABLE) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            file.writestr(entry, plan.fill(template))
        file.write(plan.wheel, plan.wheel.name)
    return [archive]


def _write_classroom(plan: _Plan, folder: Path) -> list[Path]:
    """Write the files for the repository from which GitHub Classroom creates those of the students."""
    workflow = _write(folder / ".github" / "workflows" / "classroom.yml", plan.fill(_WORKFLOW))
    return [workflow, _copy_wheel(plan, folder / ".github" / "classroom")]


def _write_docker(plan: _Plan, folder: Path) -> list[Path]:
    return [_write(folder / "Dockerfile", plan.fill(_DOCKERFILE, as_list=True)), _copy_wheel(plan, folder)]


PLATFORMS: dict[str, Callable[[_Plan, Path], list[Path]]] = {
    "gradescope": _write_gradescope,
    "classroom": _write_classroom,
    "docker": _write_docker,
}
