"""How Sphinx builds the manual; scripts/docs.sh calls it."""
import os
import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# What of MathJax 2 the output as SVG needs: it works without a server and
# without web fonts.
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions",
                 "jax/element", "jax/input/TeX", "jax/output/SVG/jax.js",
                 "jax/output/SVG/config.js", "jax/output/SVG/autoload",
                 "jax/output/SVG/fonts/TeX", "localization/en")

project = "Spall"
author = "The authors of Spall"
version = re.search(r"project\(spall VERSION (\S+)",
                    (ROOT / "CMakeLists.txt").read_text())[1]
release = version

extensions = ["myst_parser", "breathe", "sphinx_copybutton",
              "sphinx.ext.mathjax"]
exclude_patterns = ["developer/api/Doxyfile"]

myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
myst_update_mathjax = False
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"messageStyle": "none", "SVG": {"linebreaks":
                   {"automatic": True}, "font": "TeX"}}

breathe_projects = {name: str(ROOT / "build/docs_api" / name)
                    for name in ("dem", "fem", "coupling")}
breathe_default_members = ("members",)
breathe_show_include = False

html_theme = "furo"
html_title = f"Spall {version}"
html_static_path = ["_static"]
html_css_files = ["spall.css"]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = True

# Pages of the repository outside docs, and the pages that hold their text.
OUTSIDE = {"data/README.md": "developer/data.md",
           "CONTRIBUTING.md": "developer/contributing.md",
           "README.md": "index.md"}
HELD = {page: path for path, page in OUTSIDE.items() if page != "index.md"}
LINK = re.compile(r"(\]\()([^)#:\s]+)((?:#[^)]*)?\))")


def take_outside_pages(app, docname, source):
    """Links lead to the page of the manual that holds the text."""
    page = docname + ".md"
    origin = ROOT / HELD.get(page, "docs/" + page)
    if page in HELD:
        source[0] = origin.read_text(encoding="utf-8")

    def led_inside(match):
        target = os.path.normpath(origin.parent / match[2])
        path = os.path.relpath(target, ROOT)
        if path not in OUTSIDE and page not in HELD:
            return match[0]
        inside = DOCS / OUTSIDE.get(path, os.path.relpath(target, DOCS))
        inside = os.path.relpath(inside, (DOCS / page).parent)
        return match[1] + inside + match[3]

    source[0] = LINK.sub(led_inside, source[0])


# Stands for the API of the headers of a folder, without those of folders in it.
HEADERS = re.compile(r"^<!-- headers of ((dem|fem|coupling)\S*) -->$", re.M)


def list_headers(app, docname, source):
    """A section with the contents of each public header."""
    def sections(match):
        folder, library = match[1], match[2]
        include = ROOT / library / "include"
        return "\n\n".join(
            f"## `{header.relative_to(include)}`\n\n"
            f"```{{doxygenfile}} {header.relative_to(include)}\n"
            f":project: {library}\n```"
            for header in sorted((include / folder).glob("*.h")))

    source[0] = HEADERS.sub(sections, source[0])


def copy_mathjax(app, exception):
    if exception or app.builder.format != "html":
        return
    for part in MATHJAX_PARTS:
        target = pathlib.Path(app.outdir) / "_static/mathjax" / part
        if (MATHJAX / part).is_dir():
            shutil.copytree(MATHJAX / part, target, dirs_exist_ok=True)
        else:
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(MATHJAX / part, target)


def setup(app):
    app.connect("source-read", take_outside_pages)
    app.connect("source-read", list_headers)
    app.connect("build-finished", copy_mathjax)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
