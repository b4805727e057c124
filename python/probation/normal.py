"""Numbers of the normal distribution."""

TWO_SIDED_95 = 1.959963984540054
"""Standard deviations on either side of the mean that hold 95 %."""

UPPER_95 = 1.6448536269514722
"""Standard deviations above the mean that 5 % exceed; so do 10 % of absolute values."""

SD_OF_MEDIAN = 1.482602218505602
"""Standard deviation over the median of absolute values."""
