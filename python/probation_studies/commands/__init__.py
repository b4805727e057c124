"""Commands of the studies, one per file; registered as entry points of the group `probation.commands`."""
