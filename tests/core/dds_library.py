# SPDX-License-Identifier: Apache-2.0
"""Importable only where there is a DDS library: `pytest.importorskip("dds_library", reason=...)` skips elsewhere."""

from coframe.errors import WireError
from coframe.wire.dds import library

try:
    library.check()
except WireError as error:
    raise ModuleNotFoundError(str(error), name=__name__) from error
