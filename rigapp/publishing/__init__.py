"""Recorded tests as they are published: what goes in, what is private, how it is described.

One ZIP file with the tests as they are and everything that others need to read, trust and cite
them. Others enter by ``package``, ``private``.
"""
