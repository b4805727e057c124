"""The evidence for `probation`: the paper reproduced, the sealed benchmark, a virtual specimen."""
