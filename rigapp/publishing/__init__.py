"""Publish recorded tests: content of the package, private data in it, description.

One ZIP file with the unchanged tests and everything that others need to read, trust and cite
them. Other packages import ``package``, ``private``.
"""
