"""Where a simulation departs from reality, which effect causes it, and how far the gap shrinks with it."""
