# SPDX-License-Identifier: Apache-2.0
"""Features of the buffer beyond tf2: bounded extrapolation, batches of lookups, statistics, snapshots."""

import asyncio
import threading
import time

import numpy as np
import pytest
from scipy.linalg import expm, logm
from scipy.spatial.transform import Rotation

import coframe

SECOND = 1_000_000_000


def turned(yaw, translation=(0, 0, 0)):
    return coframe.Transform.from_rpy(translation, [0, 0, yaw])


@pytest.fixture
def buffer():
    """odom -> base at 10 s and 11 s; base -> lidar is fixed."""
    buffer = coframe.Buffer()
    buffer.set("odom", "base", turned(0.0), 10 * SECOND)
    buffer.set("odom", "base", turned(0.2, [1, 0, 0]), 11 * SECOND, authority="odometry")
    buffer.set("base", "lidar", coframe.Transform([0, 0, 0.5]), static=True)
    return buffer


class TestExtrapolation:
    def test_there_is_none_by_default(self, buffer):
        with pytest.raises(coframe.ExtrapolationException, match="into the future"):
            buffer.lookup("odom", "lidar", 11 * SECOND + 1)

    def test_the_limit_applies_before_and_after_the_data(self, buffer):
        for inside, outside in ((11_050_000_000, 11_050_000_001), (9_950_000_000, 9_949_999_999)):
            assert buffer.lookup("odom", "lidar", inside, extrapolate="50ms").extrapolated == 50_000_000
            with pytest.raises(coframe.ExtrapolationException):
                buffer.lookup("odom", "lidar", outside, extrapolate="50ms")

    def test_the_result_contains_the_extrapolated_time(self, buffer):
        found = buffer.lookup("odom", "lidar", 11 * SECOND + 7, extrapolate="1s")
        assert (found.stamp, found.extrapolated) == (11 * SECOND + 7, 7)
        assert buffer.lookup("odom", "lidar", 11 * SECOND, extrapolate="1s").extrapolated == 0

    @pytest.mark.parametrize("seed", range(20))
    def test_the_twist_is_continued(self, seed):
        rng = np.random.default_rng(seed)
        first, second = (
            coframe.Transform(rng.normal(size=3), Rotation.from_rotvec(rng.normal(size=3)).as_quat()) for _ in range(2)
        )
        buffer = coframe.Buffer()
        buffer.set("odom", "base", first, 10 * SECOND)
        buffer.set("odom", "base", second, 10 * SECOND + 40_000_000)
        motion = np.real(logm(np.linalg.inv(first.matrix) @ second.matrix))
        for stamp, start, share in (
            (10_050_000_000, second, 0.25),  # 10 ms of 40
            (9_970_000_000, first, -0.75),
        ):
            found = buffer.lookup("odom", "base", stamp, extrapolate="100ms")
            np.testing.assert_allclose(found.matrix, start.matrix @ expm(share * motion), atol=1e-9)

    def test_a_straight_motion_stays_straight(self):
        buffer = coframe.Buffer()
        buffer.set("odom", "base", coframe.Transform([0, 0, 0]), 10 * SECOND)
        buffer.set("odom", "base", coframe.Transform([1, 2, 3]), 11 * SECOND)
        found = buffer.lookup("odom", "base", 11_500_000_000, extrapolate="1s")
        assert found.translation.tolist() == [1.5, 3.0, 4.5]

    def test_hold_keeps_the_last_pose(self, buffer):
        found = buffer.lookup("odom", "base", 11_500_000_000, extrapolate="1s", hold=True)
        assert found.is_close(buffer.lookup("odom", "base", 11 * SECOND))
        assert found.extrapolated == SECOND // 2

    def test_a_single_sample_can_only_be_held(self):
        buffer = coframe.Buffer()
        buffer.set("odom", "base", coframe.Transform([1, 2, 3]), 10 * SECOND)
        assert buffer.lookup("odom", "base", 10 * SECOND + 5, extrapolate="5ns").translation.tolist() == [1, 2, 3]

    def test_a_new_parent_resets_the_motion(self, buffer):
        buffer.set("map", "base", coframe.Transform([5, 0, 0]), 12 * SECOND)
        buffer.set("map", "other", coframe.Transform(), static=True)
        assert buffer.lookup("map", "base", 12_500_000_000, extrapolate="1s").translation.tolist() == [5, 0, 0]

    def test_the_timeout_comes_before_extrapolation(self, buffer):
        thread = threading.Timer(0.05, lambda: buffer.set("odom", "base", coframe.Transform([9, 0, 0]), 12 * SECOND))
        thread.start()
        found = buffer.lookup("odom", "base", 12 * SECOND, timeout="20s", extrapolate="5s")
        thread.join()
        assert (found.translation[0], found.extrapolated) == (9, 0)

    def test_a_negative_limit_is_refused(self, buffer):
        with pytest.raises(ValueError, match="negative"):
            buffer.lookup("odom", "base", 12 * SECOND, extrapolate=-1)


