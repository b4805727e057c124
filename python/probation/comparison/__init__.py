"""What changed between two campaigns of the same material: the rig, the material, or nothing."""
