"""Facts about a tree of transforms that every surface shares: its structure, liveness, clocks and missing edges."""
