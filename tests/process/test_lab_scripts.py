# SPDX-License-Identifier: Apache-2.0
"""The five unchanged scripts of the lab in five processes, observed by an independent program."""

import signal

import pytest

TF = "/tf:tf2_msgs/msg/TFMessage:volatile"
TF_STATIC = "/tf_static:tf2_msgs/msg/TFMessage:transient_local"
POSE = "/end_effector_pose:geometry_msgs/msg/PoseStamped:volatile"
ATTEMPTS = 3  # on a busy machine, a single measurement of rates can fail


def rate(received):
    """Return the rate of messages from their stamps. Arrival times are less exact if the observer is delayed."""
    stamps = [stamp(message) for _, message in received]
    return (len(stamps) - 1) / (max(stamps) - min(stamps)) if len(stamps) > 1 else 0.0


def stamp(message):
    header = message["transforms"][0]["header"] if "transforms" in message else message["header"]
    return header["stamp"]["sec"] + header["stamp"]["nanosec"] * 1e-9


def eventually_at_rate(processes, expected, topics, of):
    """Observe until the rates `of` the received messages are within 10 % of `expected`. Return the messages."""
    for _ in range(ATTEMPTS):
        received = processes.observe(3.0, *topics)
        found = of(received)
        if found == pytest.approx(expected, rel=0.1):
            return received
    pytest.fail(f"rates {found}, expected {expected}")


def start_lab(processes, shared, *names):
    for name in names:
        processes.start(name, "python", shared / "lab" / f"{name}.py")


@pytest.mark.slow
@pytest.mark.timeout(180)
def test_five_scripts_as_five_processes(processes, shared):
    four = ("static_tf_broadcaster", "dynamic_tf_broadcaster", "tf_listener", "sensor_transform")
    start_lab(processes, shared, *four)
    received = eventually_at_rate(
        processes,
        [150, 10],
        (TF, POSE, TF_STATIC),
        lambda received: [rate(received["/tf"]), rate(received["/end_effector_pose"])],
    )

    # The observer subscribes late and receives the static transforms nevertheless.
    (statics,) = [message["transforms"] for _, message in received["/tf_static"]]
    assert {(t["header"]["frame_id"], t["child_frame_id"]) for t in statics} == {
        ("end_effector", "camera_link"),
        ("base_link", "imu_link"),
        ("base_link", "lidar_link"),
    }
    for _, pose in received["/end_effector_pose"]:
        assert pose["header"]["frame_id"] == "base_link"
        assert pose["pose"]["position"]["z"] == pytest.approx(0.1)

    start_lab(processes, shared, "complete_tf_tree")
    received = eventually_at_rate(
        processes,
        [400, 150],
        (TF,),
        lambda received: [rate(received["/tf"]), rate(from_dynamic_broadcaster(received["/tf"]))],
    )
    assert all(processes.running(name) for name in (*four, "complete_tf_tree"))
    assert "EE position: [" in processes.text("tf_listener")

    for name in (*four, "complete_tf_tree"):
        how = signal.SIGTERM if name in {"sensor_transform", "complete_tf_tree"} else signal.SIGINT
        code, text = processes.end(name, how)
        assert "Traceback" not in text, text
        assert code in {0, -signal.SIGINT}, f"{name} ended with {code}: {text}"


def from_dynamic_broadcaster(received):
    """Return the messages of the arm with links of 0.5 m and 0.4 m. Those of the complete tree are shorter."""
    of_dynamic = {"link1": ("z", 0.1), "link2": ("x", 0.5), "end_effector": ("x", 0.4)}

    def is_its(message):
        (transform,) = message["transforms"]
        axis, value = of_dynamic.get(transform["child_frame_id"], ("x", None))
        return transform["transform"]["translation"][axis] == value

    return [entry for entry in received if is_its(entry[1])]
