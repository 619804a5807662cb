# SPDX-License-Identifier: Apache-2.0
"""Repeated announcements of participants, counted on the network."""

import os
import subprocess
import sys

import pytest

# Prints how many announcements of its own participant it has received in the first 1.8 s.
COUNT = """
import socket, time
from coframe.wire import Participant

DOMAIN = 1
WRITER = bytes.fromhex("000100c2")  # of announcements

receiver = socket.socket(type=socket.SOCK_DGRAM)
receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
receiver.bind(("239.255.0.1", 7400 + 250 * DOMAIN))
group = socket.inet_aton("239.255.0.1") + socket.inet_aton("127.0.0.1")
receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
receiver.settimeout(0.05)

joined = Participant.get(DOMAIN)
guid = joined._session.native.guid
count = 0
end = time.monotonic() + 1.8
while time.monotonic() < end:
    try:
        datagram = receiver.recv(65536)
    except TimeoutError:
        continue
    count += datagram[8:20] == guid[:12] and WRITER in datagram[20:80]
joined.close()
print(count)
"""

# Keeps a range of discovery that includes other machines on this one.
LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces>"
    '<NetworkInterface address="127.0.0.1" multicast="true"/>'
    "</Interfaces></General></Domain></CycloneDDS>"
)


@pytest.mark.skipif(sys.platform != "linux", reason="network namespaces are of Linux")
@pytest.mark.parametrize(
    ("environment", "fewest", "most"),
    [
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET", "CYCLONEDDS_URI": LOOPBACK}, 4, 5),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, 1, 2),
    ],
    ids=["network", "this machine only"],
)
@pytest.mark.dds_only("Zenoh sends again what is lost")
def test_announcements_are_repeated_where_the_network_can_lose_them(network, environment, fewest, most):
    done = subprocess.run(
        network.command(sys.executable, "-c", COUNT),
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert fewest <= int(done.stdout) <= most
