"""Infinite graph families, known by their growth, one file a family."""
