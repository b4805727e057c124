"""A law with effects on the records of a campaign, refitted and weighed: what every question shares."""
