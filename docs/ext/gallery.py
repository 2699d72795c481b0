"""``{gallery}``: every picture that `nearsight figures` makes. Nothing yet."""


def setup(app):
    """Register nothing."""
    return {"parallel_read_safe": True}
