"""Control, record and understand slider-crank joint wear tests."""
