"""Networked online convex problems, their optimum, and Localized Predictive Control."""
