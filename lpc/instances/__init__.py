"""Instances: one kind a file."""
