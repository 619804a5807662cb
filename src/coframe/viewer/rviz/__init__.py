"""RViz configuration files."""
