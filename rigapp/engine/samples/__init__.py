"""Blocks of samples to revolutions: encoder, clocks, gaps."""
