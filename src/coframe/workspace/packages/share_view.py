# SPDX-License-Identifier: Apache-2.0
"""The share folder that a source folder would have after its installation, as a folder of links.

``install(DIRECTORY description/urdf DESTINATION share/my_robot)`` makes ``share/my_robot/urdf``, which launch files and
URDF files use. For such packages there is a folder in the user's cache with links to the sources; what is edited there
is used at once.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import os
import shutil
import tempfile
from pathlib import Path, PurePosixPath

from coframe._files.existence import is_dir
from coframe.workspace.packages._install_rules import contents, installed_files

__all__ = ["share_of_source", "source_of"]

_sources: dict[Path, Path] = {}  # the source folder of each folder of links


@functools.cache
def share_of_source(package: Path, name: str) -> Path:
    """Return the share folder of a source folder: itself, or a folder of links if files are installed elsewhere.

    Args:
        package: The source folder.
        name: Name of the package.
    """
    moved_paths = {
        relative: source
        for relative, source in installed_files(package, name).items()
        if source.absolute() != (package / relative).absolute()
    }
    if not moved_paths or os.name != "posix":  # Links need special rights on Windows.
        return package
    links = _links(package, moved_paths)
    key = hashlib.sha256(json.dumps(links, sort_keys=True).encode()).hexdigest()[:16]
    folder = _cache() / "share" / key / name
    try:
        if not folder.is_dir():
            _make(folder, links)
    except (OSError, ValueError):  # The cache cannot be written, or a name is not possible.
        return package
    _sources[folder] = package
    return folder


def source_of(share: Path) -> Path:
    """Return the source folder to which the links in a share folder lead, or the folder itself if it has none."""
    return _sources.get(share, share)


def _links(package: Path, moved_paths: dict[str, Path]) -> dict[str, str]:
    """Return the target of each link by its path in the share folder: the installed files, then those of the sources.

    A folder that contains an installed file is a folder of links itself.
    """
    links = {relative: str(source.absolute()) for relative, source in moved_paths.items()}
    used_names = {
        str(each) for relative in links for each in (PurePosixPath(relative), *PurePosixPath(relative).parents)
    }
    listed: set[tuple[str, Path]] = set()

    def add_contents(relative_path: str, origin: Path | None) -> None:
        if origin is None or (relative_path, origin) in listed:
            return
        listed.add((relative_path, origin))
        for each in contents(origin):
            path = f"{relative_path}/{each.name}" if relative_path else each.name
            if path not in used_names:
                used_names.add(path)
                links[path] = str(each.absolute())

    for relative, source in sorted(moved_paths.items()):
        for parent in map(str, list(PurePosixPath(relative).parents)[:-1]):
            # The other files of the folder: those of another rule for the same folder, then those of the sources.
            for origin in (moved_paths.get(parent), package / parent):
                add_contents(parent, origin)
            links.pop(parent, None)
        if relative in links and source.is_dir() and is_dir(package / relative):
            del links[relative]
            add_contents(relative, source)
            add_contents(relative, package / relative)
    add_contents("", package)
    return links


def _make(folder: Path, links: dict[str, str]) -> None:
    """Make the folder in one step, so that other processes see all of it or nothing."""
    folder.parent.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    part = Path(tempfile.mkdtemp(dir=folder.parent.parent, prefix=".part-"))
    try:
        for relative, target in links.items():
            link = part / folder.name / relative
            link.parent.mkdir(parents=True, exist_ok=True)
            link.symlink_to(target)
        with contextlib.suppress(FileExistsError):
            folder.parent.mkdir()
        with contextlib.suppress(OSError):  # Another process was faster.
            (part / folder.name).rename(folder)
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _cache() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME") or Path("~", ".cache").expanduser()) / "coframe"
