# SPDX-License-Identifier: Apache-2.0
"""The formats of calibrations, one module each."""
