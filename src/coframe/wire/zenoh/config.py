# SPDX-License-Identifier: Apache-2.0
"""The configuration of Zenoh sessions and routers, from the defaults and environment variables of rmw_zenoh_cpp."""

from __future__ import annotations

import json
import logging
import os
import re
from typing import TYPE_CHECKING, Any, Final

from coframe._files.regular_files import UnsuitableFileError, check_regular, reading_hint
from coframe.errors import WireError
from coframe.wire.zenoh import _library

if TYPE_CHECKING:
    from collections.abc import Mapping

    import zenoh

SESSION_FILE: Final = "ZENOH_SESSION_CONFIG_URI"
ROUTER_FILE: Final = "ZENOH_ROUTER_CONFIG_URI"
OVERRIDE: Final = "ZENOH_CONFIG_OVERRIDE"
ROUTER_CHECK: Final = "ZENOH_ROUTER_CHECK_ATTEMPTS"
DEFAULT_ROUTER: Final = "tcp/localhost:7447"
MAX_BYTES: Final = 16 << 20  # of a configuration, and of each file named in it

_COMMON: Final[dict[str, Any]] = {
    "scouting/multicast/enabled": False,
    "scouting/gossip/enabled": True,
    "scouting/gossip/multihop": False,
    "scouting/gossip/target": {"router": ["router", "peer"], "peer": ["router"]},
    "scouting/gossip/autoconnect": {"router": [], "peer": ["router", "peer"]},
    "timestamping/enabled": {"router": True, "peer": True, "client": True},
    "queries_default_timeout": 600_000,  # ms
    "transport/shared_memory/enabled": False,
    "transport/link/tx/lease": 60_000,  # ms
    "transport/link/tx/keep_alive": 2,
}
SESSION_DEFAULTS: Final[dict[str, Any]] = {
    "mode": "peer",
    "connect/endpoints": [DEFAULT_ROUTER],
    "listen/endpoints": ["tcp/localhost:0"],
    "scouting/gossip/autoconnect_strategy": {"peer": {"to_router": "always", "to_peer": "greater-zid"}},
    **_COMMON,
}
ROUTER_DEFAULTS: Final[dict[str, Any]] = {
    "mode": "router",
    "connect/endpoints": [],
    "listen/endpoints": ["tcp/[::]:7447"],
    "scouting/gossip/autoconnect_strategy": {"router": {"to_router": "always", "to_peer": "always"}},
    **_COMMON,
}
# rmw_zenoh_cpp finds nothing without a router. Processes of coframe on one machine find each other by multicast on the
# loopback interface. A user who configures Zenoh decides which processes find each other, so this applies only without
# a configuration.
_LOOPBACK_DISCOVERY: Final[dict[str, Any]] = {
    "scouting/multicast/enabled": True,
    "scouting/multicast/interface": "127.0.0.1",
}

_FILE_KEYS: Final = ("_certificate", "_private_key", "_file")

_logger = logging.getLogger("coframe.wire")


def session_config(environment: Mapping[str, str] = os.environ) -> zenoh.Config:
    """Return the configuration of a session, read as in rmw_zenoh_cpp.

    ZENOH_SESSION_CONFIG_URI names a file that replaces the defaults; ZENOH_CONFIG_OVERRIDE changes individual values.
    If neither is set, processes on this machine also find each other by multicast on the loopback interface.

    Raises:
        WireError: Zenoh is not installed, or the file cannot be read.
    """
    defaults = SESSION_DEFAULTS if is_configured(environment) else {**SESSION_DEFAULTS, **_LOOPBACK_DISCOVERY}
    return _config(environment.get(SESSION_FILE, "").strip(), SESSION_FILE, defaults, environment)


def router_config(
    environment: Mapping[str, str] = os.environ,
    *,
    file: str = "",
    listen: list[str] | None = None,
    connect: list[str] | None = None,
) -> zenoh.Config:
    """Return the configuration of a router, read as in rmw_zenoh_cpp's router.

    Args:
        environment: The environment variables: ZENOH_ROUTER_CONFIG_URI names a file that replaces the defaults;
            ZENOH_CONFIG_OVERRIDE changes individual values.
        file: The path of the file that replaces the defaults, with priority over the variable.
        listen: The endpoints to listen on, with priority over the file and the variables.
        connect: The endpoints of other routers to connect to, with the same priority.

    Raises:
        WireError: Zenoh is not installed, the file cannot be read, or an endpoint is not valid.
    """
    named = file or environment.get(ROUTER_FILE, "").strip()
    config = _config(named, "--config" if file else ROUTER_FILE, ROUTER_DEFAULTS, environment)
    for direction, chosen in (("listen", listen), ("connect", connect)):
        if chosen is None:
            continue
        try:
            config.insert_json5(f"{direction}/endpoints", json.dumps(chosen))
        except _library.load().ZError as error:
            raise WireError(
                f"The endpoints {', '.join(chosen)} are not valid: {reason_of(error)}.",
                hint="An endpoint is, for example, tcp/127.0.0.1:7447 or tls/0.0.0.0:7447.",
            ) from error
    return config


