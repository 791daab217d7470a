"""The live page: what engines say, for browsers and for Prometheus, and nothing that commands.

``rig`` looks at one engine, ``view`` says what is known of it, ``plots`` and ``drawing`` draw it,
``fragments`` and ``metrics`` put it into words for browsers and Prometheus; ``watch`` does all that
in a thread, ``hub`` keeps the newest for every page, ``site`` answers requests, ``access`` says who
may ask, ``connections`` bounds what a connection may take, ``serving`` is the server.
Others enter by ``serving``.
"""
