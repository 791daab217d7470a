"""Parameter studies: many points of model and virtual test computed by Dask, one table of results.

``design`` is the study file with its points, ``kinds`` the computations of a point; ``points``
is the work of a worker, ``journal`` stores its rows, ``running`` distributes the points. ``table``
and ``sensitivity`` evaluate the results, ``folder`` reads them back.
Other packages import ``running``, ``folder``.
"""
