"""Conversion of raw samples to engineering units, and their statistics."""
