"""The engine as a process: server, client, and the registry of running engines.

Other packages import ``client``, ``launch`` and ``registry`` (find or start an engine), ``host``
(run one), ``preflight`` (check the disk), ``resumption``, ``calibration``, ``rigqueue``,
``recorded``, ``requests``, ``faults``, ``simulated``, ``security``, ``pins``.
"""
