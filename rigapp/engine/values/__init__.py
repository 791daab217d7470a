"""Raw samples to engineering units, once, and their statistics."""
