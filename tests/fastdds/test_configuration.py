# SPDX-License-Identifier: Apache-2.0
"""The environment variables of rmw_fastrtps: what they do, and what is said about invalid values."""

import os
import shutil
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from coframe_fastdds import _config as config
from coframe_fastdds import _fastdds as native
from coframe_fastdds import _security as security
from keystores import Keystore  # of this folder

import coframe
from coframe.errors import WireError

PROFILES = """<?xml version="1.0" encoding="UTF-8"?>
<dds><profiles xmlns="http://www.eprosima.com">
<transport_descriptors><transport_descriptor>
<transport_id>udp</transport_id><type>UDPv4</type>
</transport_descriptor></transport_descriptors>
<participant profile_name="default" is_default_profile="true"><rtps>
<userTransports><transport_id>udp</transport_id></userTransports><useBuiltinTransports>false</useBuiltinTransports>
</rtps></participant>
<data_writer profile_name="rt/news"><qos><ownership><kind>EXCLUSIVE</kind></ownership></qos></data_writer>
</profiles></dds>
"""
SECONDS = 20  # in which a message must arrive
SHORT = 2  # in which none may arrive


@pytest.fixture
def listen(start, domain_id: int) -> Callable[..., str]:
    """Return a function that starts a talker and returns what a listener prints."""
    assert domain_id

    def run(talker: dict[str, str], listener: dict[str, str], seconds: float = SECONDS, size: int = 5) -> str:
        started = start("fastdds", "talker.py", size, **talker)
        assert started.stdout.readline() == "ready\n"
        output, _ = start("fastdds", "listener.py", seconds, **listener).communicate(timeout=60)
        started.communicate(timeout=60)
        return output.strip()

    return run


@pytest.fixture
def keystore(tmp_path: Path) -> Keystore:
    if not native.HAS_SECURITY:
        pytest.skip("the library was built without security")
    if shutil.which("openssl") is None:
        pytest.skip("keystores are made with openssl")
    made = Keystore(tmp_path / "keystore")
    made.add("/robot")
    return made


