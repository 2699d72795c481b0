"""The errors the project raises on purpose, under one root."""


class NearsightError(Exception):
    """Root of every error that the project raises on purpose."""


class InputError(NearsightError, ValueError):
    """An input that cannot be used.

    The message is one line that names what was given, where, and what would be accepted, so that
    a command line can print it as it stands.

    Parameters
    ----------
    message : str
        That line.
    argument : str, optional
        Name of the argument at fault (``"l_T"``), where the message is about one.
    """

    def __init__(self, message: str, argument: str | None = None) -> None:
        super().__init__(message)
        self.argument = argument
