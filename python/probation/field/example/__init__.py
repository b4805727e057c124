"""A synthetic field of a necking specimen, whose truth is known; shares nothing with the engine."""
