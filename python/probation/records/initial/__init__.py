"""From the files of a laboratory to a campaign: `init_campaign`."""
