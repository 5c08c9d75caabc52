"""Answers as blocks, and blocks as terminal text, LaTeX, HTML and JSON."""
