"""Parameter studies: many points of model and virtual test computed by Dask, one table of results.

``file`` is what a study file says, ``kinds`` what can be computed of a point, ``design`` which
points; ``points`` is what a worker does, ``journal`` what is safe of it, ``running`` sends the
points out. ``table``, ``sensitivity``, ``power`` and ``pictures`` are what comes of the results,
``folder`` reads them back. Others enter by ``running``, ``folder``.
"""
