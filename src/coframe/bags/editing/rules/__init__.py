# SPDX-License-Identifier: Apache-2.0
"""The rules that edit recordings, one per module; `coframe.bags.editing._recipe` lists them."""