def is_configured(environment: Mapping[str, str] = os.environ) -> bool:
    """Return whether the user has configured sessions by an environment variable."""
    return any(environment.get(name, "").strip() for name in (SESSION_FILE, OVERRIDE))


def connect_endpoints(config: zenoh.Config) -> list[str]:
    """Return the endpoints that a configuration connects to, such as ["tcp/localhost:7447"]."""
    return endpoints(config, "connect")


def endpoints(config: zenoh.Config, direction: str) -> list[str]:
    """Return the endpoints that a configuration listens on ("listen") or connects to ("connect")."""
    value = json.loads(config.get_json(f"{direction}/endpoints"))
    if isinstance(value, dict):  # different endpoints for each mode
        value = value.get(json.loads(config.get_json("mode")) or "peer", [])
    return [str(endpoint) for endpoint in value or []]


def router_check_attempts(environment: Mapping[str, str] = os.environ) -> int | None:
    """Return how often to check for a router, one second apart: 0 to skip the check, None to check without a limit.

    Raises:
        WireError: ZENOH_ROUTER_CHECK_ATTEMPTS is not an integer.
    """
    text = environment.get(ROUTER_CHECK, "").strip()
    try:
        attempts = int(text or "1")
    except ValueError:
        raise WireError(
            f"{ROUTER_CHECK} is {text!r}: it must be an integer.",
            hint="A positive number is the number of checks, 0 checks without a limit, a negative number skips the "
            "check.",
        ) from None
    return None if attempts == 0 else max(attempts, 0)


def override_pairs(text: str) -> list[tuple[str, str]]:
    """Return the pairs of paths and JSON5 values in ZENOH_CONFIG_OVERRIDE. Parts without a value are skipped."""
    pairs = []
    for part in text.split(";"):
        path, equals, value = part.partition("=")
        if equals and path.strip() and value.strip():
            pairs.append((path.strip(), value.strip()))
        elif part.strip():
            _logger.warning("%s: %r is skipped, which is not of the form path/to/key=value.", OVERRIDE, part)
    return pairs


def reason_of(error: Exception) -> str:
    """Return Zenoh's reason for an error without source code locations."""
    text = re.sub(r" at /\S+| location: .*", "", str(error), flags=re.DOTALL)
    quoted = re.search(r'"(.*?)(?:"|\Z)', text) if text.startswith(("Json5Err", "Str(")) else None
    *_, last = (quoted[1] if quoted else text).replace("\\n", "\n").splitlines() or [text]
    return last.strip(" =.!")


def _config(file: str, variable: str, defaults: Mapping[str, Any], environment: Mapping[str, str]) -> zenoh.Config:
    module = _library.load()
    if file:
        config = _from_file(module, file.removeprefix("file://"), variable)
    else:
        config = module.Config()
        for path, value in defaults.items():
            config.insert_json5(path, json.dumps(value))
    for path, text in override_pairs(environment.get(OVERRIDE, "")):
        try:
            config.insert_json5(path, text)
        except module.ZError as error:
            _logger.warning("%s: %s=%s is skipped: %s.", OVERRIDE, path, text, reason_of(error))
    _check_named_files(config)
    return config


def _check_named_files(config: zenoh.Config) -> None:
    """Raise WireError if Zenoh would wait for a file that the configuration names, such as a certificate."""
    credentials = {
        **(json.loads(config.get_json("transport/link/tls")) or {}),
        **(json.loads(config.get_json("transport/auth/usrpwd")) or {}),
    }
    for key, file in credentials.items():
        if isinstance(file, str) and key.endswith(_FILE_KEYS):
            try:
                check_regular(file, MAX_BYTES)
            except UnsuitableFileError as error:
                raise WireError(f"{key} of the Zenoh configuration: {error}.") from None
            except OSError:
                continue  # Zenoh reports a missing file itself.


def _from_file(module: Any, file: str, variable: str) -> zenoh.Config:
    """Return the configuration in a file that an environment variable or an option names."""
    remove = f"omit {variable}" if variable.startswith("--") else f"unset {variable}"
    try:
        check_regular(file, MAX_BYTES)
    except FileNotFoundError:
        raise WireError(
            f"The file {file}, named by {variable}, does not exist.",
            hint=f"Name a configuration file of Zenoh (JSON5), or {remove} to use the defaults of ROS 2.",
        ) from None
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise WireError(f"The Zenoh configuration {file} cannot be read: {reason}.", hint=reading_hint(error)) from None
    try:
        config: zenoh.Config = module.Config.from_file(file)
    except module.ZError as error:
        raise WireError(
            f"The Zenoh configuration {file} cannot be read: {reason_of(error)}.",
            hint="Check the file against the default configuration of Zenoh.",
        ) from error
    return config
