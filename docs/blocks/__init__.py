"""The blocks of measured numbers in the book, by page; docs/numbers.py writes them."""

from . import measured, model, published, tutorial  # noqa: F401
