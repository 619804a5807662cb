# SPDX-License-Identifier: Apache-2.0
"""Meshes and textures of robots and markers, served only from declared folders."""

from __future__ import annotations

import re
import secrets
import threading
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import quote, unquote, urlsplit

from coframe._files.existence import resolved
from coframe._files.os_errors import reason
from coframe._files.regular_files import check_regular
from coframe.errors import CoframeError
from coframe.workspace.packages.share_view import source_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["MAX_MESH_BYTES", "MESH_TYPES", "MeshError", "MeshTable"]

MAX_MESH_BYTES = 256 << 20
MESH_TYPES = {
    ".bin": "application/octet-stream",
    ".bmp": "image/bmp",
    ".dae": "model/vnd.collada+xml",
    ".gif": "image/gif",
    ".glb": "model/gltf-binary",
    ".gltf": "model/gltf+json",
    ".jpeg": "image/jpeg",
    ".jpg": "image/jpeg",
    ".mtl": "model/mtl",
    ".obj": "model/obj",
    ".ply": "application/octet-stream",
    ".png": "image/png",
    ".stl": "model/stl",
    ".tga": "image/x-tga",
    ".webp": "image/webp",
}
"""The content type for each file extension; files with other extensions are not served."""

_PACKAGE = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]*")


class MeshError(CoframeError, ValueError):
    """A mesh is not served. The message gives the reason."""


class _Root(NamedTuple):
    token: str
    folder: Path


class MeshTable:
    """The files that may be fetched, under unguessable URLs. Thread-safe.

    Args:
        find_package: Return the folder of a ROS package, or None if it does not exist.
        roots: Folders below which all meshes and textures may be fetched.
    """

    def __init__(self, find_package: Callable[[str], Path | None], roots: Iterable[Path] = ()) -> None:
        self._find_package = find_package
        self._lock = threading.Lock()
        self._roots: dict[Path, _Root] = {}
        self._packages: dict[str, Path | None] = {}
        for root in roots:
            self.declare(root)

    def declare(self, folder: Path) -> None:
        """Allow the meshes and textures below a folder to be fetched."""
        root = resolved(folder)
        with self._lock:
            self._roots.setdefault(root, _Root(secrets.token_urlsafe(12), root))

    def url(self, reference: str, folder: Path | None = None) -> str:
        """Return the URL of a mesh that a robot or marker names.

        Args:
            reference: ``package://NAME/...``, ``file:///...`` or a path.
            folder: The folder of relative paths.

        Raises:
            MeshError: The file does not exist or must not be fetched.
        """
        file = self._file_of(reference, folder)
        root = self._root_of(file, reference)
        _check_file(file, reference)
        return f"/mesh/{root.token}/{quote(file.relative_to(root.folder).as_posix())}"

    def url_or_problem(self, reference: str) -> tuple[str | None, str | None]:
        """Return the URL and None, or None and the reason why there is no URL."""
        try:
            return self.url(reference), None
        except MeshError as error:
            return None, str(error)

    def file(self, path: str) -> Path:
        """Return the file for the part of a request's path after ``/mesh/``: a token, then a path below its folder.

        A name after a file name is resolved in the folder of that file, because meshes refer to textures in this way.

        Raises:
            MeshError: The file does not exist or must not be fetched.
        """
        token, _, below = path.partition("/")
        with self._lock:
            root = next((root for root in self._roots.values() if secrets.compare_digest(root.token, token)), None)
        if root is None:
            raise MeshError("mesh not found")
        file = root.folder
        for part in below.split("/"):
            file = (file.parent if file.suffix.lower() in MESH_TYPES and _is_file(file) else file) / part
        found = _resolve(file)
        self._root_of(found, below)
        _check_file(found, below)
        return found

    def _file_of(self, reference: str, folder: Path | None) -> Path:
        try:
            parts = urlsplit(reference) if "://" in reference else None
        except ValueError:  # for example a host that begins with a bracket
            raise MeshError(f"{_shorten(reference)} is not a valid address") from None
        if parts is None:
            if folder is None:
                raise MeshError(f"{_shorten(reference)} is neither package:// nor file://")
            return _resolve(folder / reference)
        if parts.scheme == "file":
            if parts.netloc not in {"", "localhost"}:
                raise MeshError(f"{_shorten(reference)} is on another machine")
            return _resolve(Path(unquote(parts.path)))
        if parts.scheme == "package":
            return _resolve(self._package(parts.netloc) / unquote(parts.path).lstrip("/"))
        raise MeshError(f"{_shorten(reference)} is neither package:// nor file://")

    def _package(self, name: str) -> Path:
        with self._lock:
            known = name in self._packages
            folder = self._packages.get(name)
        if not known:
            folder = self._find_package(name) if _PACKAGE.fullmatch(name) else None
            with self._lock:
                self._packages[name] = folder
            if folder is not None:
                self.declare(folder)
                self.declare(source_of(folder))
        if folder is None:
            raise MeshError(
                f"ROS package {_shorten(name)} not found. Add the folder that contains it to COFRAME_PACKAGE_PATH."
            )
        return folder

    def _root_of(self, file: Path, reference: str) -> _Root:
        with self._lock:
            for folder, root in self._roots.items():
                if file.is_relative_to(folder):
                    return root
        raise MeshError(f"{_shorten(reference)} is outside the served folders. Add its folder to the mesh roots.")


def _resolve(path: Path) -> Path:
    """Return the path without symbolic links and dots."""
    try:
        return path.resolve()
    except (OSError, RuntimeError, ValueError) as error:  # A loop of links, a NUL, or a name that is too long.
        raise MeshError(f"{_shorten(str(path))} is not a valid path: {reason(error)}") from None


def _check_file(file: Path, reference: str) -> None:
    if file.suffix.lower() not in MESH_TYPES:
        raise MeshError(f"{_shorten(reference)} is not a mesh or texture. Known extensions: {', '.join(MESH_TYPES)}")
    try:
        check_regular(file)
    except FileNotFoundError:
        is_package = reference.startswith("package://")
        hint = ". Is the right copy of the package in a folder of COFRAME_PACKAGE_PATH?" if is_package else ""
        raise MeshError(f"file {_shorten(reference)} not found{hint}") from None
    except OSError as error:
        raise MeshError(f"{_shorten(reference)} cannot be read: {error.strerror}") from None
    if (size := file.stat().st_size) > MAX_MESH_BYTES:
        raise MeshError(f"{_shorten(reference)} has {size >> 20} MB; at most {MAX_MESH_BYTES >> 20} MB are served")


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def _shorten(text: str) -> str:
    shown = repr(text)
    return shown if len(shown) <= 120 else f"{shown[:117]}..."
