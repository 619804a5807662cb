# SPDX-License-Identifier: Apache-2.0
"""The security of DDS (SROS 2): the files of an enclave as properties of a participant."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe.wire import ros_security
from coframe.wire.ros_security import ENABLE

if TYPE_CHECKING:
    from collections.abc import Mapping

_KEYSTORE: Final = "ROS_SECURITY_KEYSTORE"
_OVERRIDE: Final = "ROS_SECURITY_ENCLAVE_OVERRIDE"

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


def read(environment: Mapping[str, str]) -> tuple[str, tuple[tuple[str, str], ...]]:
    """Return the enclave of this process, and the properties of its participants, or none without security.

    Raises:
        WireError: A variable has an invalid value, or security is enforced and files of the enclave are missing.
    """
    enclave = environment.get(_OVERRIDE, "").strip() or "/"
    if not ros_security.is_enabled(environment):
        return enclave, ()
    ros_security.is_enforced(environment)  # checks the variable
    keystore = environment.get(_KEYSTORE, "").strip()
    folder = Path(keystore, "enclaves", enclave.strip("/"))
    reason, remedy = _problem(keystore, enclave, folder)
    if reason:
        ros_security.report_missing(reason, remedy, environment)
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
            f"Set {_KEYSTORE} to the folder that `ros2 security create_keystore` made, or unset {ENABLE}."
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
            f"of Debian and Ubuntu. Or unset {ENABLE}."
        )
    return "", ""
