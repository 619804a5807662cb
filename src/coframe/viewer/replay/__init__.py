"""Replays: a time span as one HTML file."""
