"""Replay client of a recorded test, with the engine's interface, and the messages of a file.

The client has the interface of ``rigapp.service.client.Client``, so that a window shows both alike.
Other drawings of a file take their curves from ``messages`` too. It reads files and evaluates them
by the engine's own rules; it uses no device, window or other process. Other packages import
``client`` and ``messages``.
"""
