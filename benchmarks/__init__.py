"""coframe beside its peers: `make bench`."""
