"""What mkdocs does besides for the site: pages are made of the program's declarations, formulas are set, and links out
of docs/ end well.

The pages are written for GitHub, where `$...$` and `$$...$$` are formulas and links lead to any file.
Formulas are set here, by KaTeX, so that a page needs no script; style and fonts are copied into the
site. The program, which LISTRIC names, else the newest of build/, prints help and measures; the rooms are drawn from the
includes. Where LISTRIC names it, the site has the page of `listric draw`, too, and where LISTRIC_RUN names a finished
run, its report; the home page links to them. Where the sources have the model for pages, its page runs scenes, too. (Browsers set MathML alone badly where no font for it is installed; it is there for readers
who hear the page.)
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image
from mkdocs.exceptions import PluginError
from mkdocs.plugins import event_priority
from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "docs"))
import measures  # noqa: E402

KATEX_STYLE = Path("/usr/share/javascript/katex/katex.min.css")
PAGES_OUTSIDE = ("CONTRIBUTING.md", "CHANGELOG.md")
NOT_SERVED = {".py", ".sh"}

CODE = r"^(?P<fence>```|~~~).*?^(?P=fence)|(?P<ticks>`+)(?!`).+?(?<!`)(?P=ticks)(?!`)"
FORMULA = re.compile(CODE + r"|\$\$(?P<block>.+?)\$\$|\$(?P<line>[^\s$](?:[^$\n]*[^\s$])?)\$(?!\d)",
                     re.DOTALL | re.MULTILINE)
LINK = re.compile(CODE + r"|(?<!!)\[(?P<text>[^\]]*)\]\((?P<to>[^)#:\s]+)(?P<anchor>#[^)]*)?\)",
                  re.DOTALL | re.MULTILINE)
MARK = "\ue000{}\ue001"  # private characters, which mean nothing to Markdown

KATEX = """
const formulas = JSON.parse(require("fs").readFileSync(0));
let katex;
try { katex = require("katex"); } catch { process.exit(3); }
console.log(JSON.stringify(formulas.map(([tex, displayMode]) =>
    katex.renderToString(tex, {displayMode, strict: "error"}))));
"""

DEMOS = "try"  # folder of the site
EXAMPLES = ("lis1", "lis2", "rfr")  # scenes that the page begins with, by what stands behind its #
MODULE = ROOT / "apps/page/listric.wasm.gz"
CALL = re.compile(r"^  ([a-z]+)  ", re.MULTILINE)  # in the list of all calls
DRAWING = "reference/architecture.svg"
MADE = tempfile.TemporaryDirectory(prefix="listric-site-")  # pages of this build
FILM = "pictures/lis1.webp"
# Weights of pages in the search, by how their places begin: guides come before notes that they were written from.
WEIGHTS = {"record/": 0.1, "CHANGELOG/": 0.1}
formulas = []  # (TeX, whether it stands on a line of its own) of all pages


def on_config(config):
    config["extra_css"].append("katex/katex.css")


def on_pre_build(config):
    formulas.clear()


@event_priority(-100)  # when the search has written its files
def on_post_build(config):
    put_katex(config)
    weigh_search(Path(config["site_dir"], "search"))
    put_still(Path(config["site_dir"], FILM))
    if demos():
        make_demos(config["site_dir"])


def weigh_search(folder):
    """Gives entries of the search their weights, which the script that comes with mkdocs does not know."""
    index, script = folder / "search_index.json", folder / "worker.js"
    content, text = json.loads(index.read_text()), script.read_text()
    for entry in content["docs"]:
        for begin, weight in WEIGHTS.items():
            if entry["location"].startswith(begin):
                entry["boost"] = weight
    index.write_text(json.dumps(content, separators=(",", ":")))
    weighed = text.replace("this.add(doc);", "this.add(doc, {boost: doc.boost || 1});")
    if weighed == text:
        raise PluginError("search/worker.js adds its documents in another way than docs/site_hooks.py knows")
    script.write_text(weighed)


def still_of(film):
    return film.with_name(f"{film.stem}-still{film.suffix}")


def put_still(film):
    """The last picture of the film, for readers who stop it or whose system asks for no motion."""
    picture = Image.open(film)
    picture.seek(picture.n_frames - 1)
    picture.convert("RGB").save(still_of(film), quality=80)


def put_katex(config):
    """KaTeX's style, with its fonts in the one format that all browsers take."""
    to = Path(config["site_dir"], "katex")
    Path(to, "fonts").mkdir(parents=True, exist_ok=True)
    style = re.sub(r",url\([^)]*\) format\('(woff|truetype)'\)", "", KATEX_STYLE.read_text())
    Path(to, "katex.css").write_text(style)
    for font in set(re.findall(r"url\(([^)]*)\)", style)):
        shutil.copy(KATEX_STYLE.parent / font, to / font)


