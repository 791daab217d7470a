"""Elastic bushing: sector mesh, surface compliance, contact with the rigid pin."""
