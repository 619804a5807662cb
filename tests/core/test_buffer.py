# SPDX-License-Identifier: Apache-2.0
"""Results, errors and texts of the buffer equal those of tf2."""

import random
import threading
import time

import numpy as np
import pytest

import coframe

SECOND = 1_000_000_000
EXTRAPOLATION = "Lookup would require extrapolation into"
SUFFIX = ", when looking up transform from frame [lidar] to frame [odom]"
UNCONNECTED = (
    "Could not find a connection between 'odom' and 'other' because they are not part of the same tree."
    "Tf has two or more unconnected trees."
)
SLASH = 'Invalid argument "/odom" passed to lookupTransform argument target_frame'


@pytest.fixture
def buffer():
    """odom -> base moves 1 m/s along x from 10 s to 12 s; base -> lidar is fixed; map2 -> other is another tree."""
    buffer = coframe.Buffer()
    for second in (10, 11, 12):
        buffer.set("odom", "base", coframe.Transform([second - 10, 0, 0]), second * SECOND)
    buffer.set("base", "lidar", coframe.Transform([0, 0, 0.5]), static=True)
    buffer.set("map2", "other", coframe.Transform(), static=True)
    return buffer


def test_interpolates_between_samples(buffer):
    transform = buffer.lookup("odom", "lidar", 10_250_000_000)
    assert transform.translation == pytest.approx([0.25, 0, 0.5])
    assert (transform.target, transform.source, transform.stamp) == ("odom", "lidar", 10_250_000_000)


def test_latest_is_the_newest_common_time(buffer):
    buffer.set("lidar", "beam", coframe.Transform([1, 0, 0]), 11 * SECOND)
    assert buffer.lookup("odom", "beam").stamp == 11 * SECOND
    assert buffer.latest_common_time("odom", "beam") == 11 * SECOND
    assert buffer.lookup("odom", "base").stamp == 12 * SECOND


@pytest.mark.parametrize(
    ("target", "source", "stamp", "kind", "text"),
    [
        (
            "odom",
            "lidar",
            13 * SECOND,
            coframe.ExtrapolationException,
            f"{EXTRAPOLATION} the future.  Requested time 13.000000 but the latest data is at time 12.000000{SUFFIX}",
        ),
        (
            "odom",
            "lidar",
            9 * SECOND,
            coframe.ExtrapolationException,
            f"{EXTRAPOLATION} the past.  Requested time 9.000000 but the earliest data is at time 10.000000{SUFFIX}",
        ),
        (
            "odom",
            "other",
            0,
            coframe.ConnectivityException,
            UNCONNECTED,
        ),
        (
            "odom",
            "lidr",
            0,
            coframe.LookupException,
            '"lidr" passed to lookupTransform argument source_frame does not exist. ',
        ),
        (
            "",
            "lidar",
            0,
            coframe.InvalidArgumentException,
            'Invalid argument "" passed to lookupTransform argument target_frame - in tf2 frame_ids cannot be empty',
        ),
        (
            "/odom",
            "lidar",
            0,
            coframe.InvalidArgumentException,
            f"{SLASH} - in tf2 frame_ids cannot start with a '/'",
        ),
    ],
)
def test_failures_have_the_texts_of_tf2(buffer, target, source, stamp, kind, text):
    with pytest.raises(coframe.TransformException) as caught:
        buffer.lookup(target, source, stamp)
    assert type(caught.value) is kind
    assert str(caught.value) == text
    assert (caught.value.target, caught.value.source) == (target, source)
    assert caught.value.hint


def test_extrapolation_errors_name_the_edge_and_its_stamps(buffer):
    with pytest.raises(coframe.ExtrapolationException) as caught:
        buffer.lookup("odom", "lidar", 13 * SECOND)
    error = caught.value
    assert error.edge == ("odom", "base")
    assert (error.requested, error.earliest, error.latest) == (13 * SECOND, 10 * SECOND, 12 * SECOND)


def test_a_single_sample_is_valid_only_at_its_own_time():
    buffer = coframe.Buffer()
    buffer.set("a", "b", coframe.Transform(), 10 * SECOND)
    assert buffer.can_transform("a", "b", 10 * SECOND)
    with pytest.raises(coframe.ExtrapolationException, match=r"at time 9.000000, but only time 10.000000 is in the"):
        buffer.lookup("a", "b", 9 * SECOND)


def test_disconnected_trees_are_named_with_the_missing_edge(buffer):
    with pytest.raises(coframe.ConnectivityException) as caught:
        buffer.lookup("odom", "other")
    for words in ("'odom' with base, lidar", "'map2' with other", "a transform with the child 'map2'"):
        assert words in caught.value.hint


