"""What a new rig starts with: a folder of files, those of real devices, schemas for an editor."""
