# SPDX-License-Identifier: Apache-2.0
"""Create a keystore with the files that `ros2 security create_keystore` and `create_enclave` make."""

import subprocess
from pathlib import Path

GOVERNANCE = """<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>
<domains><id_range><min>0</min><max>232</max></id_range></domains>
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>SIGN</rtps_protection_kind>
<topic_access_rules><topic_rule>
<topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>ENCRYPT</metadata_protection_kind>
<data_protection_kind>ENCRYPT</data_protection_kind>
</topic_rule></topic_access_rules></domain_rule></domain_access_rules></dds>
"""
PERMISSIONS = """<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name="{enclave}"><subject_name>CN={enclave}</subject_name>
<validity><not_before>2020-01-01T00:00:00</not_before><not_after>2100-01-01T00:00:00</not_after></validity>
<allow_rule><domains><id_range><min>0</min><max>232</max></id_range></domains>
<publish><topics>{topics}</topics></publish>
<subscribe><topics><topic>*</topic></topics></subscribe></allow_rule>
<default>DENY</default></grant></permissions></dds>
"""


class Keystore:
    """A keystore with an authority of its own.

    Args:
        folder: An empty folder.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir()
        self._key("ca.key.pem")
        self._openssl("req -x509 -new -key ca.key.pem -days 3650 -subj /CN=authority -out ca.cert.pem")
        self._sign("governance", GOVERNANCE)

    def add(self, enclave: str, publishes: tuple[str, ...] = ("*",)) -> None:
        """Add an enclave, such as "/robot", which may publish on some DDS topics."""
        path = f"enclaves{enclave}"
        (self.folder / path).mkdir(parents=True)
        self._key(f"{path}/key.pem")
        subject = enclave.replace("/", "\\/")
        self._openssl(f"req -new -key {path}/key.pem -subj /CN={subject} -out request.pem")
        authority = "-CA ca.cert.pem -CAkey ca.key.pem -CAcreateserial"
        self._openssl(f"x509 -req -in request.pem {authority} -days 3650 -out {path}/cert.pem")
        topics = "".join(f"<topic>{topic}</topic>" for topic in publishes)
        self._sign(f"{path}/permissions", PERMISSIONS.format(enclave=enclave, topics=topics))
        for name in ("identity_ca.cert.pem", "permissions_ca.cert.pem"):
            (self.folder / path / name).write_bytes((self.folder / "ca.cert.pem").read_bytes())
        (self.folder / path / "governance.p7s").write_bytes((self.folder / "governance.p7s").read_bytes())

    def environment(self, enclave: str) -> dict[str, str]:
        """Return the variables of a process in an enclave."""
        return {
            "ROS_SECURITY_ENABLE": "true",
            "ROS_SECURITY_STRATEGY": "Enforce",
            "ROS_SECURITY_KEYSTORE": str(self.folder),
            "ROS_SECURITY_ENCLAVE_OVERRIDE": enclave,
        }

    def _key(self, path: str) -> None:
        self._openssl(f"ecparam -name prime256v1 -genkey -noout -out {path}")

    def _sign(self, path: str, text: str) -> None:
        (self.folder / f"{path}.xml").write_text(text)
        self._openssl(f"smime -sign -in {path}.xml -text -out {path}.p7s -signer ca.cert.pem -inkey ca.key.pem")

    def _openssl(self, words: str) -> None:
        subprocess.run(["openssl", *words.split()], cwd=self.folder, check=True, capture_output=True)
