"""Models in notebooks."""

from __future__ import annotations

import base64
import html
from typing import TYPE_CHECKING

from ._burgeon import formats as _formats

if TYPE_CHECKING:
    from ._model import Model

#: Width and height (pixels) of a model in a notebook.
WIDTH, HEIGHT = 640, 480


def html_of(model: Model) -> str:
    """Returns an HTML element that shows a model: a page to turn it, or a render if there is no format of pages."""
    if model.triangle_count == 0:
        return f"<p>{html.escape(repr(model))}</p>"
    if '"extension":"html"' in _formats().replace(" ", ""):
        page = model.to_bytes("html").decode()
        return f'<iframe srcdoc="{html.escape(page)}" width="{WIDTH}" height="{HEIGHT}" style="border:0"></iframe>'
    picture = base64.b64encode(model.to_bytes("png", width=WIDTH, height=HEIGHT, quality="film")).decode()
    title = html.escape(repr(model))
    return f'<img src="data:image/png;base64,{picture}" width="{WIDTH}" height="{HEIGHT}" alt="{title}">'
