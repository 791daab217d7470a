"""Documents: ``page`` lays them out, ``testreport`` is that of a test, ``paper`` the figures."""
