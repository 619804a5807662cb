"""A report as text, as JSON and as SARIF: three modules that know nothing of each other."""
