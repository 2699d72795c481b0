"""The errors the project raises on purpose, under one root."""


class NearsightError(Exception):
    """Root of every error that the project raises on purpose."""


class InputError(NearsightError, ValueError):
    """An input that cannot be used.

    The message is one line that names what was given, where, and what would be accepted, so that
    a command line can print it as it stands.
    """
