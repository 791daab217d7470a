"""One file as the operating system has it: name, folder, room, lock, writing that may fail."""
