"""The common parts of every process of the program: end, threads, log, clock, files.

Any package of rigapp may import it; it imports none of them but schema and the errors of config.
Others enter by ``awake``, ``children``, ``ending``, ``locks``, ``logs``, ``memory``,
``priority``, ``private``, ``processclock``, ``stale_files``, ``threads``.
"""
