"""Wear of the bushing: Archard's law over time, its numerical error, and the life of the joint."""
