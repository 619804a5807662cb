"""The `cyclonedds` wheel: found when somebody joins, not when coframe is imported."""

from __future__ import annotations

import importlib.util
import socket

from coframe import _core
from coframe.errors import WireError
from coframe.wire import config


def load() -> None:
    """Loads the wheel's DDS library into the native core.

    Raises:
        WireError: cyclonedds is not installed or does not fit.
    """
    try:
        from cyclonedds.internal import DDS  # noqa: PLC0415 - optional, and 100 ms
    except ImportError as error:
        raise _not_installed() from error
    try:
        _core.load_dds(DDS._dll_handle._name)  # noqa: SLF001 - the only place that knows the library's path
    except RuntimeError as error:
        raise WireError(
            f"This cyclonedds does not fit: {error}.",
            hint="Install the version coframe asks for: pip install 'coframe[dds]'.",
        ) from error


def check() -> None:
    """Whether the wheel is there, without loading it.

    Raises:
        WireError: cyclonedds is not installed.
    """
    if importlib.util.find_spec("cyclonedds") is None:
        raise _not_installed()


def _not_installed() -> WireError:
    return WireError(
        "Joining the ROS graph needs the package cyclonedds, which is not installed: pip install 'coframe[dds]'.",
        hint="There are wheels for Python 3.10 to 3.13 on Linux x86-64, macOS and Windows; "
        "everything else of coframe works without.",
    )


def join(domain: int, xml: str, user_data: str) -> _core.DomainParticipant:
    """A participant in `domain`, which is opened with Cyclone's configuration `xml`.

    Raises:
        WireError: DDS does not let us in.
    """
    try:
        return _core.DomainParticipant(domain, xml, user_data)
    except _core.DdsError as error:
        if not _free_participant_index(domain):
            raise WireError(
                f"Domain {domain} is full on this machine: all {config.MAX_PARTICIPANT_INDEX + 1} places are taken.",
                hint="End some of them, or use another domain: ROS_DOMAIN_ID=1.",
            ) from error
        raise WireError(
            f"Joining domain {domain} failed: {error}.",
            hint="DDS wrote the reason to stderr. If CYCLONEDDS_URI is set, check it; "
            "otherwise check that this machine has the network interface that is asked for.",
        ) from error


def _free_participant_index(domain: int) -> bool:
    """Whether one of the UDP ports that RTPS gives to participants of `domain` is free."""
    first = 7400 + 250 * domain + 10
    for port in range(first, min(first + 2 * config.MAX_PARTICIPANT_INDEX, 65535) + 1, 2):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return True
    return False
