"""The lab's five scripts, as they stand, as five processes; what an independent program hears of them."""

import signal

import pytest

TF = "/tf:tf2_msgs/msg/TFMessage:volatile"
TF_STATIC = "/tf_static:tf2_msgs/msg/TFMessage:transient_local"
POSE = "/end_effector_pose:geometry_msgs/msg/PoseStamped:volatile"
ATTEMPTS = 3  # a busy machine may spoil a measurement of rates, not three


def rate(heard):
    """Messages per second, by their own stamps: the observer's clock also counts what it had to catch up with."""
    stamps = [stamp(message) for _, message in heard]
    return (len(stamps) - 1) / (max(stamps) - min(stamps)) if len(stamps) > 1 else 0.0


def stamp(message):
    header = message["transforms"][0]["header"] if "transforms" in message else message["header"]
    return header["stamp"]["sec"] + header["stamp"]["nanosec"] * 1e-9


def eventually_at_rate(processes, expected, topics, of):
    """Observes until the rates `of` what was heard are within a tenth of `expected`; returns what was heard."""
    for _ in range(ATTEMPTS):
        heard = processes.observe(3.0, *topics)
        found = of(heard)
        if found == pytest.approx(expected, rel=0.1):
            return heard
    pytest.fail(f"rates {found}, expected {expected}")


def start_lab(processes, shared, *names):
    for name in names:
        processes.start(name, "python", shared / "lab" / f"{name}.py")


@pytest.mark.timeout(180)
def test_five_scripts_as_five_processes(processes, shared):
    four = ("static_tf_broadcaster", "dynamic_tf_broadcaster", "tf_listener", "sensor_transform")
    start_lab(processes, shared, *four)
    heard = eventually_at_rate(
        processes,
        [150, 10],
        (TF, POSE, TF_STATIC),
        lambda heard: [rate(heard["/tf"]), rate(heard["/end_effector_pose"])],
    )

    # The observer came late, and yet it knows the static transforms.
    (statics,) = [message["transforms"] for _, message in heard["/tf_static"]]
    assert {(t["header"]["frame_id"], t["child_frame_id"]) for t in statics} == {
        ("end_effector", "camera_link"),
        ("base_link", "imu_link"),
        ("base_link", "lidar_link"),
    }
    for _, pose in heard["/end_effector_pose"]:
        assert pose["header"]["frame_id"] == "base_link"
        assert pose["pose"]["position"]["z"] == pytest.approx(0.1)

    start_lab(processes, shared, "complete_tf_tree")
    heard = eventually_at_rate(
        processes, [400, 150], (TF,), lambda heard: [rate(heard["/tf"]), rate(from_dynamic_broadcaster(heard["/tf"]))]
    )
    assert all(processes.running(name) for name in (*four, "complete_tf_tree"))
    assert "EE position: [" in processes.text("tf_listener")

    for name in (*four, "complete_tf_tree"):
        how = signal.SIGTERM if name in {"sensor_transform", "complete_tf_tree"} else signal.SIGINT
        code, text = processes.end(name, how)
        assert "Traceback" not in text, text
        assert code in {0, -signal.SIGINT}, f"{name} ended with {code}: {text}"


def from_dynamic_broadcaster(heard):
    """The messages of the arm whose links are half a metre and 0.4 m long; the complete tree's are shorter."""
    of_dynamic = {"link1": ("z", 0.1), "link2": ("x", 0.5), "end_effector": ("x", 0.4)}

    def is_its(message):
        (transform,) = message["transforms"]
        axis, value = of_dynamic.get(transform["child_frame_id"], ("x", None))
        return transform["transform"]["translation"][axis] == value

    return [entry for entry in heard if is_its(entry[1])]
