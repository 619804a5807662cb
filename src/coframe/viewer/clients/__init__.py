"""Connected browser tabs."""