class TestLookupMany:
    def test_rows_equal_single_lookups(self, buffer):
        stamps = np.linspace(10, 11, 101) * SECOND
        stamps = np.random.default_rng(1).permutation(stamps.astype(np.int64))
        many = buffer.lookup_many("odom", "lidar", stamps)
        assert many.shape == (101,)
        assert (many.target, many.source) == ("odom", "lidar")
        np.testing.assert_array_equal(many.stamps, stamps)
        for one, stamp in zip(many, stamps, strict=True):
            assert one.is_close(buffer.lookup("odom", "lidar", int(stamp)), translation=1e-12, rotation=1e-12)

    def test_datetime64_and_latest(self, buffer):
        times = np.array([10_500_000_000], dtype="datetime64[ns]")
        assert buffer.lookup_many("odom", "base", times).translation[0, 0] == pytest.approx(0.5)
        assert buffer.lookup_many("odom", "base", [0]).stamps.tolist() == [11 * SECOND]

    def test_raises_the_error_of_the_first_row_without_a_transform(self, buffer):
        with pytest.raises(coframe.ExtrapolationException, match=r"Requested time 9.000000"):
            buffer.lookup_many("odom", "base", [10 * SECOND, 9 * SECOND, 20 * SECOND])

    def test_rows_without_a_transform_are_nan(self, buffer):
        many = buffer.lookup_many("odom", "base", [10 * SECOND, 9 * SECOND, 11 * SECOND], on_error="nan")
        assert np.isnan(many.translation[:, 0]).tolist() == [False, True, False]
        assert np.isnan((many.inverse() @ many).quaternion[:, 3]).tolist() == [False, True, False]

    def test_no_row_with_a_transform_is_an_error(self, buffer):
        with pytest.raises(coframe.LookupException, match="nobody"):
            buffer.lookup_many("odom", "nobody", [10 * SECOND], on_error="nan")

    def test_extrapolated_rows_contain_the_extrapolated_time(self, buffer):
        many = buffer.lookup_many("odom", "base", [10 * SECOND, 11 * SECOND + 3], extrapolate="1s")
        assert many.extrapolated.tolist() == [0, 3]

    def test_no_stamps_give_no_rows(self, buffer):
        assert buffer.lookup_many("odom", "base", np.zeros(0, dtype=np.int64)).shape == (0,)

    def test_float_seconds_are_refused(self, buffer):
        with pytest.raises(TypeError, match="int64 nanoseconds"):
            buffer.lookup_many("odom", "base", [10.5])


class TestRemoveFrame:
    def test_frames_and_their_edges_are_removed(self, buffer):
        assert buffer.remove_frame("base")
        assert buffer.frame_names() == ["odom", "lidar"]
        with pytest.raises(coframe.LookupException, match=r'"base" passed to .* does not exist'):
            buffer.lookup("odom", "base")
        with pytest.raises(coframe.ConnectivityException):
            buffer.lookup("odom", "lidar")
        assert "base" not in buffer.all_frames_as_yaml()

    def test_a_removed_frame_can_be_inserted_again(self, buffer):
        buffer.remove_frame("base")
        buffer.set("map", "base", coframe.Transform([1, 1, 1]), 20 * SECOND)
        assert buffer.lookup("map", "base").translation.tolist() == [1, 1, 1]

    def test_unknown_frames_are_not_an_error(self, buffer):
        assert not buffer.remove_frame("nobody")


