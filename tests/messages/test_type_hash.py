# SPDX-License-Identifier: Apache-2.0
"""Type hashes, compared with those of ROS 2's own packages."""

import contextlib
import re

import pytest
from rosbags.typesys import Stores, get_typestore

from coframe.messages import find
from coframe.messages.type_hash import type_hash

# As ROS 2 Jazzy installs them in share/PACKAGE/{msg,srv,action}/NAME.json.
PUBLIC = {
    "std_msgs/msg/String": "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18",
    "builtin_interfaces/msg/Time": "b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197",
    "geometry_msgs/msg/TransformStamped": "0a241f87d04668d94099cbb5ba11691d5ad32c2f29682e4eb5653424bd275206",
    "tf2_msgs/msg/TFMessage": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    "sensor_msgs/msg/LaserScan": "64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "std_srvs/srv/SetBool": "abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a",
    "tf2_msgs/action/LookupTransform": "0b8adf6bc0b5958879e3265b41a457e03558fe523890a81252c70eba97a82c5d",
}


@pytest.mark.parametrize(("interface", "digits"), PUBLIC.items())
def test_hashes_are_those_of_ros(interface, digits):
    assert type_hash(find(interface)) == f"RIHS01_{digits}"


# Why the hash of rosbags for Jazzy is another one.
OTHER = {
    "service_msgs/msg/ServiceEventInfo": "rosbags keeps char apart from uint8; ROS 2 does not, see SetBool above",
    "rmw_dds_common/msg/Gid": "rosbags keeps char apart from uint8",
    "rmw_dds_common/msg/NodeEntitiesInfo": "contains Gid",
    "rmw_dds_common/msg/ParticipantEntitiesInfo": "contains Gid",
    "std_msgs/msg/Char": "rosbags keeps char apart from uint8",
}


def test_hashes_of_all_shared_messages_are_those_of_rosbags():
    store = get_typestore(Stores.ROS2_JAZZY)
    known = {}
    for name in store.fielddefs:
        with contextlib.suppress(LookupError):  # coframe does not have all packages
            known[name] = type_hash(find(name))
    assert len(known) > 100
    assert {name for name, text in known.items() if text != store.hash_rihs01(name)} <= OTHER.keys()


def test_parts_of_services_and_actions_have_hashes():
    parts = [find("std_srvs/srv/Empty").Request, find("std_srvs/srv/SetBool").Response]
    impl = find("tf2_msgs/action/LookupTransform").Impl
    hashes = {type_hash(part) for part in (*parts, impl.SendGoalService, impl.GetResultService, impl.FeedbackMessage)}
    assert len(hashes) == 5
    assert all(re.fullmatch("RIHS01_[0-9a-f]{64}", text) for text in hashes)


def test_other_objects_are_rejected():
    with pytest.raises(TypeError, match="expected a message, service or action class, not 'std_msgs/msg/String'"):
        type_hash("std_msgs/msg/String")
