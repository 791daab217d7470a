"""The Basicmicro RoboClaw by packet serial. Enter by ``driver``."""
