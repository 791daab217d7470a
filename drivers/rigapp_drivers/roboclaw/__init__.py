"""The Basicmicro RoboClaw over packet serial. Import ``driver``."""
