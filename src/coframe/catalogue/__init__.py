"""The catalogue: what can be wrong with transforms, why that matters and what to do, by stable codes.

The doctor's findings and the hints of exceptions are made of it; nothing here knows of either.
"""

from coframe.catalogue.hints import hint
from coframe.catalogue.reading import Page, codes, page

__all__ = ["Page", "codes", "hint", "page"]
