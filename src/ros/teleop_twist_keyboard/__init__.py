# SPDX-License-Identifier: Apache-2.0
"""A program that drives a robot with the keyboard."""

from teleop_twist_keyboard.teleop_twist_keyboard import TeleopTwistKeyboard, main

__all__ = ["TeleopTwistKeyboard", "main"]
