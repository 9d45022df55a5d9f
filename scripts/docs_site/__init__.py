"""Builds the documentation site from the Markdown of the tree: see docs/dev/site.md."""
