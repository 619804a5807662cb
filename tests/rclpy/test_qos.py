# SPDX-License-Identifier: Apache-2.0
"""QoS profiles."""

import pytest

from rcl_interfaces.msg import SetParametersResult
from rclpy.duration import Duration
from rclpy.parameter import Parameter
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    InvalidQoSProfileException,
    LivelinessPolicy,
    QoSCompatibility,
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSPolicyKind,
    QoSPresetProfiles,
    QoSProfile,
    QoSReliabilityPolicy,
    ReliabilityPolicy,
    as_qos_profile,
    qos_check_compatible,
    qos_profile_sensor_data,
    qos_profile_system_default,
)
from rclpy.qos_overriding_options import InvalidQosOverridesError, QoSOverridingOptions
from std_msgs.msg import String


def test_depth_alone_is_keep_last_reliable_volatile():
    profile = QoSProfile(depth=7)
    assert profile.history is HistoryPolicy.KEEP_LAST
    assert profile.reliability is ReliabilityPolicy.RELIABLE
    assert profile.durability is DurabilityPolicy.VOLATILE
    assert profile.depth == 7


def test_incomplete_profiles_are_rejected():
    with pytest.raises(InvalidQoSProfileException, match="History and/or depth settings are required"):
        QoSProfile()
    with pytest.raises(InvalidQoSProfileException, match="KEEP_LAST without a depth setting"):
        QoSProfile(history=HistoryPolicy.KEEP_LAST)
    assert QoSProfile(history=HistoryPolicy.KEEP_ALL).depth == 10


def test_wrong_types_are_rejected():
    with pytest.raises(AssertionError, match="nonsense"):
        QoSProfile(depth=1, nonsense=2)
    with pytest.raises(AssertionError):
        QoSProfile(depth="1")
    with pytest.raises(AssertionError):
        QoSProfile(depth=1, deadline=1.0)
    with pytest.raises(ValueError, match="17"):
        QoSProfile(depth=1, durability=17)


def test_both_spellings_are_one_class():
    assert QoSHistoryPolicy is HistoryPolicy
    assert QoSReliabilityPolicy is ReliabilityPolicy
    assert QoSDurabilityPolicy is DurabilityPolicy
    assert QoSLivelinessPolicy is LivelinessPolicy
    assert QoSDurabilityPolicy.RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL is DurabilityPolicy.TRANSIENT_LOCAL


def test_short_names():
    assert "keep_last" in HistoryPolicy.short_keys()
    assert HistoryPolicy.get_from_short_key("SYSTEM_DEFAULT") == HistoryPolicy.SYSTEM_DEFAULT.value
    assert DurabilityPolicy.TRANSIENT_LOCAL.short_key == "transient_local"
    assert QoSPresetProfiles.get_from_short_key("system_default") is qos_profile_system_default
    assert QoSPresetProfiles.SENSOR_DATA.value is qos_profile_sensor_data


def test_profiles_are_compared_by_value():
    assert QoSProfile(depth=1) == QoSProfile(depth=1)
    assert QoSProfile(depth=1) != QoSProfile(depth=2)
    assert QoSProfile(depth=1, lifespan=Duration(seconds=1)) != QoSProfile(depth=1)
    assert QoSProfile(depth=1) != 1
    assert "depth=1" in repr(QoSProfile(depth=1))


def test_int_is_a_depth():
    assert as_qos_profile(3) == QoSProfile(depth=3)
    with pytest.raises(ValueError, match="greater than or equal to zero"):
        as_qos_profile(-1)
    with pytest.raises(TypeError, match="Expected QoSProfile or int"):
        as_qos_profile("sensor_data")


def test_compatibility():
    reliable, best_effort = QoSProfile(depth=1, liveliness=LivelinessPolicy.AUTOMATIC), qos_profile_sensor_data
    assert qos_check_compatible(reliable, reliable) == (QoSCompatibility.OK, "")
    text = "WARNING: Publisher's liveliness is automatic, but subscription's is system_default;"
    assert qos_check_compatible(reliable, best_effort) == (QoSCompatibility.WARNING, text)
    slow, fast = (QoSProfile(depth=1, deadline=Duration(seconds=seconds)) for seconds in (2, 1))
    assert qos_check_compatible(slow, fast) == (
        QoSCompatibility.ERROR,
        "ERROR: Subscription deadline is less than publisher deadline;",
    )
    verdict, reason = qos_check_compatible(best_effort, reliable)
    assert verdict is QoSCompatibility.ERROR
    assert "Best effort publisher and reliable subscription" in reason


def test_qos_override_parameters(make_node):
    given = {
        "qos_overrides./words.subscription.reliability": "reliable",
        "qos_overrides./words.subscription.depth": 9,
        "qos_overrides./words.subscription.durability": "transient_local",  # The node does not allow this override.
        "qos_overrides./words.publisher_late.lifespan": 2_000_000_000,
        "qos_overrides./wrong.publisher.reliability": "sometimes",
    }
    node = make_node(parameter_overrides=[Parameter(name, value=value) for name, value in given.items()])
    usual = QoSOverridingOptions.with_default_policies()
    received = node.create_subscription(String, "words", print, qos_profile_sensor_data, qos_overriding_options=usual)
    profile = received.qos_profile
    assert (profile.reliability, profile.depth) == (ReliabilityPolicy.RELIABLE, 9)
    assert (profile.history, profile.durability) == (HistoryPolicy.KEEP_LAST, DurabilityPolicy.VOLATILE)
    assert qos_profile_sensor_data.depth == 5
    name = "qos_overrides./words.subscription.history"
    assert node.get_parameter(name).value == "keep_last"
    assert not node.set_parameters([Parameter(name, value="keep_all")])[0].successful
    late = QoSOverridingOptions([QoSPolicyKind.LIFESPAN], entity_id="late")
    publisher = node.create_publisher(String, "words", 10, qos_overriding_options=late)
    assert publisher.qos_profile.lifespan == Duration(seconds=2)
    with pytest.raises(
        InvalidQosOverridesError, match=r"Invalid reliability 'sometimes' \(valid values: .*best_effort"
    ):
        node.create_publisher(String, "wrong", 10, qos_overriding_options=usual)
    never = QoSOverridingOptions([], callback=lambda _: SetParametersResult(successful=False, reason="not so"))
    assert node.describe_parameter(name).description == "history for subscription `/words` with id `None`"
    text = "Provided QoS overrides for publisher `/refused` with id `None`, are not valid: not so"
    with pytest.raises(InvalidQosOverridesError, match=text):
        node.create_publisher(String, "refused", 10, qos_overriding_options=never)


def test_a_queue_without_places_is_reported():
    with pytest.warns(UserWarning, match="A zero depth with KEEP_LAST doesn't make sense"):
        assert QoSProfile(depth=0).depth == 0


def test_policies_are_also_positional_arguments():
    profile = QoSProfile(HistoryPolicy.KEEP_LAST, 3, ReliabilityPolicy.BEST_EFFORT)
    assert (profile.history, profile.depth, profile.reliability) == (
        HistoryPolicy.KEEP_LAST,
        3,
        ReliabilityPolicy.BEST_EFFORT,
    )