class TestEdges:
    def test_rates_gaps_and_jitter(self):
        buffer = coframe.Buffer()
        stamps = np.cumsum([SECOND, 100_000_000, 100_000_000, 400_000_000, 100_000_000])
        for stamp in stamps.tolist():
            buffer.set("odom", "base", coframe.Transform(), stamp, authority="odometry")
        (edge,) = buffer.edges(now=2 * SECOND)
        intervals = np.diff(stamps)
        assert (edge.parent, edge.child, edge.authority, edge.samples) == ("odom", "base", "odometry", 5)
        assert edge.rate == pytest.approx(1e9 / intervals.mean())
        assert edge.jitter == pytest.approx(intervals.std())
        assert edge.longest_gap == 400_000_000
        assert edge.age == 2 * SECOND - stamps[-1]

    def test_static_edges_have_no_age(self, buffer):
        (edge,) = buffer.edges(["lidar"])
        assert edge.static
        assert edge.age is None
        assert edge.rate == 0.0

    def test_rejected_samples_by_reason(self, buffer):
        buffer._set_values("odom", "base", 12 * SECOND, *(0.0,) * 7, False, "x")  # a quaternion of zeros
        buffer._set_values("odom", "base", 12 * SECOND, float("nan"), *(0.0,) * 5, 1.0, False, "x")
        buffer.set("odom", "base", coframe.Transform(), 100 * SECOND)
        buffer.set("odom", "base", coframe.Transform(), SECOND)
        buffer.set("odom", "base", coframe.Transform(), 95 * SECOND)
        buffer.set("odom", "base", coframe.Transform(), 95 * SECOND)
        (edge,) = buffer.edges(["base"])
        assert edge.rejected == {"older than the cache": 1, "not a number": 2, "invalid quaternion": 1}
        assert (edge.stored, edge.late, edge.repeated) == (4, 1, 1)


class TestSnapshot:
    def test_it_does_not_change(self, buffer):
        frozen = buffer.snapshot()
        before = frozen.all_frames_as_yaml()
        buffer.set("odom", "base", coframe.Transform([7, 0, 0]), 10_500_000_000)
        for k in range(1000):
            buffer.set("odom", "base", coframe.Transform([k, 0, 0]), (12 + k) * SECOND)
        buffer.set("base", "lidar", coframe.Transform([9, 9, 9]), static=True)
        buffer.set("lidar", "beam", coframe.Transform(), static=True)
        buffer.clear()
        assert frozen.all_frames_as_yaml() == before
        assert frozen.lookup("odom", "lidar", 10_500_000_000).translation.tolist() == [0.5, 0, 0.5]
        assert frozen.frame_names() == ["base", "odom", "lidar"]

    def test_random_changes_do_not_affect_it(self):
        rng = np.random.default_rng(3)
        buffer = coframe.Buffer("100s")
        snapshots = []
        for step in range(3000):
            stamp = SECOND * 10 + step * 100_000_000 - int(rng.integers(0, 20)) * 100_000_000
            buffer.set("odom", f"frame{step % 3}", coframe.Transform(rng.normal(size=3)), max(stamp, 1))
            if step % 500 == 250:
                stamps = [max(stamp - 10**9 * k, 1) for k in range(20)]
                questions = [(f"frame{k % 3}", s) for k, s in enumerate(stamps)]
                copy = buffer.snapshot()
                snapshots.append(
                    (
                        copy,
                        questions,
                        [copy._why_not("odom", f, s) or copy.lookup("odom", f, s).values for f, s in questions],
                    )
                )
        for copy, questions, answers in snapshots:
            assert [copy._why_not("odom", f, s) or copy.lookup("odom", f, s).values for f, s in questions] == answers

    def test_it_is_read_only(self, buffer):
        with pytest.raises(coframe.InvalidArgumentException, match="frozen"):
            buffer.snapshot().set("odom", "base", coframe.Transform(), 12 * SECOND)

    def test_it_outlives_the_buffer(self, buffer):
        frozen = buffer.snapshot()
        del buffer
        assert frozen.lookup("odom", "lidar").stamp == 11 * SECOND

    def test_a_frozen_buffer_keeps_everything(self, buffer):
        buffer.freeze()
        buffer.clear()
        assert not buffer.remove_frame("base")
        message = buffer.encode(static=False)
        assert buffer.ingest(message) == 0
        assert buffer.statistics["refused"] == 1
        assert buffer.lookup("odom", "base").stamp == 11 * SECOND


