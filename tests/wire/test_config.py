# SPDX-License-Identifier: Apache-2.0
import os
import sys

import pytest

from coframe.errors import WireError
from coframe.wire import domains
from coframe.wire.dds import config


def test_the_default_range_is_this_machine():
    assert domains.domain_id({}) == 0
    assert config.discovery_range({}) == "LOCALHOST"
    xml = config.cyclone_config({})
    assert '<NetworkInterface address="127.0.0.1" multicast="true"/>' in xml
    assert '<Peer address="127.0.0.1"/>' in xml
    assert "<MaxAutoParticipantIndex>99</MaxAutoParticipantIndex>" in xml


@pytest.mark.parametrize(
    ("environment", "reach"),
    [
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, "SUBNET"),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "subnet"}, "SUBNET"),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}, "OFF"),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT"}, "SYSTEM_DEFAULT"),
        ({"ROS_LOCALHOST_ONLY": "1", "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, "LOCALHOST"),
        ({"ROS_LOCALHOST_ONLY": "0"}, "SUBNET"),
        ({"ROS_LOCALHOST_ONLY": "0", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}, "LOCALHOST"),
    ],
)
def test_the_discovery_ranges_of_ros(environment, reach):
    assert config.discovery_range(environment) == reach


@pytest.mark.skipif(sys.platform != "linux", reason="other systems keep the settings of the network")
def test_the_loopback_interface_has_large_packets_and_a_thread_for_data():
    xml = config.cyclone_config({})
    assert "<FragmentSize>64000B<" in xml
    assert "<MultipleReceiveThreads>true<" in xml
    for environment in ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, {"ROS_STATIC_PEERS": "10.0.0.1"}):
        xml = config.cyclone_config(environment)
        assert "<FragmentSize>14000B<" in xml
        assert "MultipleReceiveThreads" not in xml


def test_subnet_does_not_configure_interfaces():
    assert "Interface" not in config.cyclone_config({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"})


def test_off_disables_discovery():
    xml = config.cyclone_config({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF", "ROS_STATIC_PEERS": "10.0.0.1"})
    assert "<AllowMulticast>false</AllowMulticast>" in xml
    assert f"coframe_{os.getpid()}" in xml
    assert "Peer " not in xml


def test_static_peers():
    environment = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET", "ROS_STATIC_PEERS": "10.0.0.1;robot.local; "}
    xml = config.cyclone_config(environment)
    assert '<Peer address="10.0.0.1"/><Peer address="robot.local"/>' in xml
    assert "<AllowMulticast>spdp</AllowMulticast>" in xml, "peers are given where multicast is not delivered"
    assert "AllowMulticast" not in config.cyclone_config({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"})


@pytest.mark.parametrize(
    ("environment", "others"),
    [
        ({}, False),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF", "ROS_STATIC_PEERS": "10.0.0.1"}, False),
        ({"ROS_STATIC_PEERS": "localhost"}, False),
        ({"ROS_STATIC_PEERS": "10.0.0.1"}, True),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}, True),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT"}, True),
    ],
)
def test_whether_the_range_includes_other_machines(environment, others):
    assert config.reaches_other_machines(environment) == others


def test_a_peer_on_another_machine_disables_the_loopback_interface():
    xml = config.cyclone_config({"ROS_STATIC_PEERS": "10.0.0.1"})
    assert "NetworkInterface" not in xml
    assert "<AllowMulticast>false</AllowMulticast>" in xml
    assert '<Peer address="127.0.0.1"/><Peer address="10.0.0.1"/>' in xml
    assert "NetworkInterface" in config.cyclone_config({"ROS_STATIC_PEERS": "127.0.0.1"})


def test_the_configuration_of_the_user_comes_last():
    assert config.cyclone_config({"CYCLONEDDS_URI": "file:///etc/c.xml"}).endswith("</CycloneDDS>,file:///etc/c.xml")


@pytest.mark.parametrize("text", ["233", "-1", "abc", "1.5", "1000", "²"])
def test_an_invalid_domain_id(text):
    with pytest.raises(WireError, match=r"ROS_DOMAIN_ID is '.*': a domain ID is an integer from 0 to 232\.") as caught:
        domains.domain_id({"ROS_DOMAIN_ID": text})
    assert caught.value.hint


def test_an_invalid_discovery_range():
    with pytest.raises(WireError, match="'GALAXY': it must be one of OFF, LOCALHOST, SUBNET, SYSTEM_DEFAULT") as caught:
        config.discovery_range({"ROS_AUTOMATIC_DISCOVERY_RANGE": "galaxy"})
    assert "SUBNET includes the local network" in caught.value.hint
    with pytest.raises(WireError, match="ROS_LOCALHOST_ONLY is 'yes': it must be 0 or 1"):
        config.discovery_range({"ROS_LOCALHOST_ONLY": "yes"})


def test_an_invalid_peer():
    with pytest.raises(WireError, match="not an address or a host name") as caught:
        config.static_peers({"ROS_STATIC_PEERS": '10.0.0.1,"/><Domain'})
    assert "semicolons" in caught.value.hint
