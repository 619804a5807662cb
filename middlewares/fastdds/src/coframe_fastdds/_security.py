# SPDX-License-Identifier: Apache-2.0
"""The security of DDS (SROS 2): the files of an enclave as properties of a participant."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

_KEYSTORE: Final = "ROS_SECURITY_KEYSTORE"
_OVERRIDE: Final = "ROS_SECURITY_ENCLAVE_OVERRIDE"
_STRATEGY: Final = "ROS_SECURITY_STRATEGY"

# The suffix of each property with its file.
_FILES: Final = {
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
_REVOKED: Final = "dds.sec.auth.builtin.PKI-DH.identity_crl"


def read(environment: Mapping[str, str]) -> tuple[str, tuple[tuple[str, str], ...]]:
    """Return the enclave of this process, and the properties of its participants; none without security.

    Raises:
        WireError: Security is enforced, and files of the enclave are missing.
    """
    enclave = environment.get(_OVERRIDE, "").strip() or "/"
    if environment.get("ROS_SECURITY_ENABLE", "").strip() != "true":
        return enclave, ()
    enforced = environment.get(_STRATEGY, "").strip() == "Enforce"
    keystore = environment.get(_KEYSTORE, "").strip()
    if not keystore:
        if enforced:
            raise WireError(
                f"ROS_SECURITY_ENABLE is true, but {_KEYSTORE} is not set.",
                hint=f"Set {_KEYSTORE} to the folder that `ros2 security create_keystore` made, or unset "
                "ROS_SECURITY_ENABLE.",
            )
        return enclave, ()
    folder = Path(keystore, "enclaves", enclave.strip("/"))
    missing = [name for name in _FILES.values() if not (folder / name).is_file()]
    if missing:
        if enforced:
            raise WireError(
                f"The enclave {enclave} has no {', '.join(missing)} in {folder}.",
                hint=f"Create it: ros2 security create_enclave {keystore} {enclave}",
            )
        return enclave, ()
    properties = [*_PLUGINS, *((f"dds.sec.{suffix}", f"file://{folder / name}") for suffix, name in _FILES.items())]
    if (folder / "crl.pem").is_file():
        properties.append((_REVOKED, f"file://{folder / 'crl.pem'}"))
    return enclave, tuple(properties)
