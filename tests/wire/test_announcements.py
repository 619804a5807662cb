# SPDX-License-Identifier: Apache-2.0
"""Repeated announcements of participants, received from the network."""

import os
import subprocess
import sys

import pytest

# Prints whether it receives the last announcement of its participant within the time in seconds that it gets.
WAIT = """
import socket, sys, time
from coframe.wire import Participant
from coframe.wire.dds._announcements import participant_user_data

DOMAIN = 1
receiver = socket.socket(type=socket.SOCK_DGRAM)
receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
receiver.bind(("239.255.0.1", 7400 + 250 * DOMAIN))
group = socket.inet_aton("239.255.0.1") + socket.inet_aton("127.0.0.1")
receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
receiver.settimeout(0.05)

joined = Participant.get(DOMAIN)
end = time.monotonic() + float(sys.argv[1])
datagram = b""
while time.monotonic() < end and participant_user_data(3).encode() not in datagram:
    try:
        datagram = receiver.recv(65536)
    except TimeoutError:
        pass
print("announced" if participant_user_data(3).encode() in datagram else "not announced")
joined.close()
"""

# Keeps a range of discovery that includes other machines on this one.
LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces>"
    '<NetworkInterface address="127.0.0.1" multicast="true"/>'
    "</Interfaces></General></Domain></CycloneDDS>"
)


@pytest.mark.skipif(sys.platform != "linux", reason="network namespaces are of Linux")
@pytest.mark.parametrize(
    ("environment", "seconds", "expected"),
    [
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET", "CYCLONEDDS_URI": LOOPBACK}, 20.0, "announced"),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, 1.5, "not announced"),
    ],
    ids=["network", "this machine only"],
)
@pytest.mark.cyclone_only("Fast DDS repeats announcements itself, and Zenoh sends again what is lost")
def test_announcements_are_repeated_where_the_network_can_lose_them(network, environment, seconds, expected):
    done = subprocess.run(
        network.command(sys.executable, "-c", WAIT, seconds),
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    assert done.stdout.strip() == expected
