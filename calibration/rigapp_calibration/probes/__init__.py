"""Capacitance probes by micrometer steps: readings, line, checks, budget, alignment of a pair."""
