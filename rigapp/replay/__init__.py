"""A recorded test that answers as an engine does: its client, and the messages that a file gives.

The client has the manner of ``rigapp.service.client.Client``, so that a window shows both alike.
Whoever draws a file takes its curves from ``messages`` too. It reads files and judges them by the
engine's own rules; it knows no device, no window and no other process. Others enter by ``client``
and ``messages``.
"""
