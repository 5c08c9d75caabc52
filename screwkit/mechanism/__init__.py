"""Mechanisms: files, their model, and the graph of links and joints."""
