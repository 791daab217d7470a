"""What flows and is stored, said once: columns, messages, events, verbs."""
