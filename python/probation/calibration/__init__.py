"""Companion relations from records or tables: tau_max identified at several rates, and what is known about it."""
