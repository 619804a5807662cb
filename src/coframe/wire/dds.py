# SPDX-License-Identifier: Apache-2.0
"""Access to the `cyclonedds` package, which is loaded when the process joins the graph."""

from __future__ import annotations

import importlib.util
import socket
from pathlib import Path
from typing import TYPE_CHECKING

from coframe import _core
from coframe.errors import WireError
from coframe.wire import config

if TYPE_CHECKING:
    from importlib.machinery import ModuleSpec


def load() -> None:
    """Load the DDS library of `cyclonedds` into the native core.

    Raises:
        WireError: cyclonedds is not installed or not compatible.
    """
    path = _library()
    try:
        _core.load_dds(path)
    except RuntimeError as error:
        raise WireError(
            f"The installed cyclonedds is not compatible: {error}.",
            hint="Install the version that coframe requires: pip install 'coframe[dds]'.",
        ) from error


def _library() -> str:
    """Return the path of the DDS library. The package itself is not imported, which would take 100 ms and more."""
    package = _package()
    for folder in (package and package.submodule_search_locations) or []:
        spec = importlib.util.spec_from_file_location("_cyclonedds_library", Path(folder) / "__library__.py")
        if spec is None or spec.loader is None:
            continue
        module = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
            return str(module.library_path)
        except (ImportError, OSError, IndexError, AttributeError):
            continue
    raise _not_installed()


def check() -> None:
    """Check that `cyclonedds` is installed, without loading it.

    Raises:
        WireError: cyclonedds is not installed.
    """
    if _package() is None:
        raise _not_installed()


def _package() -> ModuleSpec | None:
    """Return where `cyclonedds` is installed; None if it is not, or if it is blocked, as in tests of a program."""
    try:
        return importlib.util.find_spec("cyclonedds")
    except (ImportError, ValueError):
        return None


def _not_installed() -> WireError:
    return WireError(
        "Joining the ROS graph requires the package cyclonedds, which is not installed: pip install 'coframe[dds]'.",
        hint="It has wheels for Python 3.10 to 3.13 on Linux x86-64, macOS and Windows. "
        "All other features of coframe work without it.",
    )


def join(domain: int, xml: str, user_data: str) -> _core.DomainParticipant:
    """Return a new participant in `domain`.

    Args:
        domain: The domain ID.
        xml: The configuration of Cyclone DDS.
        user_data: The DDS user data of the participant.

    Raises:
        WireError: DDS cannot create the participant.
    """
    try:
        return _core.DomainParticipant(domain, xml, user_data)
    except _core.DdsError as error:
        if not _free_participant_index(domain):
            raise WireError(
                f"Domain {domain} is full on this machine: all {config.MAX_PARTICIPANT_INDEX + 1} participant indexes "
                "are in use.",
                hint="Stop some ROS processes, or use another domain: ROS_DOMAIN_ID=1.",
            ) from error
        raise WireError(
            f"Joining domain {domain} failed: {error}.",
            hint="DDS wrote the reason to stderr. If CYCLONEDDS_URI is set, check it. "
            "Otherwise, check that this machine has the configured network interface.",
        ) from error


def _free_participant_index(domain: int) -> bool:
    """Return whether one of the UDP ports that RTPS assigns to participants of `domain` is free."""
    first = 7400 + 250 * domain + 10
    for port in range(first, min(first + 2 * config.MAX_PARTICIPANT_INDEX, 65535) + 1, 2):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return True
    return False