class TestChanges:
    def test_the_changed_edge_is_reported(self, buffer):
        reported, got = [], threading.Event()

        def on_change(edge):
            reported.append((edge.parent, edge.child, edge.newest))
            got.set()

        with buffer.on_change(on_change, child="base"):
            buffer.set("base", "lidar", coframe.Transform([1, 0, 0]), static=True)
            buffer.set("odom", "base", coframe.Transform(), 12 * SECOND)
            assert got.wait(10)
        buffer.set("odom", "base", coframe.Transform(), 13 * SECOND)
        assert reported == [("odom", "base", 12 * SECOND)]

    def test_all_edges_and_future_edges_are_reported(self, buffer):
        reported, done = set(), threading.Event()

        def on_change(edge):
            reported.add(edge.child)
            if reported == {"base", "new"}:
                done.set()

        buffer.on_change(on_change)
        fresh = threading.Event()
        buffer.on_change(lambda _: fresh.set(), child="new")
        buffer.set("odom", "base", coframe.Transform(), 12 * SECOND)
        buffer.set("base", "new", coframe.Transform(), 12 * SECOND)
        assert done.wait(10)
        assert fresh.wait(10)

    def test_callbacks_can_use_the_buffer_and_raise(self, buffer, caplog):
        done = threading.Event()

        def on_change(edge):
            buffer.set("odom", "seen", coframe.Transform(), edge.newest)
            buffer.lookup("odom", "seen", timeout="1s")
            if edge.newest == 13 * SECOND:
                done.set()
            raise RuntimeError("of the user")

        buffer.on_change(on_change, child="base")
        buffer.set("odom", "base", coframe.Transform(), 12 * SECOND)
        deadline = time.monotonic() + 10
        while "of the user" not in caplog.text and time.monotonic() < deadline:
            time.sleep(0.001)
        buffer.set("odom", "base", coframe.Transform(), 13 * SECOND)
        assert done.wait(10)


class TestAsyncio:
    def test_many_tasks_wait_concurrently(self):
        buffer = coframe.Buffer()

        async def main():
            waits = [asyncio.ensure_future(buffer.wait_async("odom", f"frame{k}", SECOND)) for k in range(300)]
            await asyncio.sleep(0)
            thread = threading.Thread(
                target=lambda: [
                    buffer.set("odom", f"frame{k}", coframe.Transform([k, 0, 0]), SECOND) for k in range(300)
                ]
            )
            thread.start()
            found = await asyncio.wait_for(asyncio.gather(*waits), 20)
            thread.join()
            assert [t.translation[0] for t in found] == list(range(300))

        asyncio.run(main())

    def test_a_timeout_names_the_missing_data(self, buffer):
        with pytest.raises(coframe.TimeoutException, match=r"timed out after 20 ms waiting for .* into the future"):
            asyncio.run(buffer.wait_async("odom", "base", 20 * SECOND, timeout="20ms"))

    def test_a_cancelled_task_stops_waiting(self, buffer):
        async def main():
            task = asyncio.ensure_future(buffer.wait_async("odom", "base", 20 * SECOND))
            await asyncio.sleep(0)
            assert not buffer._dispatcher.is_idle
            task.cancel()
            with pytest.raises(asyncio.CancelledError):
                await task
            assert buffer._dispatcher.is_idle

        asyncio.run(main())
