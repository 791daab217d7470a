"""From blocks of samples to revolutions: encoder, clocks, gaps."""
