"""What is calibrated while the spindle turns: the pin's run-out, and the cell by known inertia."""
