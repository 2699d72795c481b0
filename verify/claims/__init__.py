"""Claims: one file a theorem, or a section. A file here adds its ``CLAIMS`` to the catalogue."""
