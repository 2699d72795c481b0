"""``python -m nearsight`` is ``nearsight``."""

from .cli import main

if __name__ == "__main__":
    main()
