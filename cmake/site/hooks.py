"""Hooks of mkdocs. In the sources a link to a header of the HAL leads to the header; in the site to its page in the
reference that doxygen made, in the folder api."""
import logging
import re

HEADER = re.compile(r"\]\((?:\.\./)+hal/(?:api|types)/(\w+)\.h\)")
log = logging.getLogger("mkdocs.hooks")


def page_of(header):
    """As doxygen calls the page of a file: '_' is its escape."""
    return f"api/{header.replace('_', '__')}_8h.html"


def on_page_markdown(markdown, page, config, files):
    def link(found):
        if page_of(found[1]) not in files:
            log.warning("%s: no page of the header %s.h", page.file.src_path, found[1])
        return f"]({page_of(found[1])})"

    return HEADER.sub(link, markdown)


def on_nav(nav, config, files):
    """Strict: every page is in the navigation."""
    shown = {page.file.src_path for page in nav.pages}
    for file in files.documentation_pages():
        if file.src_path not in shown:
            log.warning("%s is not in the navigation of cmake/site/mkdocs.yml", file.src_path)
    return nav
