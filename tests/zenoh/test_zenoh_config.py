# SPDX-License-Identifier: Apache-2.0
"""Sessions and routers are configured as rmw_zenoh_cpp configures them."""

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("zenoh", reason="these tests need eclipse-zenoh")

from coframe.errors import WireError
from coframe.wire.zenoh import config


def value(of: Any, path: str) -> Any:
    return json.loads(of.get_json(path))


# The default configuration files of rmw_zenoh_cpp.
COMMON = {
    "scouting/gossip/enabled": True,
    "scouting/gossip/multihop": False,
    "scouting/gossip/target": {"router": ["router", "peer"], "peer": ["router"]},
    "scouting/gossip/autoconnect": {"router": [], "peer": ["router", "peer"]},
    "timestamping/enabled": {"router": True, "peer": True, "client": True},
    "queries_default_timeout": 600000,
    "transport/shared_memory/enabled": False,
    "transport/link/tx/lease": 60000,
    "transport/link/tx/keep_alive": 2,
}
SESSION = {
    "mode": "peer",
    "connect/endpoints": ["tcp/localhost:7447"],
    "listen/endpoints": ["tcp/localhost:0"],
    "scouting/gossip/autoconnect_strategy": {"peer": {"to_router": "always", "to_peer": "greater-zid"}},
}
ROUTER = {
    "mode": "router",
    "connect/endpoints": [],
    "listen/endpoints": ["tcp/[::]:7447"],
    "scouting/multicast/enabled": False,
    "scouting/gossip/autoconnect_strategy": {"router": {"to_router": "always", "to_peer": "always"}},
}


@pytest.mark.parametrize(("path", "expected"), [*COMMON.items(), *SESSION.items()])
def test_sessions_have_the_defaults_of_rmw_zenoh(path: str, expected: Any) -> None:
    assert value(config.session_config({}), path) == expected


@pytest.mark.parametrize(("path", "expected"), [*COMMON.items(), *ROUTER.items()])
def test_routers_have_the_defaults_of_rmw_zenoh(path: str, expected: Any) -> None:
    assert value(config.router_config({}), path) == expected


def test_without_a_configuration_processes_of_this_machine_find_each_other_without_a_router() -> None:
    unconfigured = config.session_config({})
    assert value(unconfigured, "scouting/multicast/enabled") is True
    assert value(unconfigured, "scouting/multicast/interface") == "127.0.0.1"
    overridden = config.session_config({"ZENOH_CONFIG_OVERRIDE": 'mode="client"'})
    assert value(overridden, "scouting/multicast/enabled") is False


def test_overrides_apply_to_sessions_and_routers() -> None:
    environment = {"ZENOH_CONFIG_OVERRIDE": 'connect/endpoints=["tcp/10.0.0.1:7448"];scouting/gossip/enabled=false;'}
    for made in (config.session_config(environment), config.router_config(environment)):
        assert value(made, "connect/endpoints") == ["tcp/10.0.0.1:7448"]
        assert value(made, "scouting/gossip/enabled") is False


def test_the_value_of_an_override_may_contain_an_equals_sign() -> None:
    made = config.session_config({"ZENOH_CONFIG_OVERRIDE": 'connect/endpoints=["tls/a:1#root_ca_certificate=/b"]'})
    assert value(made, "connect/endpoints") == ["tls/a:1#root_ca_certificate=/b"]


def test_wrong_overrides_are_skipped_with_a_warning(caplog: pytest.LogCaptureFixture) -> None:
    made = config.session_config({"ZENOH_CONFIG_OVERRIDE": 'mode=client;no/such/key=1;nonsense;mode="client"'})
    assert value(made, "mode") == "client"
    warnings = "\n".join(caplog.messages)
    assert "mode=client is skipped: expected array" in warnings  # strings keep their quotes
    assert "no/such/key=1 is skipped: unknown key." in warnings
    assert "'nonsense' is skipped, which is not of the form path/to/key=value" in warnings
    assert "cargo" not in warnings


