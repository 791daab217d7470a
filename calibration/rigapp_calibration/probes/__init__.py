"""Capacitance probes by micrometer steps: readings, line, checks, budget, how a pair stands."""
