"""Solvers of other libraries: one a file."""
