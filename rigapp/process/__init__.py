"""Common parts of every process of the program: end, threads, log, clock, files.

Any package of rigapp may import it; it imports only schema and the errors of config.
Other packages import ``awake``, ``children``, ``ending``, ``locks``, ``logs``, ``memory``,
``priority``, ``private``, ``processclock``, ``stale_files``, ``threads``.
"""
