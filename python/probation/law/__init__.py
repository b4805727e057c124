"""The law: eq. (6), its modifications, companion relations and closed forms."""
