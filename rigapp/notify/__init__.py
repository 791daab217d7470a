"""Messages to an absent operator: mail, chat, a command, a dead man's switch.

The rules, the outbox and the wording are pure. A process of its own, the notifier, stores the
outbox on the disk and starts a short one for each attempt, the only one to read the secrets.

Other packages import ``channels``, ``delivery``, ``facts``, ``link``, ``message``, ``store``.
"""
