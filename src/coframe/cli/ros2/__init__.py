# SPDX-License-Identifier: Apache-2.0
"""Commands with the same names, options and output as ros2cli: ``coframe topic echo`` is ``ros2 topic echo``."""
