"""The engine as a process: server, client, and how they find each other.

Others enter by ``client``, ``launch`` and ``registry`` (find or start an engine), ``host`` (be
one), ``preflight`` (look at the disk), ``resumption``, ``calibration``, ``rigqueue``,
``recorded``, ``requests``, ``faults``, ``simulated``, ``security``, ``pins``.
"""
