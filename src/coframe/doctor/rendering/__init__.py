"""Formats of reports: text, JSON and SARIF, in three independent modules."""
