"""Pin and bushing as separate bodies: contact laws as curves, integration, impacts, statistics."""
