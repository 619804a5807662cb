# SPDX-License-Identifier: Apache-2.0
"""Fast DDS as a middleware of coframe."""
