"""The site that mkdocs makes of docs/: whole, and at rest when it is opened.

    python3 -m unittest site_test
"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from browsed import Browsed, browser
from program import PROGRAM, SOURCES

# What a browser fetches by itself, in a page, a style or a script.
FETCHED = re.compile(r"<(?:script|img|iframe|source|object|embed)\b[^>]*?\b(?:src|data)=[\"']([^\"']+)"
                     r"|<link\b[^>]*?\bhref=[\"']([^\"']+)|url\([\"']?([^\"')]+)|@import [\"']([^\"']+)")
DEMO = """description = "Demonstration block"
[hanging_wall]
length_m = 4000.0
thickness_m = 1500.0
mean_radius_m = 60.0
[detachment]
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 6000.0}}]
[extension]
distance_m = 200.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 100.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
"""
MODULE = SOURCES / "apps/page/listric.wasm.gz"  # where .ci/run page has made it
LINKED = re.compile(r"<a\b[^>]*?\bhref=[\"']([^\"'#]*)(?:#([^\"']*))?[\"']")


def fetched(text):
    return [next(filter(None, groups)) for groups in FETCHED.findall(text)]


def build(sources, site, **environment):
    return subprocess.run(["mkdocs", "build", "--strict", "--site-dir", site], cwd=sources,
                          env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def finished_run(folder):
    """A run of 400 discs, which takes 2 s."""
    scene, run = folder / "demo.toml", folder / "demo"
    scene.write_text(DEMO)
    subprocess.run([PROGRAM, "run", scene, "--output", run, "--threads", "1", "--quiet"], check=True,
                   env={**os.environ, "LISTRIC_PYTHON": "/bin/false", "XDG_CACHE_HOME": str(folder)},
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return run


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.site = Path(folder.name, "site")
        run = finished_run(Path(folder.name))
        cls.built = build(SOURCES, cls.site, LISTRIC=str(PROGRAM), LISTRIC_RUN=str(run))
        cls.pages = {page.relative_to(cls.site): re.sub(r"<!--.*?-->", "", page.read_text(), flags=re.DOTALL)
                     for page in sorted(cls.site.rglob("*.html"))}

    def test_is_built_without_a_warning(self):
        self.assertEqual(self.built.returncode, 0, self.built.stdout)
        self.assertEqual([page for page in self.not_in_menu() if not page.startswith("record/20")], [],
                         "name it in mkdocs.yml")
        self.assertGreater(len(self.pages), 20)

    def not_in_menu(self):
        _, found, rest = self.built.stdout.partition("not included in the \"nav\" configuration:\n")
        return re.findall(r"^ +- (\S+\.md)$", rest, re.MULTILINE) if found else []

    def test_the_lab_book_is_not_in_the_menu(self):
        self.assertIn("record/2026-11/accuracy.md", self.not_in_menu())

    def test_a_section_is_drawn_without_installing(self):
        home = self.pages[Path("index.html")]
        self.assertIn('<a href="try/draw.html">draw a section</a>', home)
        self.assertIn('"scene":"lis1"', (self.site / "try/draw.html").read_text())
        for name in ("lis1", "lis2", "rfr"):
            self.assertEqual(f'<a href="try/draw.html#{name}">run <code>{name}</code></a>' in home, MODULE.exists())
        self.assertEqual("lack the model for pages" in home, not MODULE.exists())
        self.assertRegex(home, r'<a href="try/draw.html[^"]*"><img [^>]*src="pictures/lis1.webp"')
        self.assertLess(home.index("Try it now"), home.index(">installing<"))

    def test_a_finished_run_is_explored_without_installing(self):
        self.assertIn('<a href="try/report.html">explore a finished run</a>', self.pages[Path("index.html")])
        page = (self.site / "try/report.html").read_text()
        self.assertIn("<title>Listric</title>", page)
        self.assertIn("Demonstration block", page)

    def test_the_search_finds_parameters_and_measures(self):
        index = json.loads((self.site / "search/search_index.json").read_text())
        separator = re.compile(index["config"]["separator"])
        for page, word in (("reference/parameters", "least_slip_m"), ("reference/parameters", "fault_weakening.least_slip_m"),
                           ("reference/measures", "rollover_tilt_deg"), ("reference/validation-measures", "hinge_step_m")):
            found = [entry for entry in index["docs"] if entry["location"].startswith(f"{page}/#")
                     and word in separator.split(f"{entry['title']} {entry['text']}") and entry["title"].endswith(word)]
            self.assertEqual(len(found), 1, word)
            anchor = found[0]["location"].partition("#")[2]
            self.assertIn(f'id="{anchor}"', self.pages[Path(page, "index.html")])

    def test_has_what_the_program_declares(self):
        calls = self.pages[Path("reference/calls/index.html")]
        for call in subprocess.run([PROGRAM, "help"], check=True, stdout=subprocess.PIPE, text=True).stdout.split("\nOptions")[0] \
                .splitlines():
            if re.match(r"  [a-z]+  ", call):
                self.assertIn(f"<code>listric {call.split()[0]}: ", calls)
        self.assertIn('src="../architecture.svg"', self.pages[Path("reference/architecture/index.html")])
        self.assertIn("apps/run includes apps/scene", (self.site / "reference/architecture.svg").read_text())

    def test_the_search_finds_guides_before_records(self):
        folder = self.site / "search"
        index = json.loads((folder / "search_index.json").read_text())
        self.assertTrue(all((entry.get("boost", 1) < 1) == entry["location"].startswith(("record/", "CHANGELOG/")) for entry in index["docs"]))
        self.assertIn("{boost: doc.boost || 1}", (folder / "worker.js").read_text())
        script = """
            const lunr = require(process.argv[1] + "/lunr.js"), {docs, config} = require(process.argv[1] + "/search_index.json");
            lunr.tokenizer.separator = new RegExp(config.separator);
            const index = lunr(function () { for (const field of ["title", "text"]) this.field(field); this.ref("location");
              for (const doc of docs) this.add(doc, {boost: doc.boost || 1}); });
            console.log(JSON.stringify(process.argv.slice(2).map(words => index.search(words)[0].ref)));"""
        words = ("Slurm", "salt", "elastic thickness", "sandbox", "mica", "weakening", "damping", "pause")
        found = json.loads(subprocess.run(["node", "-e", script, folder.resolve(), *words], check=True, stdout=subprocess.PIPE, text=True).stdout)
        self.assertEqual([place for place in found if place.startswith(("record/", "CHANGELOG/"))], [])

    def test_buttons_have_names_and_the_film_a_still(self):
        for page, text in self.pages.items():
            for button in re.findall(r"<button\b[^>]*navbar-toggler[^>]*>", text):
                self.assertIn("aria-label=", button, page)
        home = self.pages[Path("index.html")]
        self.assertRegex(home, r'<input type="checkbox" id="stop-film">.*class="moving">.*lis1.webp.*class="still">.*lis1-still.webp')
        self.assertLess((self.site / "pictures/lis1-still.webp").stat().st_size, 150_000)

    def test_asks_no_other_host(self):
        files = [file for file in self.site.rglob("*") if file.suffix in (".html", ".css")]
        self.assertTrue([file for file in files if file.suffix == ".css"])
        for file in files:
            for target in fetched(file.read_text()):
                with self.subTest(f"{file.relative_to(self.site)}: {target}"):
                    self.assertNotRegex(target, r"^(?:\w+:)?//")

    def test_has_what_its_pages_fetch_and_link(self):
        for page, text in self.pages.items():
            if page.name == "404.html":
                continue  # its links are from the host's root
            for target in fetched(text) + [to for to, _ in LINKED.findall(text)]:
                if re.match(r"[a-z]+:|#", target):
                    continue
                file = Path(self.site, page).parent / target.partition("?")[0]
                with self.subTest(f"{page}: {target}"):
                    self.assertTrue(file.is_file() or Path(file, "index.html").is_file())

    def test_a_click_shows_a_picture_at_its_size(self):
        page = next(text for name, text in self.pages.items() if name.parts[:2] == ("explain", "cost-of-accuracy"))
        self.assertRegex(page, r'<a href="([^"]*pictures/accuracy/grain-10km.webp)"><img [^>]*src="\1"')

    def test_has_what_its_styles_fetch(self):
        for style in self.site.rglob("*.css"):
            for target in fetched(style.read_text()):
                with self.subTest(f"{style.relative_to(self.site)}: {target}"):
                    file = re.sub(r"[?#].*", "", target)
                    self.assertTrue(target.startswith("data:") or Path(style.parent, file).is_file())

    def test_formulas_are_set(self):
        cycle = self.pages[Path("theory/cycle/index.html")]
        self.assertGreater(cycle.count("<math "), 20)
        for page, text in self.pages.items():
            shown = re.sub(r"<(pre|code|script)\b.*?</\1>", "", text, flags=re.DOTALL)
            self.assertNotRegex(shown, r"\$\$|\\frac|\\mathbf|[\ue000\ue001]", page)

    def test_formulas_are_such_as_github_sets_too(self):
        # There a backslash before a sign is Markdown's and is gone before TeX; \operatorname is refused.
        for page in SOURCES.glob("docs/theory/*.md"):
            self.assertNotRegex(page.read_text(), r"\\(?:[^A-Za-z\s]|operatorname)", page.name)


class OnAPhone(Browsed):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.site = Path(folder.name, "site")
        assert build(SOURCES, cls.site).returncode == 0
        cls.driver = browser(folder.name, 390, 800)
        cls.addClassCleanup(cls.driver.quit)
        cls.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 390, "height": 800, "deviceScaleFactor": 2, "mobile": True})

    def go(self, page):
        self.driver.get(f"file://{self.site / page / 'index.html'}")

    def test_no_page_is_wider_than_the_screen(self):
        for page in (".", "theory/cycle", "theory/elastic-base", "theory/genesis", "reference/parameters", "start/drawing", "explain/validation"):
            self.go(page)
            self.assertEqual(self.script("return document.documentElement.scrollWidth;"), 390, page)

    def test_the_film_stops(self):
        self.go(".")
        shown = "const of = name => getComputedStyle(document.querySelector(`.film .${name}`)).display !== 'none'; return [of('moving'), of('still')];"
        self.assertEqual(self.script(shown), [True, False])
        self.script("document.getElementById('stop-film').click(); return 0;")
        self.assertEqual(self.script(shown), [False, True])
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]})
        self.go(".")
        self.assertEqual(self.script(shown), [False, True])


class BrokenSite(unittest.TestCase):
    def broken(self, page, text, **environment):
        """What mkdocs says of a copy of the sources with something added to a page."""
        environment = environment or {"LISTRIC": str(PROGRAM)}
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder, "sources")
            shutil.copytree(SOURCES / "docs", copy / "docs")
            for name in ("mkdocs.yml", "CONTRIBUTING.md", "CHANGELOG.md"):
                shutil.copy(SOURCES / name, copy / name)
            for name in ("tests", "apps", "dem", "fem", "coupling"):
                (copy / name).symlink_to(SOURCES / name)
            with open(copy / "docs" / page, "a") as file:
                file.write(text)
            built = build(copy, Path(folder, "site"), **environment)
        self.assertNotEqual(built.returncode, 0, built.stdout)
        return built.stdout

    def test_a_dead_link(self):
        self.assertIn("no-such-page.md", self.broken("index.md", "\n[x](no-such-page.md)\n"))

    def test_no_program(self):
        self.assertIn("./listric scenes", self.broken("index.md", "", LISTRIC=""))

    def test_a_formula_that_is_none(self):
        self.assertIn("ParseError", self.broken("theory/index.md", "\n$\\frac{1$\n"))


if __name__ == "__main__":
    unittest.main()
