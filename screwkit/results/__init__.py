"""Answers as frozen plain data: integers, strings of the grammar, tuples.

One module a question.  Exact quantities are canonical text of the expression grammar,
so that they can be read back; `reports` renders them, `analyses` makes them, and
neither is known here.
"""