def test_hint_for_an_unknown_frame_never_suggests_the_other_frame_of_the_lookup(buffer):
    buffer.set("base", "base_link", coframe.Transform(), static=True)
    with pytest.raises(coframe.LookupException) as caught:
        buffer.lookup("base_link", "base_lonk")
    assert "Did you mean 'base_link'" not in caught.value.hint
    with pytest.raises(coframe.LookupException) as caught:
        buffer.lookup("lidar", "base_lonk")
    assert "Did you mean 'base_link'?" in caught.value.hint


def test_hint_for_an_unknown_frame_suggests_and_lists_names(buffer):
    with pytest.raises(coframe.LookupException) as caught:
        buffer.lookup("odom", "lidr")
    assert "Did you mean 'lidar'?" in caught.value.hint
    assert "base, lidar, map2, odom, other" in caught.value.hint
    with pytest.raises(coframe.LookupException) as caught:
        buffer.lookup("odm", "lidr")
    assert "lookup_transform('odom', 'lidar', ...)" in caught.value.hint


def test_loop_is_reported_not_followed():
    buffer = coframe.Buffer()
    buffer.set("a", "b", coframe.Transform(), static=True)
    buffer.set("b", "c", coframe.Transform(), static=True)
    buffer.set("c", "a", coframe.Transform(), static=True)
    buffer.set("x", "y", coframe.Transform(), static=True)
    with pytest.raises(coframe.LookupException, match="The tf tree is invalid because it contains a loop"):
        buffer.lookup("x", "a")


def test_chains_of_a_thousand_edges_work_and_longer_ones_are_loops():
    buffer = coframe.Buffer()
    for i in range(1001):
        buffer.set(f"f{i}", f"f{i + 1}", coframe.Transform([1, 0, 0]), static=True)
    assert buffer.lookup("f0", "f1000").translation[0] == 1000
    with pytest.raises(coframe.LookupException, match="contains a loop"):
        buffer.lookup("f0", "f1001")


@pytest.mark.parametrize(
    ("parent", "child", "values", "text"),
    [
        (
            "a",
            "a",
            (0, 0, 0, 0, 0, 0, 1),
            'TF_SELF_TRANSFORM: Ignoring transform from authority "me" with frame_id and ',
        ),
        ("a", "", (0, 0, 0, 0, 0, 0, 1), 'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "me" because'),
        ("", "b", (0, 0, 0, 0, 0, 0, 1), 'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "b"  from authority'),
        ("a", "b", (float("nan"), 0, 0, 0, 0, 0, 1), 'TF_NAN_INPUT: Ignoring transform for child_frame_id "b" from'),
        ("a", "b", (0, 0, 0, 0, 0, 0, 0), 'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "b"'),
    ],
)
def test_refused_transforms_change_nothing_and_give_the_text_of_tf2(parent, child, values, text):
    buffer = coframe.Buffer()
    refusals = buffer._set_values(parent, child, SECOND, *map(float, values), False, "me")
    lines = coframe._core.insert_texts(refusals, parent, child, SECOND, *map(float, values), "me")
    assert any(level == "error" and line.startswith(text) for level, line in lines)
    assert buffer.frame_names() == []
    assert buffer.statistics["refused"] == 1


def test_set_raises_what_tf2_logs():
    with pytest.raises(coframe.InvalidArgumentException, match="TF_SELF_TRANSFORM"):
        coframe.Buffer().set("a", "a", coframe.Transform(), static=True)


def test_unnormalized_quaternion_is_normalized_and_made_canonical():
    buffer = coframe.Buffer()
    assert buffer._set_values("a", "b", SECOND, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -2.0, False, "me") == 0
    assert buffer.lookup("a", "b").values[3:] == (0.0, 0.0, 0.0, 1.0)


def test_old_data_is_refused_and_counted():
    buffer = coframe.Buffer("10s")
    assert buffer.set("a", "b", coframe.Transform(), 100 * SECOND)
    assert buffer.set("a", "b", coframe.Transform(), 90 * SECOND)  # just inside
    assert not buffer.set("a", "b", coframe.Transform(), 90 * SECOND - 1)
    assert buffer.statistics["old"] == 1


def test_prunes_before_inserting_like_tf2():
    buffer = coframe.Buffer("10s")
    for second in range(1, 26):
        buffer.set("a", "b", coframe.Transform(), second * SECOND)
    (frame,) = [frame for frame in buffer.frames() if frame.name == "b"]
    assert (frame.oldest, frame.newest) == (14 * SECOND, 25 * SECOND)  # 24 - 10: one step older than the window


