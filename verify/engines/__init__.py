"""Ways of checking a claim: one file an engine."""
