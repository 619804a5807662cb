# SPDX-License-Identifier: Apache-2.0
"""Tests of the wheel for 64-bit ARM on another processor: `make test-arm`."""
