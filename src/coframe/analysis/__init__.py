# SPDX-License-Identifier: Apache-2.0
"""Facts about trees of transforms that every surface shares: structure, liveness, clocks, missing edges, commands."""
