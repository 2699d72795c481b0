"""Finite graph families, one file a family."""