def test_long_histories_are_searched_exactly():
    buffer = coframe.Buffer(None)
    rng = np.random.default_rng(0)
    stamps = np.sort(rng.choice(10**9, 5000, replace=False)).astype(np.int64) + 1
    for stamp in rng.permutation(stamps).tolist():
        buffer._set_values("a", "b", stamp, float(stamp), 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, False, "me")
    asked = rng.integers(stamps[0], stamps[-1], 2000)
    answers = [buffer.lookup("a", "b", stamp).values[0] for stamp in asked.tolist()]
    np.testing.assert_allclose(answers, asked, rtol=0, atol=1e-5)


def test_equal_stamps_keep_both_samples_and_repetitions_are_accepted():
    buffer = coframe.Buffer()
    for x in (1, 2, 2, 1):
        buffer.set("a", "b", coframe.Transform([x, 0, 0]), SECOND)
    assert [frame.samples for frame in buffer.frames() if frame.name == "b"] == [2]
    assert buffer.lookup("a", "b").translation[0] == 2  # the last inserted is the newest


def test_a_new_parent_is_valid_from_its_first_sample():
    buffer = coframe.Buffer()
    buffer.set("left", "cup", coframe.Transform([1, 0, 0]), 1 * SECOND)
    buffer.set("right", "cup", coframe.Transform([2, 0, 0]), 3 * SECOND)
    assert buffer.lookup("left", "cup", 2 * SECOND).translation[0] == 1  # held, not interpolated
    assert buffer.lookup("right", "cup").translation[0] == 2
    with pytest.raises(coframe.ConnectivityException):
        buffer.lookup("left", "cup")


def test_static_and_dynamic_replace_each_other():
    buffer = coframe.Buffer()
    buffer.set("a", "b", coframe.Transform([1, 0, 0]), SECOND)
    buffer.set("a", "b", coframe.Transform([2, 0, 0]), static=True)
    assert buffer.lookup("a", "b", 77 * SECOND).translation[0] == 2
    buffer.set("a", "b", coframe.Transform([3, 0, 0]), SECOND)
    assert not buffer.can_transform("a", "b", 77 * SECOND)


def test_clear_keeps_statics_and_names(buffer):
    buffer.clear()
    assert buffer.can_transform("base", "lidar")
    assert "odom" in buffer
    assert buffer._why_not("odom", "base", 11 * SECOND) == (
        ", when looking up transform from frame [base] to frame [odom]"
    )


def test_can_transform_agrees_with_lookup_after_random_changes():
    generator = random.Random(3)
    for _ in range(30):
        buffer = coframe.Buffer(cache=20 * SECOND)
        for _ in range(60):
            change(buffer, generator)
            for asked in (buffer, buffer.snapshot()):
                for stamp in (0, 1, *(generator.randrange(90) * SECOND for _ in range(6))):
                    assert asked.can_transform("a", "c", stamp) == answers(asked, stamp)


def change(buffer, generator):
    """Return a random change of the chain a <- b <- c; some changes are rare."""
    child = generator.choice("bc")
    parent = "a" if child == "b" else generator.choice("bbbbba")
    stamp = generator.randrange(90) * SECOND
    match generator.randrange(20):
        case 0:
            buffer.set(parent, child, coframe.Transform(), static=True)
        case 1:
            buffer.clear()
        case 2 if child in buffer:
            buffer.remove_frame(child)
        case 3 | 4:
            stamps = np.arange(stamp, stamp + 5 * SECOND, SECOND)
            buffer.set_many(parent, child, stamps, np.tile([0.0, 0, 0, 0, 0, 0, 1], (5, 1)))
        case _:
            buffer.set(parent, child, coframe.Transform([stamp, 0, 0]), stamp)


def answers(buffer, stamp):
    try:
        buffer.lookup("a", "c", stamp)
    except coframe.TransformException:
        return False
    return True


def test_time_travel(buffer):
    transform = buffer._lookup_full("base", 12 * SECOND, "base", 10 * SECOND, "odom")
    assert transform.translation == pytest.approx([-2, 0, 0])
    assert transform.stamp == 12 * SECOND


def test_can_transform_has_its_own_error_texts(buffer):
    assert buffer._why_not("odom", "lidar") == ""
    assert buffer._why_not("nobody", "lidar") == (
        'Invalid frame ID "nobody" passed to canTransform argument target_frame - frame does not exist'
    )


def test_a_frame_relative_to_itself_is_the_identity(buffer):
    assert buffer.lookup("nobody", "nobody", 5).values == (0, 0, 0, 0, 0, 0, 1)


