"""The bushing as an elastic body: sector mesh, surface compliance, contact with the rigid pin."""
