"""The verdicts as Markdown, JSON and one HTML page."""
