"""Plots over time of poses, fields of messages, rates and delays."""
