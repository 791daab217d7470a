"""The live page: state and data of engines, read-only, for browsers and for Prometheus.

``rig`` observes one engine, ``view`` reduces it to values, ``plots`` draws it, ``fragments`` and
``metrics`` format it for browsers and Prometheus; ``watch`` does all that in a thread, ``access``
holds the rules of access, ``serving`` is the server: it stores the newest frames for every page,
bounds the resources of a connection, and answers requests.
Other packages import ``serving``.
"""
