"""Put a constitutive law on probation.

The public names stand in ``__init__.pyi``; each is imported when it is first used.
"""

import lazy_loader

from probation import _interrupt  # noqa: F401 - first, for all that is loaded after it

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
