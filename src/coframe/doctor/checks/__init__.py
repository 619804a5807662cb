"""The checks: one module each, with its CODE and ``find``, a pure function from an observation to findings.

A new one is a module here, a page of the same code beside, and a test.
"""
