# SPDX-License-Identifier: Apache-2.0
"""This Python process: its terminal, signals, memory, optional packages and child processes."""
