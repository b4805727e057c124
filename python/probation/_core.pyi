"""Types of the compiled module; a test keeps them true."""

__version__: str

class InputError(ValueError): ...

class ConvergenceError(RuntimeError):
    time: float
    residual_norm: float
