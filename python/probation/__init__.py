"""Put a constitutive law on probation.

The public names stand in ``__init__.pyi``; each is imported when it is first used.
"""

# isort: off
from probation import _interrupt  # noqa: F401 - first, for all that is loaded after it
import lazy_loader
# isort: on

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