def test_a_file_replaces_all_defaults_and_overrides_change_it(tmp_path: Path) -> None:
    file = tmp_path / "session.json5"
    file.write_text("{ /* JSON5 */ mode: 'client', connect: {endpoints: ['tcp/192.0.2.1:5']} }")
    made = config.session_config({"ZENOH_SESSION_CONFIG_URI": str(file)})
    assert value(made, "mode") == "client"
    assert config.connect_endpoints(made) == ["tcp/192.0.2.1:5"]
    assert value(made, "transport/link/tx/lease") != 60000
    environment = {"ZENOH_SESSION_CONFIG_URI": str(file), "ZENOH_CONFIG_OVERRIDE": 'mode="peer"'}
    assert value(config.session_config(environment), "mode") == "peer"


def test_a_router_file_is_named_by_the_variable_or_by_the_caller(tmp_path: Path) -> None:
    first, second = tmp_path / "first.json5", tmp_path / "second.json5"
    first.write_text("{mode: 'router', listen: {endpoints: ['tcp/127.0.0.1:1']}}")
    second.write_text("{mode: 'router', listen: {endpoints: ['tcp/127.0.0.1:2']}}")
    environment = {"ZENOH_ROUTER_CONFIG_URI": str(first)}
    assert value(config.router_config(environment), "listen/endpoints") == ["tcp/127.0.0.1:1"]
    assert value(config.router_config(environment, file=str(second)), "listen/endpoints") == ["tcp/127.0.0.1:2"]
    listening = config.router_config(environment, listen=["tcp/127.0.0.1:3"])
    assert value(listening, "listen/endpoints") == ["tcp/127.0.0.1:3"]


def test_invalid_files_and_endpoints_are_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(WireError, match=r"The file /nowhere\.json5, named by ZENOH_SESSION_CONFIG_URI, does not exist"):
        config.session_config({"ZENOH_SESSION_CONFIG_URI": "/nowhere.json5"})
    for arguments, source in (
        (({},), "omit --config"),
        (({"ZENOH_ROUTER_CONFIG_URI": "/nowhere.json5"},), "unset ZENOH_ROUTER_CONFIG_URI"),
    ):
        with pytest.raises(WireError, match=r"does not exist") as missing:
            config.router_config(*arguments, file="/nowhere.json5" if "--config" in source else "")
        assert f", or {source} to use the defaults of ROS 2." in missing.value.hint
    damaged = tmp_path / "damaged.json5"
    damaged.write_text("{mode: ")
    with pytest.raises(WireError, match=r"damaged.json5 cannot be read: expected array.* string\.") as caught:
        config.router_config({"ZENOH_ROUTER_CONFIG_URI": str(damaged)})
    assert "cargo" not in str(caught.value)
    with pytest.raises(WireError, match=r"The endpoints foo are not valid: Endpoints must be of the form"):
        config.router_config({}, listen=["foo"])


@pytest.mark.parametrize(("text", "attempts"), [("", 1), ("5", 5), ("0", None), ("-1", 0)])
def test_the_number_of_router_checks(text: str, attempts: int | None) -> None:
    assert config.router_check_attempts({"ZENOH_ROUTER_CHECK_ATTEMPTS": text}) == attempts


def test_an_invalid_number_of_router_checks_is_an_error() -> None:
    with pytest.raises(WireError, match="ZENOH_ROUTER_CHECK_ATTEMPTS is 'often': it must be an integer"):
        config.router_check_attempts({"ZENOH_ROUTER_CHECK_ATTEMPTS": "often"})


def test_connect_endpoints_can_depend_on_the_mode() -> None:
    environment = {"ZENOH_CONFIG_OVERRIDE": 'connect/endpoints={"peer":["tcp/a:1"],"client":["tcp/b:1"]}'}
    assert config.connect_endpoints(config.session_config(environment)) == ["tcp/a:1"]


def test_a_missing_package_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "xxhash", None)
    with pytest.raises(WireError, match=r"Communication over Zenoh needs .*xxhash.*: pip install 'coframe\[zenoh\]'"):
        config.session_config({})