def test_timeout_waits_for_another_thread_and_no_longer(buffer):
    thread = threading.Timer(0.05, lambda: buffer.set("odom", "base", coframe.Transform([9, 0, 0]), 13 * SECOND))
    thread.start()
    start = time.monotonic()
    assert buffer.lookup("odom", "base", 13 * SECOND, timeout="20s").translation[0] == 9
    assert time.monotonic() - start < 10
    thread.join()


def test_wait_times_out_with_the_reason(buffer):
    with pytest.raises(
        coframe.TimeoutException, match=r"timed out after 20 ms waiting for .* does not exist"
    ) as caught:
        buffer.wait("odom", "nobody", timeout="20ms")
    assert isinstance(caught.value.__cause__, coframe.LookupException)


def test_stamps_in_float_seconds_are_refused(buffer):
    with pytest.raises(TypeError, match="float of seconds"):
        buffer.lookup("odom", "base", 10.5)


def test_frame_names_must_be_strings(buffer):
    for wrong in (7, None):
        with pytest.raises(TypeError, match=f"a frame name must be str, not {type(wrong).__name__}"):
            buffer.lookup("odom", wrong)
        with pytest.raises(TypeError, match=f"a frame name must be str, not {type(wrong).__name__}"):
            buffer.can_transform(wrong, "odom")


def test_stamps_beyond_64_bits_are_refused(buffer):
    with pytest.raises(OverflowError, match="does not fit into 64-bit nanoseconds"):
        buffer.lookup("odom", "base", 2**70)


def test_set_checks_the_frames_of_the_transform():
    transform = coframe.Transform(target="a", source="b", stamp=1)
    buffer = coframe.Buffer()
    assert buffer.set("a", "b", transform)
    with pytest.raises(coframe.InvalidArgumentException, match="cannot store the transform a <- b as b <- a"):
        buffer.set("b", "a", transform)


def test_a_dynamic_transform_needs_a_stamp():
    with pytest.raises(coframe.InvalidArgumentException, match="has no stamp"):
        coframe.Buffer().set("a", "b", coframe.Transform())


def test_concurrent_readers_and_a_writer():
    """The seven numbers of a sample stay consistent while threads read and write."""
    buffer = coframe.Buffer(None)
    buffer._set_values("a", "b", 1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, False, "me")
    stop = threading.Event()
    wrong = []

    def read():
        while not stop.is_set():
            x, y, z, *_ = buffer.lookup("a", "b").values
            if not x == y == z:
                wrong.append((x, y, z))

    threads = [threading.Thread(target=read) for _ in range(3)]
    for thread in threads:
        thread.start()
    for i in range(2, 20_000):
        buffer._set_values("a", "b", i, float(i), float(i), float(i), 0.0, 0.0, 0.0, 1.0, False, "me")
    stop.set()
    for thread in threads:
        thread.join()
    assert wrong == []


def test_yaml_is_valid_for_every_name():
    buffer = coframe.Buffer()
    buffer.set("a: b", 'it"s \\ x', coframe.Transform(), static=True, authority="au'th")
    assert "\"it\\\"s \\\\ x\": \n  parent: 'a: b'\n  broadcaster: 'au''th'\n" in buffer.all_frames_as_yaml()


def test_text_dumps():
    buffer = coframe.Buffer()
    assert buffer.all_frames_as_yaml() == "[]"
    assert buffer.all_frames_as_dot() == 'digraph G {\n"no tf data recieved"}'
    buffer.set("a", "b", coframe.Transform(), 10 * SECOND, authority="auth")
    assert buffer.all_frames_as_string() == "Frame b exists with parent a.\n"
    assert buffer.all_frames_as_yaml() == (
        "b: \n  parent: 'a'\n  broadcaster: 'auth'\n  rate: 10000.000\n  most_recent_transform: 10.000000\n"
        "  oldest_transform: 10.000000\n  buffer_length: 0.000\n"
    )
    assert '"a" -> "b"[label="Broadcaster: auth\\nAverage rate: 10000.000 Hz\\n' in buffer.all_frames_as_dot()


@pytest.mark.parametrize("value", [([0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]), np.eye(4), None])
def test_set_names_the_types_that_it_accepts(value):
    with pytest.raises(TypeError, match=r"takes a coframe.Transform, not .*Transform.from_matrix"):
        coframe.Buffer().set("a", "b", value, stamp=1)


