# SPDX-License-Identifier: Apache-2.0
"""Loggers: console format, levels and filters."""

import io
import re
from pathlib import Path

import pytest

import rclpy.logging
from rclpy.clock import ROSClock
from rclpy.impl.console import console
from rclpy.logging import LoggingSeverity, get_logger
from rclpy.time import Time


@pytest.fixture(autouse=True)
def fresh_levels():
    yield
    rclpy.logging.clear_config()


def test_default_format(capfd):
    get_logger("arm").info("moving")
    assert re.fullmatch(r"\[INFO\] \[\d{10}\.\d{9}\] \[arm\]: moving\n", capfd.readouterr().err)


@pytest.mark.parametrize(
    ("method", "word"),
    [("info", "INFO"), ("warn", "WARN"), ("warning", "WARN"), ("error", "ERROR"), ("fatal", "FATAL")],
)
def test_severities(capfd, method, word):
    assert getattr(get_logger(f"arm.{method}"), method)("text")
    assert capfd.readouterr().err.startswith(f"[{word}] ")


def test_levels_are_inherited_along_dots(capfd):
    parent, child = get_logger("arm"), get_logger("arm").get_child("hand")
    assert child.name == "arm.hand"
    assert not parent.debug("hidden")
    parent.set_level(LoggingSeverity.DEBUG)
    assert child.debug("shown")
    child.set_level(LoggingSeverity.ERROR)
    assert not child.is_enabled_for(LoggingSeverity.WARN)
    child.set_level(LoggingSeverity.UNSET)
    assert child.get_effective_level() is LoggingSeverity.DEBUG
    assert "hidden" not in capfd.readouterr().err


def test_empty_names_are_rejected():
    with pytest.raises(ValueError, match="Logger name must not be empty"):
        get_logger("")
    with pytest.raises(ValueError, match="Child logger name must not be empty"):
        get_logger("arm").get_child("")


def test_once_and_skip_first():
    logger = get_logger("arm")
    assert [logger.info("x", once=True) for _ in range(3)] == [True, False, False]
    assert [logger.info("x", skip_first=True) for _ in range(3)] == [False, True, True]


def test_throttle_follows_the_given_clock():
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    logged = []
    for seconds in (1, 2, 5, 6, 10):
        clock.set_ros_time_override(Time(seconds=seconds, clock_type=clock.clock_type))
        if get_logger("arm").info("x", throttle_duration_sec=4, throttle_time_source_type=clock):
            logged.append(seconds)
    assert logged == [1, 5, 10]


def test_filters_are_separate_per_logger():
    first, second = get_logger("one"), get_logger("two")
    assert [logger.info("x", once=True) for logger in (first, second, first)] == [True, True, False]
    assert get_logger("one") is first
    assert first.get_child("child") is first.get_child("child")


def test_filters_are_separate_per_call_site():
    logger = get_logger("arm")
    assert logger.info("x", once=True)
    assert logger.info("x", once=True)


def test_invalid_options_are_reported():
    logger = get_logger("arm")
    with pytest.raises(TypeError, match='"twice" is not one of the recognized logging options'):
        logger.info("x", twice=True)
    with pytest.raises(TypeError, match='required parameter "throttle_duration_sec" not specified'):
        logger.info("x", throttle_time_source_type=ROSClock())


def test_call_site_must_not_change_its_severity():
    def log(severity):
        get_logger("arm").log("x", severity, once=True)

    log(LoggingSeverity.INFO)
    with pytest.raises(ValueError, match="Logger severity cannot be changed between calls"):
        log(LoggingSeverity.ERROR)


def test_custom_format(capfd, monkeypatch):
    monkeypatch.setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "{severity}|{name}|{message}|{function_name}|{other}")
    get_logger("arm").info("{name}")
    assert capfd.readouterr().err == "INFO|arm|{name}|test_custom_format|{other}\n"


def test_colors(capfd, monkeypatch):
    get_logger("arm").error("plain")
    assert "\033" not in capfd.readouterr().err
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "1")
    get_logger("arm").error("red")
    assert capfd.readouterr().err.startswith("\033[31m[ERROR]")
    monkeypatch.setenv("RCUTILS_COLORIZED_OUTPUT", "0")
    terminal = io.StringIO()
    terminal.isatty = lambda: True
    monkeypatch.setattr("sys.stderr", terminal)
    get_logger("arm").error("plain")
    assert "\033" not in terminal.getvalue()


def test_stdout_on_request(capfd, monkeypatch):
    monkeypatch.setenv("RCUTILS_LOGGING_USE_STDOUT", "1")
    get_logger("arm").info("moving")
    assert "moving" in capfd.readouterr().out


def test_sinks_receive_the_records_of_child_loggers():
    records = []
    console.sinks["arm"] = records.append
    try:
        get_logger("arm.hand").info("closing")
        get_logger("armada").info("sailing")
    finally:
        del console.sinks["arm"]
    assert [record.message for record in records] == ["closing"]


def test_severity_from_text():
    assert rclpy.logging.get_logging_severity_from_string("warn") is LoggingSeverity.WARN
    with pytest.raises(RuntimeError, match="Failed to get severity name") as caught:
        rclpy.logging.get_logging_severity_from_string("loud")
    assert caught.value.hint == "'loud' is not one of UNSET, DEBUG, INFO, WARN, ERROR, FATAL."


def test_misuse_is_refused_as_in_ros():
    logger = get_logger("arm.misused")
    with pytest.raises(TypeError, match="must be a string, got 5"):
        logger.info(5)

    def log(severity: LoggingSeverity) -> None:
        logger.log("one line", severity)

    log(LoggingSeverity.INFO)
    with pytest.raises(ValueError, match="severity cannot be changed"):
        log(LoggingSeverity.WARN)


def test_logging_directory(monkeypatch):
    for name in ("ROS_LOG_DIR", "ROS_HOME"):
        monkeypatch.delenv(name, raising=False)
    assert rclpy.logging.get_logging_directory() == Path("~/.ros/log").expanduser()
    monkeypatch.setenv("ROS_HOME", "/home/ros")
    assert rclpy.logging.get_logging_directory() == Path("/home/ros/log")
    monkeypatch.setenv("ROS_LOG_DIR", "/logs")
    assert rclpy.logging.get_logging_directory() == Path("/logs")


def test_the_throttle_comes_before_the_other_filters():
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    logged = []
    for second in range(0, 10, 2):
        clock.set_ros_time_override(Time(seconds=second, clock_type=clock.clock_type))
        options = {"throttle_duration_sec": 3, "throttle_time_source_type": clock, "skip_first": True}
        logged.append(get_logger("arm").info("x", **options))
    assert logged == [False, False, True, False, True], "the call that is skipped has started a period"


def test_the_level_of_a_logger_itself():
    assert rclpy.logging.get_logger_level("arm.hand") == LoggingSeverity.UNSET
    rclpy.logging.set_logger_level("arm.hand", LoggingSeverity.WARN)
    assert rclpy.logging.get_logger_level("arm.hand") == LoggingSeverity.WARN
