"""The pictures: a module with a ``PICTURE`` is one, named after its file."""
