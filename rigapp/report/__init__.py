"""Documents: ``page`` sets them, ``testreport`` is that of a test, ``paper`` the paper's figures.

Whoever composes documents may enter ``page``; a report reads files through the storage's door.
"""
