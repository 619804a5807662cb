# SPDX-License-Identifier: Apache-2.0
"""The security of DDS (SROS 2): the files of an enclave as properties of a participant."""

from __future__ import annotations

import importlib
import logging
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe._output.warn_once import WarnOnce
from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

_ENABLE: Final = "ROS_SECURITY_ENABLE"
_KEYSTORE: Final = "ROS_SECURITY_KEYSTORE"
_OVERRIDE: Final = "ROS_SECURITY_ENCLAVE_OVERRIDE"
_STRATEGY: Final = "ROS_SECURITY_STRATEGY"

# The suffix of each property with its file.
FILES: Final = {
    "auth.builtin.PKI-DH.identity_ca": "identity_ca.cert.pem",
    "auth.builtin.PKI-DH.identity_certificate": "cert.pem",
    "auth.builtin.PKI-DH.private_key": "key.pem",
    "access.builtin.Access-Permissions.permissions_ca": "permissions_ca.cert.pem",
    "access.builtin.Access-Permissions.governance": "governance.p7s",
    "access.builtin.Access-Permissions.permissions": "permissions.p7s",
}
_PLUGINS: Final = (
    ("dds.sec.auth.plugin", "builtin.PKI-DH"),
    ("dds.sec.access.plugin", "builtin.Access-Permissions"),
    ("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"),
)
_SCHEME: Final = "file://"
_REVOKED: Final = "dds.sec.auth.builtin.PKI-DH.identity_crl"

_warn_once = WarnOnce(logging.getLogger("coframe.wire").warning)


def read(environment: Mapping[str, str]) -> tuple[str, tuple[tuple[str, str], ...]]:
    """Return the enclave of this process, and the properties of its participants, or none without security.

    Raises:
        WireError: A variable has an invalid value, or security is enforced and files of the enclave are missing.
    """
    enclave = environment.get(_OVERRIDE, "").strip() or "/"
    if _choice(environment, _ENABLE, ("false", "true")) == "false":
        return enclave, ()
    enforced = _choice(environment, _STRATEGY, ("Permissive", "Enforce")) == "Enforce"
    keystore = environment.get(_KEYSTORE, "").strip()
    folder = Path(keystore, "enclaves", enclave.strip("/"))
    reason, remedy = _problem(keystore, enclave, folder)
    if reason and enforced:
        raise WireError(f"{_ENABLE} is true, but {reason}.", hint=remedy)
    if reason:
        _warn_once(
            f"{_ENABLE} is true, but {reason}: this process communicates without security. "
            f"{_STRATEGY}=Enforce refuses that."
        )
        return enclave, ()
    properties = [*_PLUGINS, *((f"dds.sec.{suffix}", f"{_SCHEME}{folder / name}") for suffix, name in FILES.items())]
    if (folder / "crl.pem").is_file():
        properties.append((_REVOKED, f"{_SCHEME}{folder / 'crl.pem'}"))
    return enclave, tuple(properties)


def folder_of(properties: tuple[tuple[str, str], ...]) -> str:
    """Return the folder with the files of the enclave that properties name."""
    return next(str(Path(value.removeprefix(_SCHEME)).parent) for _, value in properties if value.startswith(_SCHEME))


def _problem(keystore: str, enclave: str, folder: Path) -> tuple[str, str]:
    """Return what prevents the use of an enclave, as a phrase, and what to do; empty strings if there is nothing."""
    if not keystore:
        return f"{_KEYSTORE} is not set", (
            f"Set {_KEYSTORE} to the folder that `ros2 security create_keystore` made, or unset {_ENABLE}."
        )
    create = (
        f"Create it with `ros2 security create_enclave {keystore} {enclave}`, or correct {_KEYSTORE} or {_OVERRIDE}."
    )
    if not folder.is_dir():
        return f"there is no folder {folder} of the enclave {enclave}", create
    if missing := [name for name in FILES.values() if not (folder / name).is_file()]:
        return f"the enclave {enclave} has no {', '.join(missing)} in {folder}", create
    native = importlib.import_module("coframe_fastdds._fastdds")
    if not native.HAS_SECURITY:
        return f"Fast DDS {native.VERSION} ({native.library()}) was built without security", (
            f"Install coframe-fastdds again, with a library that has it: that of a sourced ROS 2, or libfastrtps-dev "
            f"of Debian and Ubuntu. Or unset {_ENABLE}."
        )
    return "", ""


def _choice(environment: Mapping[str, str], name: str, values: tuple[str, ...]) -> str:
    """Return a variable that has one of some values; the first one if it is not set.

    ROS 2 takes any other value for the first one, which disables the protection without a word.
    """
    value = environment.get(name, "").strip() or values[0]
    if value not in values:
        raise WireError(
            f"{name} is {value!r}: it must be {values[0]} or {values[1]}.",
            hint=f"Unset it for the default, {values[0]}.",
        )
    return value
