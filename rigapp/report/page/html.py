"""Set a document as one HTML file that needs nothing else: styles and pictures are inside."""

from __future__ import annotations

from base64 import b64encode

from rigapp.report.page.manuscript import Block, Figure, Manuscript, numeric_columns


def as_html(document: Manuscript) -> bytes:
    """Return the document as one HTML file with its pictures inside."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("rigapp.report.page", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    template = environment.get_template("document.html")
    return template.render(
        document=document, kind_of=_kind, data_of=_data, numeric=numeric_columns
    ).encode(errors="replace")


def _kind(block: Block) -> str:
    return type(block).__name__.lower()


def _data(figure: Figure) -> str:
    return f"data:{figure.mime};base64,{b64encode(figure.image).decode()}"
