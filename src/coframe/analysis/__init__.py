"""Facts about trees of transforms that every surface shares: structure, liveness, clocks, missing edges, commands."""
