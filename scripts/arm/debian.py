# SPDX-License-Identifier: Apache-2.0
"""Unpack packages of Debian, for any processor, into a folder: nothing is installed, and no root rights are needed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

KEYRING = Path("/usr/share/keyrings/debian-archive-keyring.gpg")
SOURCES = [Path("/etc/apt/sources.list.d/debian.sources"), Path("/etc/apt/sources.list")]
MIRROR = "DEBIAN_MIRROR"
STAMP = ".complete"


class UnavailableError(Exception):
    """What cannot be had on this machine, as one sentence."""


def unpack(folder: Path, suite: str, architecture: str, packages: list[str], only: str = "") -> bool:
    """Unpack packages and what they depend on; return whether that was necessary.

    Args:
        folder: What is in it is deleted if it was unpacked from other packages.
        suite: A release of Debian.
        architecture: Debian's name of the processor.
        packages: Their names.
        only: The one file to unpack, as it is called in the package.

    Raises:
        UnavailableError: This machine has no apt of Debian, or the packages cannot be downloaded.
    """
    stamp, contents = folder / STAMP, "\n".join([suite, architecture, *packages, only])
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == contents:
        return False
    work = folder.with_name(f"{folder.name}-apt")
    archives = download(work, suite, architecture, packages)
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("bin", "sbin", "lib"):  # Debian's installer creates these links, not a package.
        (folder / "usr" / name).mkdir(parents=True)
        (folder / name).symlink_to(f"usr/{name}")
    for archive in archives:
        with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", archive], stdout=subprocess.PIPE) as files:
            command = ["tar", "-x", "--no-same-owner", "--keep-directory-symlink", "--exclude=./dev/*", "-C", folder]
            subprocess.run([*command, *filter(None, [only])], stdin=files.stdout, check=True)
    shutil.rmtree(work)
    stamp.write_text(contents, encoding="utf-8")
    return True


def download(work: Path, suite: str, architecture: str, packages: list[str]) -> list[Path]:
    """Return the files of packages and of what they depend on.

    Args:
        work: The state of an apt of its own, which knows nothing about what is installed.
        suite: A release of Debian.
        architecture: Debian's name of the processor.
        packages: Their names.

    Raises:
        UnavailableError: See `unpack`.
    """
    missing = [name for name in ("apt-get", "dpkg-deb", "tar") if shutil.which(name) is None]
    if missing or not KEYRING.is_file():
        raise UnavailableError(f"the packages of Debian need {missing[0] if missing else KEYRING}, which is not there")
    shutil.rmtree(work, ignore_errors=True)
    for name in ("lists/partial", "archives/partial", "etc/apt.conf.d", "etc/preferences.d"):
        (work / name).mkdir(parents=True)
    (work / "status").touch()
    (work / "etc/sources.list").write_text(f"deb [signed-by={KEYRING}] {mirror()} {suite} main\n", encoding="utf-8")
    configuration = {
        "Dir::Etc": work / "etc",
        "Dir::State": work,
        "Dir::State::status": work / "status",
        "Dir::Cache": work,
        "APT::Architecture": architecture,
        "APT::Architectures": architecture,
        "APT::Install-Recommends": "false",
        "APT::Sandbox::User": "",
        "Acquire::Languages": "none",
    }
    file = work / "apt.conf"
    file.write_text("".join(f'{key} "{value}";\n' for key, value in configuration.items()), encoding="utf-8")
    for command in (["update", "-qq"], ["install", "-qq", "--yes", "--download-only", *packages]):
        result = apt(file, *command)
        if result.returncode != 0:
            raise UnavailableError(
                f"the packages of Debian {suite} for {architecture} cannot be downloaded: {last_line(result.stderr)}"
            )
    return sorted((work / "archives").glob("*.deb"))


def apt(configuration: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run apt-get with a configuration of its own."""
    environment = {**os.environ, "APT_CONFIG": str(configuration), "LC_ALL": "C.UTF-8"}
    return subprocess.run(["apt-get", *words], env=environment, capture_output=True, text=True, check=False)


def mirror() -> str:
    """Return the mirror of Debian that this machine uses.

    Raises:
        UnavailableError: None is configured.
    """
    texts = [os.environ.get(MIRROR, ""), *(path.read_text(encoding="utf-8") for path in SOURCES if path.is_file())]
    for text in texts:
        found = re.search(r"\b(?:https?|file|copy)://\S+", re.sub(r"(?m)^#.*", "", text))
        if found and "security" not in found[0]:
            return found[0]
    raise UnavailableError(f"no mirror of Debian is configured: set {MIRROR}")


def last_line(text: str) -> str:
    """Return the last line that is not empty."""
    return next((line.strip() for line in reversed(text.splitlines()) if line.strip()), "no reason was given")
