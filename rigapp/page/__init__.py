"""The live page: what engines say, for browsers and for Prometheus, and nothing that commands.

``rig`` looks at one engine, ``view`` says what is known of it, ``plots`` draws it,
``fragments`` and ``metrics`` put it into words for browsers and Prometheus; ``watch`` does all that
in a thread, ``access`` says who may ask, ``serving`` is the server: it keeps the newest for every
page, bounds what a connection may take, and answers requests.
Others enter by ``serving``.
"""
