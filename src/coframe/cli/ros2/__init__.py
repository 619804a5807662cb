# SPDX-License-Identifier: Apache-2.0
"""Commands with the words, the options and the output of ros2cli: ``coframe topic echo`` is ``ros2 topic echo``."""