@pytest.fixture
def server() -> Iterator[str]:
    """The address of a discovery server."""
    folder = Path(sys.prefix)
    program = folder / "bin" / "fast-discovery-server"
    if not program.exists():
        pytest.skip("the discovery server is part of the package ros-fastdds")
    with socket.socket(type=socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    libraries = [folder / "lib", *folder.glob("lib/python3*/site-packages/ros_fastdds.libs")]
    # 42 is the number of the command that the tool `fastdds discovery` calls.
    process = subprocess.Popen(
        [program, "42", "-i", "0", "-l", "127.0.0.1", "-p", str(port)],
        env={**os.environ, "LD_LIBRARY_PATH": os.pathsep.join(map(str, libraries))},
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert "Server started" in process.stdout.readline()
    yield f"127.0.0.1:{port}"
    process.terminate()
    process.communicate()


def test_processes_with_the_range_off_are_alone(listen) -> None:
    off = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "off"}
    assert listen(off, off, SHORT) == "0"


@pytest.mark.parametrize("is_talker", [True, False])
def test_a_process_with_the_range_off_is_not_found_by_others(listen, is_talker: bool) -> None:
    off: dict[str, str] = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"}
    assert listen(off if is_talker else {}, {} if is_talker else off, SHORT) == "0"


def test_nodes_of_one_process_with_the_range_off_communicate(domain_id: int, monkeypatch) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    string = coframe.messages.find("std_msgs/msg/String")
    with (
        coframe.connect("one", domain=domain_id, wire="fastdds") as one,
        coframe.connect("other", domain=domain_id, wire="fastdds") as other,
    ):
        received = other.subscribe("/news", string)
        publisher = one.publisher("/news", string)
        for _ in range(200):
            publisher.publish(string(data="within"))
            if (message := received.receive("0.1s")) is not None:
                break
        assert message is not None


def test_static_peers_are_found(listen) -> None:
    assert listen({"ROS_STATIC_PEERS": "localhost;127.0.0.1"}, {"ROS_STATIC_PEERS": " 127.0.0.1 ; "}) == "5"


@pytest.mark.parametrize("mode", ["SYNCHRONOUS", "ASYNCHRONOUS", "AUTO"])
def test_publication_modes(listen, mode: str) -> None:
    assert listen({"RMW_FASTRTPS_PUBLICATION_MODE": mode}, {}, size=200_000) == "200000"


def test_nodes_are_discovered_through_a_server(listen, server: str) -> None:
    assert listen({"ROS_DISCOVERY_SERVER": server}, {"ROS_DISCOVERY_SERVER": server}) == "5"


def test_commands_wait_for_the_server(start, server: str, domain_id: int) -> None:
    assert start("fastdds", "talker.py", 5, ROS_DISCOVERY_SERVER=server).stdout.readline() == "ready\n"
    environment = {**os.environ, "COFRAME_WIRE": "fastdds", "ROS_DISCOVERY_SERVER": f"{server}"}
    command = [sys.executable, "-m", "coframe.cli", "node", "list"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == "/talker\n", (domain_id, done.stderr)


@pytest.mark.parametrize("variable", config.PROFILE_VARIABLES)
def test_profiles_configure_transports_and_endpoints(listen, tmp_path: Path, variable: str) -> None:
    (tmp_path / "profiles.xml").write_text(PROFILES)
    profiles = {variable: str(tmp_path / "profiles.xml")}
    assert listen(profiles, profiles) == "5"
    # An exclusive writer does not match a reader that shares.
    assert listen({**profiles, "RMW_FASTRTPS_USE_QOS_FROM_XML": "1"}, profiles, SHORT) == "0"


@pytest.mark.parametrize("variable", config.PROFILE_VARIABLES)
def test_a_damaged_file_with_profiles_is_named(start, domain_id: int, tmp_path: Path, variable: str) -> None:
    assert domain_id
    path = tmp_path / "profiles.xml"
    path.write_text(PROFILES[:300])
    output, _ = start("fastdds", "listener.py", 1, **{variable: str(path)}).communicate(timeout=60)
    assert f"Fast DDS cannot read the profiles in {path}" in output


def test_processes_of_one_keystore_communicate(listen, keystore: Keystore) -> None:
    keystore.add("/arm/left")
    assert listen(keystore.environment("/robot"), keystore.environment("/arm/left")) == "5"


def test_processes_of_another_keystore_or_without_one_are_strangers(listen, keystore: Keystore, tmp_path: Path) -> None:
    other = Keystore(tmp_path / "other")
    other.add("/robot")
    assert listen(keystore.environment("/robot"), other.environment("/robot"), SHORT) == "0"
    assert listen({}, keystore.environment("/robot"), SHORT) == "0"
    assert listen(keystore.environment("/robot"), {}, SHORT) == "0"


def test_a_topic_that_the_permissions_do_not_allow_is_refused(domain_id: int, keystore: Keystore) -> None:
    assert domain_id
    keystore.add("/mute", publishes=("ros_discovery_info", "rt/rosout", "rt/parameter_events"))
    code = (
        "import coframe\n"
        "from coframe.errors import WireError\n"
        "with coframe.connect('mute') as ros:\n"
        "    try: ros.publisher('/news', coframe.messages.find('std_msgs/msg/String'))\n"
        "    except WireError as error: print(error)\n"
    )
    environment = {**os.environ, "COFRAME_WIRE": "fastdds", **keystore.environment("/mute")}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.startswith("Fast DDS cannot create an endpoint on /news")


def test_a_damaged_certificate_is_an_error(start, domain_id: int, keystore: Keystore) -> None:
    (keystore.folder / "enclaves/robot/cert.pem").write_text("no certificate")
    output, _ = start("fastdds", "listener.py", 1, **keystore.environment("/robot")).communicate(timeout=60)
    assert f"Joining domain {domain_id} with the enclave /robot failed" in output
    assert str(keystore.folder / "enclaves/robot") in output


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({"RMW_FASTRTPS_PUBLICATION_MODE": "LATER"}, "'LATER': it must be SYNCHRONOUS, ASYNCHRONOUS or AUTO"),
        ({"RMW_FASTRTPS_USE_QOS_FROM_XML": "yes"}, "RMW_FASTRTPS_USE_QOS_FROM_XML is 'yes': it must be 0 or 1"),
        ({"ROS_AUTOMATIC_DISCOVERY_RANGE": "NEAR"}, "'NEAR': it must be one of OFF"),
        ({"ROS_STATIC_PEERS": "a,b"}, "ROS_STATIC_PEERS contains 'a,b'"),
        ({"ROS_DISCOVERY_SERVER": "127.0.0.1:99999"}, "contains '127.0.0.1:99999', which is not the address"),
        ({"ROS_DISCOVERY_SERVER": ";a server"}, "contains 'a server', which is not the address"),
        ({"ROS_DISCOVERY_SERVER": "host.invalid"}, "contains 'host.invalid', whose address is unknown"),
        ({"FASTDDS_DEFAULT_PROFILES_FILE": "/nowhere.xml"}, "'/nowhere.xml', which cannot be read"),
        ({"FASTRTPS_DEFAULT_PROFILES_FILE": "/dev/zero"}, "FASTRTPS_DEFAULT_PROFILES_FILE: /dev/zero"),
        ({"ROS_SECURITY_ENABLE": "1"}, "ROS_SECURITY_ENABLE is '1': it must be false or true"),
        ({"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_STRATEGY": "enforce"}, "it must be Permissive or Enforce"),
        ({"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_STRATEGY": "Enforce"}, "ROS_SECURITY_KEYSTORE is not set"),
        (
            {"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_STRATEGY": "Enforce", "ROS_SECURITY_KEYSTORE": "/nowhere"},
            "there is no folder /nowhere/enclaves of the enclave /",
        ),
    ],
)
def test_invalid_values_are_errors_with_what_is_valid(environment: dict[str, str], expected: str) -> None:
    with pytest.raises(WireError) as raised:
        config.read(environment)
    assert expected in str(raised.value)
    assert "\n" not in str(raised.value)
    assert raised.value.hint