def on_files(files, config):
    for file in list(files):
        if Path(file.src_path).suffix in NOT_SERVED:
            files.remove(file)
    make_pages(Path(MADE.name))
    made = sorted(path.relative_to(MADE.name).as_posix() for path in Path(MADE.name).rglob("*.*"))
    for folder, names in ((ROOT, PAGES_OUTSIDE), (MADE.name, made)):
        for name in names:
            files.append(File(name, str(folder), config.site_dir, config.use_directory_urls))
    return files


def find_program():
    built = sorted(ROOT.glob("build/*/listric"), key=lambda file: file.stat().st_mtime)
    program = os.environ.get("LISTRIC") or (built and built[-1])
    if not program:
        raise PluginError("help and measures are the program's: build it (./listric scenes), or name it in LISTRIC")
    return program


def make_pages(folder):
    """Help of all calls, measures of validation and the drawing of the rooms."""
    program = find_program()
    Path(folder, "reference").mkdir(exist_ok=True)

    def ask(*words):
        return subprocess.run([program, *words], check=True, stdout=subprocess.PIPE, text=True,
                              env={**os.environ, "COLUMNS": "80", "LISTRIC_CALL": "listric"}).stdout

    overview = ask("help")
    texts = {"listric": overview, **{call: ask("help", call) for call in CALL.findall(overview.partition("\nOptions\n")[0])}}
    Path(folder, "reference/calls.md").write_text(
        "# Help of all calls\n\nThe texts of `listric help CALL`; [commands](commands.md) shows what the calls are for.\n"
        + "".join(f"\n## {call}\n\n```\n{text}```\n" for call, text in texts.items()))
    Path(folder, "reference/validation-measures.md").write_text(measures.of_validation(json.loads(ask("schema", "--measures"))))
    subprocess.run([sys.executable, "-B", ROOT / "tests/checks/architecture.py", Path(folder, DRAWING)], check=True)


def demos():
    """Pages of the program by their files, and what makes each."""
    program, run = os.environ.get("LISTRIC"), os.environ.get("LISTRIC_RUN")
    made = {"draw.html": [program, "draw", "lis1"]} if program else {}
    if program and run:
        made["report.html"] = [program, "report", run]
    return made


def links_to_demos():
    """Addresses and words."""
    examples = [(f"draw.html#{name}", f"run <code>{name}</code>") for name in EXAMPLES] if MODULE.exists() else []
    links = [("report.html", "explore a finished run")] if "report.html" in demos() else []
    return examples + ([("draw.html", "draw a section")] if "draw.html" in demos() else []) + links


def make_demos(site):
    Path(site, DEMOS).mkdir(exist_ok=True)
    for name, call in demos().items():
        ended = subprocess.run([*call, "--output", Path(site, DEMOS, name)], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True)
        if ended.returncode:
            raise PluginError(f"{' '.join(call)}: {ended.stdout}")


def with_demos(markdown):
    """The home page with links to the demos below its first picture."""
    if not demos():
        return markdown
    links = " · ".join(f'<a href="{DEMOS}/{address}">{text}</a>' for address, text in links_to_demos())
    lack = "" if MODULE.exists() else " It runs nothing: these sources lack the model for pages, which `.ci/run page` makes."
    head, mark, rest = markdown.partition("\n*`lis1`.")
    return f"{head}\n**Try it now**, in this browser, without installing: {links}.{lack}\n{mark}{rest}"


