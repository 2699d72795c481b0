"""Show me: one file a picture, each from data that are kept beside it."""

from .catalogue import picture_named, pictures
from .flaws import flaws
from .one import Drawn
from .picture import Picture
from .run import draw_all
from .size import SIZES, Size
from .subject import Subject
from .table import Table

__all__ = [
    "SIZES",
    "Drawn",
    "Picture",
    "Size",
    "Subject",
    "Table",
    "draw_all",
    "flaws",
    "picture_named",
    "pictures",
]
