"""The ME-Systeme GSV-8: bridges, voltages and encoder in one frame. Import ``driver``."""