def test_hint_for_stamps_in_seconds():
    buffer = coframe.Buffer()
    for stamp in (1_000_000_000, 3_000_000_000):
        buffer.set("a", "b", coframe.Transform(), stamp=stamp)
    with pytest.raises(coframe.ExtrapolationException) as caught:
        buffer.lookup("a", "b", 2)
    assert caught.value.hint == "Stamps are in nanoseconds: 2 s is 2_000_000_000."
    assert repr(caught.value).startswith("ExtrapolationException('Lookup would require extrapolation into the past.")
    with pytest.raises(coframe.ExtrapolationException) as caught:
        buffer.lookup("a", "b", 500_000_000)
    assert "no longer has a sample" in caught.value.hint


def filled(cache, start):
    buffer = coframe.Buffer(cache)
    for second in range(5):
        buffer.set("odom", "base", coframe.Transform([second, 0, 0]), start + second * 1_000_000_000)
    return buffer


def hint_at(buffer, stamp):
    with pytest.raises(coframe.ExtrapolationException) as caught:
        buffer.lookup("odom", "base", stamp)
    return caught.value.hint, caught.value.doctor_code


@pytest.mark.parametrize(("unit", "size"), [("s", 10**9), ("ms", 10**6), ("us", 10**3)])
@pytest.mark.parametrize("start", [100 * 10**9, 1_700_000_000 * 10**9])
def test_stamps_in_another_unit_are_recognized(unit, size, start):
    stamp = (start + 2 * 10**9) // size
    found, code = hint_at(filled(None, start), stamp)
    assert found == f"Stamps are in nanoseconds: {stamp} {unit} is {start + 2 * 10**9:_}."
    assert code == ""


@pytest.mark.parametrize(
    ("start", "stamp", "where"),
    [
        (100 * 10**9, 1_700_000_000 * 10**9, "19676 days after"),
        (1_700_000_000 * 10**9, 100 * 10**9, "19676 days before"),
        (1_700_000_000 * 10**9, 1_600_000_000 * 10**9, "1157 days before"),
    ],
)
@pytest.mark.parametrize("cache", ["10s", None])
def test_stamps_on_another_clock_are_recognized(cache, start, stamp, where):
    found, code = hint_at(filled(cache, start), stamp)
    assert found.startswith(f"The requested time is {where} the samples of odom -> base")
    assert "another clock" in found
    assert code == "TF009"


@pytest.mark.parametrize(
    "buffer", [lambda: filled(None, 100 * 10**9), lambda: filled("10s", 100 * 10**9).snapshot()], ids=["all", "frozen"]
)
@pytest.mark.parametrize("stamp", [99 * 10**9, 105 * 10**9])
def test_hints_for_recordings_and_frozen_buffers_do_not_mention_caches_or_waiting(buffer, stamp):
    found, code = hint_at(buffer(), stamp)
    assert "odom -> base has samples only from 100.000000000 to 104.000000000" in found
    assert "cache" not in found
    assert "ait" not in found
    assert code == "TF013"


def test_edges_without_a_common_time_are_named_with_their_intervals():
    buffer = filled(None, 100 * 10**9)
    buffer.set("base", "lidar", coframe.Transform(), 10**9)
    buffer.set("base", "lidar", coframe.Transform(), 3 * 10**9)
    for call in (buffer.span, buffer.trajectory):
        with pytest.raises(coframe.ExtrapolationException) as caught:
            call("odom", "lidar")
        assert str(caught.value) == (
            "The edges between 'odom' and 'lidar' have no common time: odom -> base from 100.000000000 to "
            "104.000000000, base -> lidar from 1.000000000 to 3.000000000"
        )
        assert "no common time" in caught.value.hint
        assert caught.value.doctor_code == "TF013"


@pytest.mark.parametrize("wrong", [{"timeout": 0.5}, {"timeout": "soon"}, {"extrapolate": 0.1}, {"timeout": [1]}])
def test_invalid_arguments_are_refused_even_if_they_are_not_used(buffer, wrong):
    with pytest.raises((TypeError, ValueError), match=r"is not a duration|a duration must be"):
        buffer.lookup("odom", "base", **wrong)
    if "timeout" in wrong:
        with pytest.raises((TypeError, ValueError), match=r"is not a duration|a duration must be"):
            buffer.can_transform("odom", "base", **wrong)


def test_hold_accepts_any_true_value(buffer):
    latest = buffer.lookup("odom", "base").stamp
    assert buffer.lookup("odom", "base", latest + 5, extrapolate="10ns", hold=1).extrapolated == 5


def test_the_error_names_the_first_of_several_nan_values():
    class Number:
        def __float__(self):
            return 1.0

    with pytest.raises(TypeError, match="must be real number, not str"):
        coframe.Buffer()._set_values("a", "b", 1, "x", Number(), None, 0.0, 0.0, 0.0, 1.0, False, "me")
