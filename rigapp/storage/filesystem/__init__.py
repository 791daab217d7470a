"""One file of the operating system: name, folder, space, lock, writing that may fail."""
