"""Pages for a browser: lessons, and scenes that one can walk through."""

import html as _html
import os

from . import _merge2d


class Page:
    """A page that needs no network: shown in a notebook, saved as a file."""

    def __init__(self, html):
        self.html = html

    def save(self, path):
        """Writes the page as a file."""
        with open(os.fspath(path), "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self):
        return (f'<iframe srcdoc="{_html.escape(self.html)}" width="100%" height="720" '
                'style="border: 0" title="merge2d"></iframe>')

    def __repr__(self):
        return f"<merge2d.Page of {len(self.html) / 1e6:.1f} MB>"


def lesson(name, *, live=True):
    """The page of a built-in lesson, of a lesson's folder, or of a scene by its name. With `live` it
    carries the engine, and one can take over the run.

    >>> import merge2d
    >>> page = merge2d.lesson("one-step", live=False)
    >>> page.html.lower().startswith("<!doctype html>")
    True
    """
    return Page(_merge2d.lesson_page(os.fspath(name), live))