@pytest.mark.parametrize("address", ["::1", "host.invalid"])
def test_peers_need_an_ipv4_address(address: str) -> None:
    with pytest.raises(WireError, match=f"ROS_STATIC_PEERS contains '{address}', whose address is unknown"):
        config.addresses((address,))


@pytest.mark.parametrize("servers", ["", ";", "127.0.0.1:11811;;localhost", "UDPv4:[127.0.0.1]:11811", "[::1]:11811"])
def test_addresses_of_servers(servers: str) -> None:
    assert config.read({"ROS_DISCOVERY_SERVER": servers}).server == servers


def test_security_that_is_not_enforced_warns(caplog) -> None:
    assert config.read({"ROS_SECURITY_ENABLE": "true", "ROS_SECURITY_KEYSTORE": "/nowhere"}).properties == ()
    assert "there is no folder /nowhere/enclaves of the enclave /: this process communicates without" in caplog.text


@pytest.mark.skipif(native.HAS_SECURITY, reason="the library has security")
def test_a_library_without_security_does_not_communicate_where_it_is_enforced(tmp_path: Path) -> None:
    """Fast DDS itself would ignore the properties, and communicate with everyone."""
    for name in security.FILES.values():
        (tmp_path / "enclaves" / "robot").mkdir(parents=True, exist_ok=True)
        (tmp_path / "enclaves" / "robot" / name).touch()
    environment = {
        "ROS_SECURITY_ENABLE": "true",
        "ROS_SECURITY_STRATEGY": "Enforce",
        "ROS_SECURITY_KEYSTORE": str(tmp_path),
        "ROS_SECURITY_ENCLAVE_OVERRIDE": "/robot",
    }
    with pytest.raises(WireError, match="was built without security"):
        config.read(environment)
    assert config.read({**environment, "ROS_SECURITY_STRATEGY": "Permissive"}).properties == ()
