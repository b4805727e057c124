"""How close methods of smoothing come to a strain rate that is known."""
