"""Schema of messages and files, each item defined once: columns, messages, events, verbs."""
