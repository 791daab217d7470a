"""The wear of the bushing: Archard's law in time, its error, and the life of the joint."""