def on_page_markdown(markdown, page, config, files):
    if page.file.src_path == "index.md":
        markdown = with_demos(markdown)
    if page.file.src_path == "reference/architecture.md":
        markdown = markdown.replace("<!-- drawing -->", f"![Rooms and who includes whom]({Path(DRAWING).name})")
    return FORMULA.sub(mark_formula, relink(markdown, page.file))


def on_page_content(html, page, config, files):
    """A click on a picture shows it alone, at its size; small ones stand in tables and links already. The film can be stopped."""
    html = re.sub(rf'<p>(<img\b[^>]*?\bsrc="{FILM}"[^>]*>)</p>', with_still, html)
    return re.sub(r'<p>(<img\b[^>]*?\bsrc="([^"]+)"[^>]*>)</p>', r'<p><a href="\2">\1</a></p>', html)


def with_still(match):
    """The film, its last picture, and a link of both to the first demo."""
    first = [f"{DEMOS}/{address}" for address, _ in links_to_demos()[:1]]
    film = f'<a href="{first[0]}">{match[1]}</a>' if first else match[1]
    still = film.replace(f'src="{FILM}"', f'src="{still_of(Path(FILM)).as_posix()}"')
    return (f'<div class="film"><input type="checkbox" id="stop-film"><label for="stop-film">Stop the film</label>'
            f'<div class="moving">{film}</div><div class="still">{still}</div></div>')


def on_post_page(output, page, config):
    return with_names(output)


def on_post_template(output, template_name, config):
    return with_names(output)  # 404.html


def with_names(output):
    """Names for the theme's bar, and for its buttons that show a sign alone."""
    output = output.replace('<div class="navbar fixed-top', '<div role="navigation" aria-label="Site" class="navbar fixed-top', 1)
    for button, name in (('data-target="#navbar-collapse"', "Menu"), ('data-target="#toc-collapse"', "Contents of this page")):
        output = output.replace(button, f'{button} aria-label="{name}"', 1)
    return output


def mark_formula(match):
    tex = match["block"] or match["line"]
    if not tex:
        return match[0]  # code
    formulas.append((tex.strip(), match["block"] is not None))
    return MARK.format(len(formulas) - 1)


def relink(markdown, file):
    """Links to files that the site does not have become their names; dead ones stay, for mkdocs to
    refuse."""
    source = Path(file.abs_src_path).parent
    docs = ROOT / "docs"

    def link(match):
        if not match["to"]:
            return match[0]
        target = Path(os.path.normpath(source / match["to"]))
        if not target.exists():
            return match[0]
        if target.parent == ROOT and target.name in PAGES_OUTSIDE:
            place = target.name
        elif docs in target.parents and target.is_file() and target.suffix not in NOT_SERVED:
            place = target.relative_to(docs).as_posix()
        else:
            return f"`{match['text'].strip('`')}`"
        to = os.path.relpath(place, os.path.dirname(file.src_path) or ".")
        return f"[{match['text']}]({to}{match['anchor'] or ''})"

    return LINK.sub(link, markdown)


def on_env(env, config, files):
    """All formulas of the site in one call, since it takes as long as some hundred formulas."""
    if not formulas:
        return
    rendered = [re.sub(r"<annotation.*?</annotation>", "", html, flags=re.DOTALL)
                for html in rendered_formulas()]
    for file in files.documentation_pages():
        file.page.content = re.sub(MARK.format(r"(\d+)"), lambda m: rendered[int(m[1])],
                                   file.page.content)


def rendered_formulas():
    missing = PluginError("formulas need node and katex: apt-get install nodejs katex")
    where = {**os.environ, "NODE_PATH": "/usr/share/nodejs:" + os.environ.get("NODE_PATH", "")}
    try:
        ended = subprocess.run(["node", "-e", KATEX], input=json.dumps(formulas), env=where,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    except FileNotFoundError:
        raise missing from None
    if ended.returncode == 3:
        raise missing
    if ended.returncode:
        why = re.search(r"ParseError: .*", ended.stderr)
        raise PluginError(why[0] if why else ended.stderr)
    return json.loads(ended.stdout)
