"""The documentation site as Sphinx builds it: `cargo xtask site` puts the pages beside this file and calls it."""

import os
from dataclasses import is_dataclass

from docutils import nodes

project = "Denavit"
author = copyright = "the Denavit contributors"
version = release = os.environ["DENAVIT_VERSION"]

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx_copybutton",
    "sphinx_design",
]
# Files that pages link to lie among them.
include_patterns = ["*.md", "api/*.md", "docs/*.md", "docs/notebooks/*.ipynb", "**/folder.md"]
exclude_patterns = ["LICENSE*"]

nitpicky = True
# What annotations name and nobody describes: aliases of types, and parameters of texts.
nitpick_ignore_regex = [
    ("py:.*", r"(numpy|jax|torch|np|os|pathlib|collections|typing)\..*"),
    ("py:.*", r"(Array|ArrayLike|Floats|NDArray|Limits|PathLike|Tensor|TypeAliasForwardRef|Any)"),
]
default_role = "py:obj"
highlight_language = "none"
pygments_style, pygments_dark_style = "friendly", "github-dark"

nb_execution_mode = "off"
nb_merge_streams = True
myst_enable_extensions = ["colon_fence", "attrs_inline"]
myst_heading_anchors = 4
# Pages are written for readers of the repository first: some begin below a first heading.
suppress_warnings = ["myst.header"]

autodoc_member_order = "bysource"
autodoc_mock_imports = ["jax", "torch"]
autodoc_typehints_format = "short"
#: Where public names stand.
MODULES = ["denavit", "denavit.jax", "denavit.torch", "denavit.eaik", "denavit.ikpy", "denavit.lerobot"]
ALIASES = ["Array", "ArrayLike", "Floats", "Limits", "PathLike", "Tensor"]
autodoc_type_aliases = {name: name for name in ALIASES}
python_use_unqualified_type_names = True
maximum_signature_line_length = 88
add_module_names = False
toc_object_entries_show_parents = "hide"
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True

html_theme = "furo"
html_title = f"Denavit {version}"
html_static_path = ["static"]
html_css_files = ["style.css"]
html_favicon = "static/icon.svg"
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_theme_options = {
    "light_logo": "icon.svg",
    "dark_logo": "icon.svg",
    "light_css_variables": {"color-brand-primary": "#0b5fa5", "color-brand-content": "#0b5fa5"},
    "dark_css_variables": {"color-brand-primary": "#7cc0ff", "color-brand-content": "#7cc0ff"},
}


def described(app, what, name, of, options, lines):
    """Parameters as docstrings list them, names and below them what they are, become a list of definitions."""
    if "Parameters" not in lines:
        return
    at = lines.index("Parameters")
    out = [":Parameters:"]
    rest = at + 2
    while rest + 1 < len(lines) and lines[rest] and lines[rest + 1].startswith("    "):
        out.append("    " + ", ".join(f"``{one}``" for one in lines[rest].split(", ")))
        rest += 1
        while rest < len(lines) and (lines[rest].startswith("    ") or not lines[rest]):
            out.append("    " + lines[rest] if lines[rest] else "")
            rest += 1
    lines[at:rest] = [*out, ""]


def signed(app, what, name, of, options, signature, returned):
    """Records are made by the package: what they hold is said member by member."""
    is_record = what == "class" and (is_dataclass(of) or issubclass(of, tuple))
    return ("", None) if is_record or what == "exception" else None


def outside(app, env, node, content):
    """Names of the package, as its modules call them."""
    goal = node.get("reftarget", "")
    if node.get("refdomain") != "py":
        return None
    # A robot's methods stand in several classes, which nobody else has to know.
    if goal.removeprefix("denavit._formulas.") == "Derivations":
        goal, content = "Robot", nodes.Text("Robot")
    for module in MODULES:
        place = (env, node.get("refdoc", ""), app.builder, "obj", f"{module}.{goal}", node, content)
        found = env.get_domain("py").resolve_xref(*place)
        if found is not None:
            return found
    return None


def setup(app):
    app.connect("autodoc-process-docstring", described)
    app.connect("autodoc-process-signature", signed)
    app.connect("missing-reference", outside)
