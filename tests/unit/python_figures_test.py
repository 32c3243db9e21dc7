#!/usr/bin/python3
"""Tests of the figure scripts' functions; no picture is compared.

Usage: tests/unit/python_figures_test.py
"""
import contextlib
import io
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "apps/figures/python"))
import plot

import numpy as np
from PIL import Image

import animation
import axes
import base
import caption
import discs
import effects
import figures
import footwall
import frame as frames
import isostasy
import journal
import laboratory
import page
import panels
import picture
import scales
import script
import sections
import sheet
import study
import vocabulary
import wells

META = {"scene": "lis1", "title": "a title", "extension_m": 2000.0, "time_a": 2e5,
        "level_m": -100.0, "right_wall_x_m": 4000.0, "strata": 2, "strain_end": 0.2,
        "strain_window_m": 500.0}
WATER = {"name": "layer_water", "kind": "band", "label": "water", "ink": "#c6dcef"}
SHORE = {"name": "layer_shore", "kind": "line", "label": "old shore", "ink": "#00ff00"}
MARKED = {"name": "layer_marked", "kind": "discs", "label": "marked", "ink": "#ff0000"}
ARRAYS = {
    "discs_x": [500.0, 1500.0, 2500.0, 3500.0], "discs_y": [-500.0, -500.0, -500.0, -100.0],
    "discs_radius": [400.0, 400.0, 400.0, 100.0], "discs_stratum": [0, 0, 1, 2],
    "discs_start_depth": [500.0, 1500.0, np.nan, np.nan],
    "discs_shear_strain": [0.0, 0.1, 0.2, np.nan],
    "detachment": [[0.0, 0.0], [1000.0, -1000.0], [4000.0, -1000.0]],
}


class Folder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        Path(self.path(name)).write_text(text, encoding="utf-8")
        return self.path(name)

    def frame(self, meta=(), **arrays):
        """The frame of META and ARRAYS with these changed; None is left out."""
        folder = tempfile.mkdtemp(dir=self.folder)
        values = {key: value for key, value in {**META, **dict(meta)}.items() if value is not None}
        Path(folder, "frame.json").write_text(json.dumps(values), encoding="utf-8")
        for name, array in {**ARRAYS, **arrays}.items():
            np.save(os.path.join(folder, name + ".npy"), np.array(array))
        return frames.load_frame(folder)


def png_of(kind, bits, levels):
    """A PNG of three equal rows: each of its samples has the level of its column, opacity is whole. A palette is grey."""
    samples, top = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind], 2**bits - 1
    row = "".join(f"{top if kind in (4, 6) and s == samples - 1 else level:0{bits}b}" for level in levels for s in range(samples))
    rows = (b"\0" + int(row, 2).to_bytes(len(row) // 8, "big")) * 3

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    palette = chunk(b"PLTE", bytes(255 * k // top for k in range(top + 1) for _ in range(3))) if kind == 3 else b""
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", len(levels), 3, bits, kind, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + palette + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Underlay(Folder):
    def test_its_corners_fall_on_their_pixels(self):
        pixels = np.ones((20, 40, 3))
        colours = {(0, 0): (1, 0, 0), (0, -1): (0, 1, 0), (-1, 0): (0, 0, 1), (-1, -1): (1, 0, 1)}
        for (row, column), colour in colours.items():
            rows, columns = (slice(0, 4) if k == 0 else slice(-4, None) for k in (row, column))
            pixels[rows, columns] = colour
        plot.matplotlib.image.imsave(self.path("section.png"), pixels)
        # 1 to 3 km of a section from 0 to 4 km, 200 to 800 m deep.
        corners = [1000.0, 200.0, 3000.0, 800.0]
        frame = self.frame(meta={"underlay": {"image": self.path("section.png"),
                                              "corners_m": corners}},
                           horizons=[[0, 0.0, -900.0], [0, 500.0, -900.0]],
                           detachment=[[0.0, 0.0], [10.0, -1000.0], [4000.0, -1000.0]])
        self.assertIn("underlay", sections.figures_of(frame))
        figure = sections.draw_figure(frame, ["underlay"], dpi=100)
        figure.canvas.draw()
        pixels = np.asarray(figure.canvas.buffer_rgba())
        ax = figure.axes[0]
        for (row, column), colour in colours.items():
            x = (1.02, 2.98)[column]
            y = (-0.21, -0.79)[row]
            across, up = ax.transData.transform((x, y))
            found = pixels[pixels.shape[0] - 1 - int(up), int(across), :3] / 255.0
            np.testing.assert_allclose(found, colour, atol=0.1)
            # Just outside there is nothing of it.
            across, up = ax.transData.transform((x + (-0.06, 0.06)[column], y))
            found = pixels[pixels.shape[0] - 1 - int(up), int(across), :3] / 255.0
            self.assertGreater(np.abs(found - colour).max(), 0.3)

    def test_what_is_no_picture_is_refused(self):
        frame = self.frame(meta={"underlay": {"image": self.write("section.png", "no picture"),
                                              "corners_m": [0.0, 0.0, 1.0, 1.0]}},
                           horizons=[[0, 0.0, -900.0]])
        with self.assertRaisesRegex(plot.InputError, "section.png"):
            sections.draw_figure(frame, ["underlay"])
        Image.fromarray(np.zeros((50, 50), np.uint8)).save(self.path("whole.png"))
        whole = Path(self.path("whole.png")).read_bytes()
        for broken in (b"", whole[:40], whole[:60]):
            Path(self.path("section.png")).write_bytes(broken)
            with self.assertRaisesRegex(plot.InputError, "section.png"):
                picture.read_picture(self.path("section.png"))

    def test_a_grey_picture_keeps_its_greys(self):
        ramp = np.linspace(64, 191, 12).round().astype(np.uint8)   # not from black to white
        grey = Image.fromarray(np.tile(ramp, (8, 1)))
        kinds = {"8": grey, "16": Image.fromarray(np.tile(ramp.astype(np.uint16) * 257, (8, 1))),
                 "alpha": grey.convert("LA"), "palette": grey.convert("P"), "rgb": grey.convert("RGB"),
                 "1": grey.point(lambda value: 255 * (value > 127)).convert("1", dither=0)}
        for name, one in kinds.items():
            one.save(self.path("section.dat"), format="png")    # known by what it is
            found = picture.read_picture(self.path("section.dat"))[0] / 255.0
            self.assertIn(found.shape, ((8, 12, 3), (8, 12, 4)), name)
            wanted = ramp / 255.0 if name != "1" else (ramp > 127).astype(float)
            for channel in range(3):
                np.testing.assert_allclose(found[3, :, channel], wanted, atol=0.01, err_msg=name)
            drawn = self.frame(meta={"underlay": {"image": self.path("section.dat"),
                                                  "corners_m": [1000.0, 200.0, 3000.0, 800.0]}},
                               horizons=[[0, 0.0, -900.0]])
            figure = sections.draw_figure(drawn, ["underlay"], dpi=60)
            figure.canvas.draw()
            pixels = np.asarray(figure.canvas.buffer_rgba())
            across, up = figure.axes[0].transData.transform((1.0 + 2.0 * 5.5 / 12.0, -0.5))
            pixel = pixels[pixels.shape[0] - 1 - int(up), int(across), :3]
            np.testing.assert_allclose(pixel / 255.0, [wanted[5]] * 3, atol=0.03, err_msg=name)

    def test_every_bit_depth_of_png_reaches_from_black_to_white(self):
        """PNG, second edition, table 11.1: greys of 1 to 16 bits, colours and opacity of 8 and 16, palettes of 1 to 8."""
        width = 64
        for kind, depths in ((0, (1, 2, 4, 8, 16)), (2, (8, 16)), (3, (1, 2, 4, 8)), (4, (8, 16)), (6, (8, 16))):
            for bits in depths:
                top = 2**bits - 1
                levels = [top * x // (width - 1) for x in range(width)]
                Path(self.path("ramp.png")).write_bytes(png_of(kind, bits, levels))
                found = picture.read_picture(self.path("ramp.png"))[0] / 255.0
                self.assertEqual(found.shape, (3, width, 4 if kind in (4, 6) else 3), (kind, bits))
                for channel in range(3):   # to a step of 8 bits, to which Pillow reduces colours of 16
                    np.testing.assert_allclose(found[1, :, channel], np.array(levels) / top, atol=1 / 255, err_msg=f"{kind}, {bits}")
                if kind in (4, 6):
                    np.testing.assert_array_equal(found[:, :, 3], 1.0)

    def test_it_is_no_larger_than_where_it_is_drawn(self):
        ramp = Image.fromarray(np.tile(np.linspace(0, 255, 800).round().astype(np.uint8), (600, 1)))
        for name, one, form in (("grey", ramp, "png"), ("jpeg", ramp.convert("RGB"), "jpeg"), ("rgba", ramp.convert("RGBA"), "png"),
                                ("16", Image.fromarray(np.asarray(ramp).astype(np.uint16) * 257), "png")):
            one.save(self.path("section.dat"), format=form)
            found, part = picture.read_picture(self.path("section.dat"), size=(100.0, 60.0))
            self.assertEqual((found.shape[:2], found.dtype, part), ((60, 100), np.uint8, (0.0, 0.0, 1.0, 1.0)), name)
            np.testing.assert_allclose(found[30, ::33, 0], np.linspace(0, 255, 100)[::33], atol=4, err_msg=name)
            found, part = picture.read_picture(self.path("section.dat"), part=(0.5, 0.25, 0.75, 0.5))   # all of its pixels
            self.assertEqual((found.shape[:2], part), ((150, 200), (0.5, 0.25, 0.75, 0.5)), name)
            self.assertAlmostEqual(float(found[0, 0, 0]), 127.7, delta=2)

    def test_a_figure_of_too_many_dots_is_refused_with_those_that_fit(self):
        with self.assertRaisesRegex(plot.InputError, r"500 x 300 mm at 2400 dpi has 1,339 million pixels.*--dpi 655 or less"):
            plot.new_figure(500 / 25.4, 300 / 25.4, 2400)
        plot.new_figure(500 / 25.4, 300 / 25.4, 655)

    def test_a_photograph_is_turned_as_its_camera_says(self):
        lying = np.zeros((16, 32, 3), np.uint8)
        lying[:, 16:] = (255, 128, 0)                        # dark left, orange right
        exif = Image.Exif()
        exif[0x0112] = 6                                     # the camera was turned: clockwise by 90 degrees
        Image.fromarray(lying).save(self.path("photo.png"), format="jpeg", quality=95, exif=exif)
        found = picture.read_picture(self.path("photo.png"))[0] / 255.0  # known by what it is
        self.assertEqual(found.shape, (32, 16, 3))
        np.testing.assert_allclose(found[4, 8], (0, 0, 0), atol=0.03)
        np.testing.assert_allclose(found[28, 8], (1, 128 / 255, 0), atol=0.03)
        whole = Path(self.path("photo.png")).read_bytes()
        Path(self.path("photo.png")).write_bytes(whole[:-40])
        with self.assertRaisesRegex(plot.InputError, "photo.png: cannot be read as PNG or JPEG"):
            picture.read_picture(self.path("photo.png"))


class Reading(Folder):
    def test_a_table_has_an_array_per_column(self):
        table = plot.read_table(self.write("t.csv", "x,y\n1,2\n3,4\n"))
        np.testing.assert_array_equal(table["x"], [1.0, 3.0])
        np.testing.assert_array_equal(table["y"], [2.0, 4.0])

    def test_a_table_without_rows_is_refused_unless_it_may_be_empty(self):
        path = self.write("t.csv", "x,y\n")
        with self.assertRaisesRegex(plot.InputError, "an empty table"):
            plot.read_table(path)
        self.assertEqual(len(plot.read_table(path, may_be_empty=True)["y"]), 0)

    def test_words_and_ragged_rows_are_no_table(self):
        for text in ("x,y\n1,two\n", "x,y\n1,2\n3\n"):
            with self.assertRaisesRegex(plot.InputError, "not a table of numbers"):
                plot.read_table(self.write("t.csv", text))
        for text in ("x,y\n1,2\n3\n", "x,y\n1,2\n3,4,5\n"):
            with self.assertRaisesRegex(plot.InputError, "t.csv: line 3 has more or fewer fields than the head"):
                plot.read_rows(self.write("t.csv", text))
        self.assertEqual(plot.read_rows(self.write("t.csv", 'x,y\n"a, b",\n')), [{"x": "a, b", "y": ""}])

    def test_a_missing_file_is_named(self):
        for read in (plot.read_table, plot.read_rows, plot.read_json):
            with self.assertRaisesRegex(plot.InputError, "none.csv: No such file"):
                read(self.path("none.csv"))

    def test_json_must_be_an_object(self):
        with self.assertRaisesRegex(plot.InputError, "not a JSON object"):
            plot.read_json(self.write("a.json", "[1]"))
        with self.assertRaisesRegex(plot.InputError, "not valid JSON"):
            plot.read_json(self.write("a.json", "{"))


class Scripts(Folder):
    def fails_with(self, main, arguments, usage="script.py DIR"):
        """Exit status and the line on stderr."""
        said = io.StringIO()
        with mock.patch.object(sys, "argv", ["script.py", *arguments]), \
                contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as end:
            plot.run(main, usage)
        return end.exception.code, said.getvalue()

    def test_a_wrong_number_of_arguments_is_answered_by_the_usage(self):
        self.assertEqual(self.fails_with(lambda _: None, []),
                         (2, "script.py: usage: script.py DIR\n"))

    def test_an_error_is_one_line(self):
        def main(_):
            raise OSError("disk\nfull")
        self.assertEqual(self.fails_with(main, ["a"]), (4, "script.py: OSError: disk full\n"))

    def test_the_exit_status_says_what_failed(self):
        for failure, status in ((plot.InputError("bad"), 2), (MemoryError(), 4), (KeyError("x"), 70)):
            self.assertEqual(self.fails_with(mock.Mock(side_effect=failure), ["a"])[0], status)
        with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit) as end:
            script.library("no_such_library")
        self.assertEqual(end.exception.code, 69)
        self.assertIn("cannot import no_such_library", said.getvalue())

    def test_an_interrupt_is_no_error(self):
        def main(_):
            raise KeyboardInterrupt
        self.assertEqual(self.fails_with(main, ["a"]), (130, ""))

    def test_a_figure_is_written_whole_or_not_at_all(self):
        path = plot.save(plot.new_figure(1, 1, 20), self.path("new"), "picture")
        self.assertEqual(os.listdir(self.path("new")), ["picture.png"])
        self.assertEqual(path, self.path("new/picture.png"))
        figure = mock.Mock(**{"findobj.return_value": []})
        figure.savefig.side_effect = lambda name, **_: Path(name).write_text("half") and 1 / 0
        with self.assertRaises(ZeroDivisionError):
            plot.save(figure, self.path("new"), "other")
        self.assertEqual(os.listdir(self.path("new")), ["picture.png"])

    def test_words_in_brackets_may_be_left_out(self):
        for arguments in (["a"], ["a", "b"]):
            with mock.patch.object(sys, "argv", ["script.py", *arguments]):
                main = mock.Mock()
                plot.run(main, "script.py DIR [ORDER]")
                main.assert_called_once_with(*arguments)
        self.assertEqual(self.fails_with(mock.Mock(), ["a", "b", "c"], "script.py DIR [ORDER]")[0],
                         2)
        with mock.patch.object(sys, "argv", ["script.py", "a", "b", "c"]):
            main = mock.Mock()
            plot.run(main, "script.py DIR [NAME]...")
            main.assert_called_once_with("a", "b", "c")

    def test_an_order_is_refused_if_it_is_none(self):
        for text in ("png", "[]", '{"formats": ["png"]}'):
            with self.assertRaisesRegex(plot.InputError, "not an order"):
                plot.read_order(text)

    def test_figures_refuses_what_it_cannot_draw(self):
        with self.assertRaisesRegex(plot.InputError, "sections|experiment|animation|gallery"):
            figures.main("other", self.folder, self.folder)
        with self.assertRaisesRegex(plot.InputError, "no such directory"):
            figures.main("sections", self.path("none"), self.folder)
        with self.assertRaisesRegex(plot.InputError, "holds no frames"):
            figures.main("sections", self.folder, self.folder)


class Formats(Folder):
    ORDER = plot.read_order('{"formats": ["png", "pdf", "svg"], "software": "Listric 0.2.0+abc",'
                            ' "provenance": {"scene_hash": "0123456789abcdef", "seed": 3}}')

    def saved(self, name):
        """The files of a figure of discs, by format."""
        figure = sections.draw_figure(self.frame(), ["strata"])
        plot.save(figure, self.path(name), "strata", self.ORDER)
        return {path.suffix[1:]: path.read_bytes() for path in Path(self.path(name)).iterdir()}

    def test_equal_figures_are_equal_files_and_tell_their_origin(self):
        one = self.saved("one")
        with mock.patch.dict(os.environ, {"SOURCE_DATE_EPOCH": "1000000000"}):
            self.assertEqual(self.saved("two"), one)
        self.assertEqual(set(one), {"png", "pdf", "svg"})
        for name, content in one.items():
            for said in (b"Listric 0.2.0+abc", b"0123456789abcdef"):
                self.assertIn(said, content, name)

    def test_no_format_depends_on_those_before_it(self):
        def saved(*formats):
            figure = plot.new_figure(3, 2, 50)
            figure.set_layout_engine("constrained")
            section, profile = figure.subplots(2, 1, height_ratios=(1.5, 1.0))
            section.set_aspect("equal")
            section.set_xlim(0.0, 3.0)
            figure.colorbar(plot.matplotlib.cm.ScalarMappable(), ax=section, shrink=0.8)
            profile.plot([0.0, 1000.0], label="1 km")
            profile.legend()
            folder = self.path("-".join(formats))
            plot.save(figure, folder, "plot", plot.Order(formats))
            return {path.suffix: path.read_bytes() for path in Path(folder).iterdir()}

        every = saved("svg", "pdf", "png")
        for name in ("png", "pdf", "svg"):
            self.assertEqual(saved(name)["." + name], every["." + name], name)

    def test_discs_are_an_image_and_text_is_text(self):
        tree = xml.etree.ElementTree.fromstring(self.saved("one")["svg"])
        space = "{http://www.w3.org/2000/svg}"
        self.assertEqual(len(tree.findall(f".//{space}image")), 1)
        self.assertIn("Distance from the breakaway (km)",
                      [text.text for text in tree.iter(f"{space}text")])

    def test_an_image_in_a_pdf_has_hard_edges_and_the_figure_keeps_its_own(self):
        def colours(file_format):
            with plot.plain_images(figure, file_format):
                figure.canvas.draw()
                return len(np.unique(np.asarray(figure.canvas.buffer_rgba()).reshape(-1, 4), axis=0))

        figure = plot.new_figure(1, 1, 20)
        figure.add_artist(plot.LineCollection([[(0, 0), (1, 0.7)]], colors="black",
                                              rasterized=True))
        soft = colours("png")
        self.assertGreater(soft, 5)
        self.assertEqual(colours("pdf"), 2)
        self.assertEqual(colours("png"), soft)


class Frames(Folder):
    def test_lengths_are_kilometres(self):
        frame = self.frame(bonded=[[1000.0, 2000.0, 3000.0, 4000.0, 1.0]],
                           faults=[[7.0, 1000.0, -2000.0, 0.5]])
        np.testing.assert_allclose(frame.x, [0.5, 1.5, 2.5, 3.5])
        np.testing.assert_allclose(frame.bonded, [[1.0, 2.0, 3.0, 4.0, 1.0]])
        np.testing.assert_allclose(frame.faults, [[7.0, 1.0, -2.0, 0.5]])
        self.assertEqual((frame.extension, frame.wall, frame.strata), (2.0, 4.0, 2))

    def test_what_a_run_does_not_know_is_none(self):
        frame = self.frame()
        for name in ("behaviour", "bonded", "profile", "faults"):
            self.assertIsNone(getattr(frame, name), name)
        self.assertEqual(frame.layers, ())

    def test_the_target_level_is_there_where_the_frame_has_it(self):
        self.assertEqual(self.frame().level, -0.1)
        self.assertIsNone(self.frame({"level_m": None}).level)

    def test_where_the_surface_is_left_alone_the_level_is_no_target(self):
        for meta, words in (({}, "target level of sediments"), ({"surface_rests": True}, "regional (target level before)")):
            [ax, _] = sections.draw_figure(self.frame(meta), ["strata"], 20).axes
            self.assertIn(words, [text.get_text() for text in ax.get_legend().get_texts()])

    def test_a_target_line_is_drawn_where_it_is(self):
        line = [[1000.0, 200.0], [3000.0, -300.0]]
        frame = self.frame(target_line=line)
        figure = sections.draw_figure(frame, ["strata"], dpi=50)
        drawn = [artist.get_xydata() for axes in figure.axes for artist in axes.lines
                 if artist.get_color() == panels.LEVEL_BLUE]
        self.assertEqual(len(drawn), 1)
        np.testing.assert_allclose(drawn[0][1:-1], np.array(line) / 1000.0)
        self.assertEqual(drawn[0][0, 1], 0.2)
        self.assertGreater(frame.view[3], self.frame().view[3])

    def scaled(self, factor, meta=()):
        """A frame of that size over the one of a model 1 km thick; a wall at 4 km there."""
        arrays = {name: (factor * np.array(ARRAYS[name])).tolist() for name in ARRAYS
                  if name not in ("discs_stratum", "discs_shear_strain")}
        return self.frame({"right_wall_x_m": 4000.0 * factor, "level_m": -100.0 * factor,
                           "extension_m": 2000.0 * factor, **dict(meta)}, **arrays)

    def test_the_view_holds_all_discs_and_the_detachment(self):
        frame = self.scaled(15.0)
        np.testing.assert_allclose(frame.view, (-1.0, 60.5, -15.6, 0.5), rtol=1e-12)
        self.assertAlmostEqual(frame.span, 61.5)
        self.assertAlmostEqual(frame.rise, 16.1)

    def test_margins_are_a_share_of_the_model(self):
        large = self.scaled(15.0)
        for factor in (1e-4, 0.015, 1.5):
            np.testing.assert_allclose(np.array(self.scaled(factor).view) / factor, np.array(large.view) / 15.0, rtol=0.01)

    def test_a_model_of_centimetres_has_numbers_on_its_axes(self):
        [ax, _] = sections.draw_figure(self.scaled(1e-4), ["strata"], dpi=50).axes
        ax.figure.canvas.draw()
        self.assertEqual([label.get_text() for label in ax.get_yticklabels()][1:-1], ["0.1", "0.08", "0.06", "0.04", "0.02", "0"])
        self.assertEqual([label.get_text() for label in ax.get_xticklabels()][1:-1], ["0", "0.1", "0.2", "0.3", "0.4"])
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("Distance from the breakaway (m)", "Depth (m)"))
        [ax, _] = sections.draw_figure(self.scaled(15.0), ["strata"], dpi=50).axes
        self.assertEqual((ax.get_xlabel(), ax.get_ylabel()), ("Distance from the breakaway (km)", "Depth (km)"))

    def test_what_a_thin_model_has_is_not_flat(self):
        profile = {"profile": [[0.05, -0.01, np.nan], [0.2, -0.04, 0.04], [0.35, -0.01, 0.01]]}
        tops = {"tops": [[0.0, 0.0, 0.0, -0.03], [0.0, 0.0, 0.3, -0.01]]}
        for panel, arrays in (("sediment", profile), ("inversion", tops)):
            frame = self.frame({"right_wall_x_m": 0.4, "level_m": -0.01},
                               **{name: (1e-4 * np.array(ARRAYS[name])).tolist() for name in
                                  ("discs_x", "discs_y", "discs_radius", "discs_start_depth", "detachment")}, **arrays)
            low, high = sections.draw_figure(frame, [panel], dpi=50).axes[0].get_ylim()
            self.assertLess(high - low, 1e-4, panel)   # km

    def test_steps_of_axes_are_plain_numbers(self):
        self.assertEqual([axes.plain_step(x) for x in (1.0, 1.01, 2.3, 7.0, 0.5, 30.0)], [1.0, 2.0, 5.0, 10.0, 0.5, 50.0])
        np.testing.assert_allclose([axes.plain_step(x) for x in (1.9e-5, 3e-7)], [2e-5, 5e-7])

    def test_bad_numbers_of_the_frame_are_named(self):
        for key, value in (("time_a", None), ("time_a", "1"), ("strata", True),
                           ("extension_m", float("nan")), ("level_m", "0"), ("scene", 1),
                           ("strain_end", 0)):
            with self.assertRaisesRegex(plot.InputError, key):
                self.frame({key: value})

    def test_bad_arrays_are_named(self):
        for name, value, problem in (
                ("discs_y", [1.0], "discs_y.npy has 1 values, discs_x.npy 4"),
                ("discs_behaviour", [1], "discs_behaviour.npy has 1 values"),
                ("discs_behaviour", [0, 1, 2, 5], "unknown class"),
                ("discs_radius", [1.0, 1.0, 0.0, 1.0], "not positive"),
                ("discs_x", [np.nan] * 4, "not finite"),
                ("discs_x", [[1.0]], "expected one dimension"),
                ("discs_stratum", [0, 0, 0, 10_001], "10,000 strata"),
                ("detachment", [[0.0, 0.0]], "at least two points"),
                ("layer_water", [[0.0, 0.0]], "expected 3 columns"),
                ("layer_marked", [1.0], "layer_marked.npy has 1 values")):
            declared = [layer for layer in (WATER, MARKED) if name == layer["name"]]
            with self.assertRaisesRegex(plot.InputError, problem):
                self.frame({"layers": declared}, **{name: value})

    def test_behaviour_is_what_the_frame_says(self):
        frame = self.frame(discs_behaviour=np.array([3, 2, 1, 0], dtype=np.int32))
        np.testing.assert_array_equal(frame.behaviour, [3, 2, 1, 0])


class Scales(Folder):
    def test_ticks_of_strain_are_plain_numbers(self):
        np.testing.assert_allclose(scales.strain_ticks(0.12), [0.0, 0.03, 0.06, 0.09, 0.12])
        np.testing.assert_allclose(scales.strain_ticks(0.15), [0.0, 0.05, 0.1, 0.15])
        np.testing.assert_allclose(scales.strain_ticks(10.0), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0])

    def test_about_eight_strata_are_numbered(self):
        self.assertEqual(scales.stratum_ticks(1), [1])
        self.assertEqual(scales.stratum_ticks(4), [1, 2, 3, 4])
        self.assertEqual(scales.stratum_ticks(40), [1, 5, 10, 15, 20, 25, 30, 35, 40])

    def test_every_stratum_has_its_colour(self):
        for count in (1, 2, 6, 50):
            self.assertEqual(len(np.unique(vocabulary.stratum_colours(count), axis=0)), count)

    def test_younger_strata_are_lighter_and_paraview_has_their_colours(self):
        text = Path(script.__file__).with_name("paraview.py").read_text(encoding="utf-8")
        names = {"LOOK": {**vocabulary.VOCABULARY, "rows": vocabulary.VOCABULARY["palettes"]
                          [vocabulary.VOCABULARY["strata"]["palette"]]["rows"]}}
        exec(text[text.index("def layer_colour"):text.index("def colour_by_layer")], names)
        for count in (1, 2, 5, 6, 20, 21):
            colours = vocabulary.stratum_colours(count)
            np.testing.assert_allclose(colours, [names["layer_colour"](k + 1, count) for k in range(count)])
            self.assertTrue((np.diff(colours[::2] @ (0.2126, 0.7152, 0.0722)) > 0.0).all())
        np.testing.assert_allclose(vocabulary.layer_colours(np.array([0.5, 1.5, 2.5])),
                                   [names["layer_colour"](k, 20) for k in (-1, -2, -3)])

    def test_paraview_tells_rock_above_the_surface_from_sediment(self):
        text = Path(script.__file__).with_name("paraview.py").read_text(encoding="utf-8")
        names = {"LOOK": vocabulary.VOCABULARY}
        exec(text[text.index("def layer_formula"):text.index("def colour_by_layer")], names)
        formula = names["layer_formula"]().replace("if(", "choose(")

        def layer(stratum, depth):
            return eval(formula, {"choose": lambda condition, yes, no: yes if condition else no, "max": max,
                                  "floor": math.floor, "stratum": stratum, "start_depth_m": depth})

        self.assertEqual([layer(0, depth) for depth in (-1500.0, -20.0, 0.0, 999.0, 1000.0)], [-1, -1, -1, -1, -2])
        self.assertEqual(layer(3, 0.0), 3)

    def test_frames_share_the_largest_scale(self):
        first = self.frame({"strata": 0}, discs_stratum=[0] * 4)
        first.strain_end = 1.0
        second = self.frame()
        scales.share_scales([first, second])
        self.assertEqual((first.strata, second.strata), (2, 2))
        self.assertEqual((first.strain_end, second.strain_end), (1.0, 1.0))
        scales.share_scales([first], 0.5)
        self.assertEqual(first.strain_end, 0.5)

    def test_strain_is_light_where_nothing_happens(self):
        lightness = vocabulary.palette(vocabulary.VOCABULARY["scale"]["palette"]) @ (0.2126, 0.7152, 0.0722)
        self.assertGreater(lightness[0], 0.95)
        self.assertTrue((np.diff(lightness) < 0.01).all())
        self.assertLess(lightness[-1], 0.1)


class Drawing(Folder):
    def test_a_legend_does_not_run_into_the_description(self):
        frame = self.frame()
        for description, labels in (("Shear strain without compaction, last 500 m of extension", 4), ("Rock", 9), ("Rock", 2)):
            ax = plot.new_figure(8.4, 3, 50).subplots()
            axes.describe(ax, frame, description, [(axes.swatch("#ffffff"), f"weakened rock {k}") for k in range(labels)])
            (title,), legend = ax.texts, ax.get_legend()
            self.assertFalse(title.get_window_extent().overlaps(legend.get_window_extent()), (description, labels))

    def test_depth_has_a_true_minus_and_no_minus_zero(self):
        self.assertEqual([axes.depth_text(y) for y in (-5.0, 0.0, -1e-12, 2.5)],
                         ["5", "0", "0", "−2.5"])

    def test_extension_has_two_decimals_only_where_one_is_not_enough(self):
        self.assertEqual(page.extension_text(self.frame()), "2.0")
        self.assertEqual(page.extension_text(self.frame({"extension_m": 2250.0})), "2.25")

    STAGES = ({"extension_m": 5000.0, "way_m": 5000.0, "extension_km": "5.0"},
              {"extension_m": 1000.0, "way_m": 9000.0, "extension_km": "9.0"})   # 5 km out, 4 km back

    def test_headlines_tell_the_way_from_the_extension(self):
        after = ["5 km of net extension after 5.0 km of wall motion", "1 km of net extension after 9.0 km of wall motion"]
        frames_ = [self.frame(meta) for meta in self.STAGES]
        self.assertEqual([page.moment_text(frame) for frame in frames_], after)
        [headline] = [text.get_text() for text in sheet.draw_sheet(frames_).texts if text.get_text().startswith("a title")]
        self.assertEqual(headline, f"a title: {page.timed_text(frames_[0])} and {page.timed_text(frames_[1])}")
        for least in (-0.0116, 0.0, 0.0093):    # 3 km out and back, to half a cycle
            there = self.frame({"extension_m": least, "way_m": 6000.0, "extension_km": "6.0"})
            self.assertEqual(page.moment_text(there), "0 km of net extension after 6.0 km of wall motion")
        plain = [self.frame({"extension_m": 1000.0 * km}) for km in (5.0, 10.0)]
        self.assertIn("a title: 5.0 and 10.0 km of extension", [text.get_text() for text in sheet.draw_sheet(plain).texts])
        columns = {name: [1.0, 2.0] for name in ("depth_m", *(line[0] for _, lines in wells.PANELS for line in lines))}
        paused = self.frame({"extension_m": 5000.0, "way_m": 12000.0, "wall_m": 5000.0, "extension_km": "12.0", "time_a": 60e6})
        self.assertEqual(page.timed_text(paused), "5 km of extension, 60.00 Myr")    # a pause is no motion of the wall
        paused = self.frame({"extension_m": 1000.0, "way_m": 12000.0, "wall_m": 9000.0, "extension_km": "12.0"})
        self.assertEqual(page.moment_text(paused), "1 km of net extension after 9 km of wall motion")
        well = {"scene": "lis1", "time_a": 2e6, "wells": [{"name": "depocentre", "x_m": 100.0, "columns": columns}]}
        self.assertEqual(wells.draw({**well, **self.STAGES[1]}).texts[0].get_text(), f"LIS1, {after[1]}, 2.00 Myr")
        self.assertEqual(wells.draw({**well, "extension_km": "2.0"}).texts[0].get_text(), "LIS1, 2.0 km of extension, 2.00 Myr")

    def test_wells_have_the_panels_of_what_they_have(self):
        columns = {"depth_m": [100.0, 200.0], "temperature_c": [20.0, 30.0], "max_temperature_c": [20.0, 30.0],
                   "vitrinite_percent": [0.2, 0.3], "porosity": [0.4, 0.3]}
        frame = {"scene": "lis1", "extension_km": "2.0", "time_a": 0.0, "wells": [{"name": "flank", "x_m": 100.0, "columns": columns}],
                 "profiles": [{"label": "heat flow", "unit": "mW/m2", "x_m": [0.0, 1e3], "values": [50.0, 60.0]}]}
        drawn = wells.draw(frame)
        self.assertEqual([ax.get_xlabel() for ax in drawn.axes],
                         ["Distance from the breakaway (km)", "Temperature (°C)", "Vitrinite reflectance (%)", "Porosity"])
        self.assertEqual(drawn.axes[0].get_ylabel(), "Heat flow (mW/m²)")
        frame["profiles"][0]["values"] = [50.0]
        with self.assertRaisesRegex(wells.InputError, "of one length"):
            wells.draw(frame)
        with self.assertRaisesRegex(wells.InputError, "the columns of a panel"):
            wells.draw({**frame, "wells": [{"name": "flank", "x_m": 100.0, "columns": {"depth_m": [1.0]}}]})

    def test_small_models_are_told_in_metres_as_on_their_axes(self):
        meta = {"extension_m": 0.012, "extension_km": "0.000012", "end_a": 4.0, "interval_a": 0.4, "time_a": 1.2, "right_wall_x_m": 0.4,
                "level_m": 0.0}
        small = {name: (1e-4 * np.array(ARRAYS[name])).tolist() for name in ("discs_x", "discs_y", "discs_radius", "detachment")}
        frame = self.frame(meta, **small)
        self.assertEqual(page.headline(frame), "a title: 0.012 m, 1.2 a")
        self.assertEqual(page.moments_text([frame, self.frame({**meta, "extension_km": "0.000016"}, **small)]),
                         "0.012 and 0.016 m of extension")
        self.assertEqual(page.extension_text(frame), "0.000012")     # as in names of files
        back = self.frame({**meta, "way_m": 0.02, "extension_m": 0.0043, "extension_km": "0.00002"}, **small)
        self.assertEqual(page.timed_text(back), "0.0043 m of net extension after 0.02 m of wall motion, 1.2 a")
        self.assertIn("After 0.012 m of extension at 1 cm/yr (1.2 a): ", caption.caption(["bonds"], None, frame, plot.Order()))

    def test_times_are_years_in_short_runs_and_tell_neighbours_apart(self):
        for times, gap, end, texts in (
                ([350.0], 350.0, 9999.0, "350 a"), ([350.0], math.inf, 350.0, "350 a"), ([0.0], 50e3, 1e6, "0.00 Myr"),
                ([5e5, 1e6], 5e4, 1e6, "0.50 1.00 Myr"), ([1.125e6], 7.5e4, 1.125e6, "1.12 Myr"), ([9.99e3], 9.99e3, 1e6, "0.01 Myr"),
                ([6e3, 12e3], 6e3, 12e3, "0.006 0.012 Myr"), ([1.2, 1.6], 0.4, 4.0, "1.2 1.6 a"), ([400.0], 2.0, 1e6, "0.000400 Myr")):
            with self.subTest(times=times):
                self.assertEqual(page.time_texts(times, gap, end), (texts.split()[:-1], texts.split()[-1]))
        frame = self.frame({"time_a": 350.0, "end_a": 700.0, "interval_a": 350.0})
        for told in (page.headline(frame), page.timed_text(frame), caption.caption(["bonds"], None, frame, plot.Order())):
            self.assertIn("350 a", told)
        self.assertTrue(page.headline(self.frame({"time_a": 2.06e5, "interval_a": 6e3, "end_a": 1e6})).endswith(", 0.206 Myr"))
        self.assertTrue(page.headline(self.frame()).endswith(", 0.20 Myr"))

    def test_ages_of_strata_tell_neighbours_apart(self):
        for ages, end, label, wanted in (([6e3, 12e3], 1e6, "Laid down at (Myr)", ["0.006", "0.012"]), ([120.0, 240.0], 350.0, "Laid down at (a)", ["120", "240"]),
                                         ([49_998.7, 99_999.1], 1e6, "Laid down at (Myr)", ["0.05", "0.10"])):
            [_, cax] = sections.draw_figure(self.frame({"strata_a": ages, "end_a": end}), ["strata"], 20).axes
            self.assertEqual((cax.get_ylabel(), [tick.get_text() for tick in cax.get_yticklabels()]), (label, wanted))

    def test_paraview_tells_times_as_the_figures_do(self):
        text = Path(script.__file__).with_name("paraview.py").read_text(encoding="utf-8")
        names = {}
        exec(text[text.index("def time_format"):text.index("def main")], names)
        for years in ([0.0, 5e4, 1e5], [0.0, 175.0, 350.0], [0.0, 6e3, 12e3], [350.0], [5e5], [0.0, 0.4, 0.8]):
            told, factor = names["time_format"]([year / 1e6 for year in years])
            gap = min(np.diff(years), default=math.inf)
            [wanted], unit = page.time_texts(years[-1:], gap, years[-1])
            self.assertEqual(told.format(time=factor * years[-1] / 1e6), f"{wanted} {unit}")

    def test_letters_go_on_after_z(self):
        self.assertEqual([page.letter(n) for n in (0, 25, 26, 27, 51, 52, 701, 702)], ["a", "z", "aa", "ab", "az", "ba", "zz", "aaa"])
        many = [self.frame({"extension_m": 1000.0 * n}) for n in range(14)]
        words = [text.get_text() for ax in sheet.draw_sheet(many).axes for text in ax.texts]
        self.assertLessEqual({"z", "aa", "ab"}, set(words))
        self.assertIn("(aa) intact bonds", caption.caption(["bonds"] * 27, None, many[0], plot.Order(width_mm=85.0)))

    def test_a_row_of_sections_has_one_text_and_one_legend(self):
        early = self.frame({"extension_m": 0.0, "strata": 0}, discs_stratum=[0] * 4)
        shown = [early, self.frame({"extension_m": 700.0}), self.frame(), self.frame()]
        figure = sheet.draw_sheet(shown)
        words = [text.get_text() for text in figure.texts]
        self.assertIn("Pre-rift layers (a); Syn-rift strata (b, c, d)", words)
        self.assertIn("Shear strain, since the start (e); Shear strain, 0 to 0.5 km of extension (f); "
                      "Shear strain, last 500 m of extension (g, h)", words)
        self.assertEqual(len(figure.legends), 2)                     # a row each
        self.assertIn("Syn-rift strata", [text.get_text() for text in sheet.draw_sheet(shown[1:]).texts])
        figure.canvas.draw()
        boxes = [text.get_window_extent() for text in figure.texts] + [legend.get_window_extent() for legend in figure.legends]
        self.assertEqual([(n, m) for n, one in enumerate(boxes) for m in range(n) if one.overlaps(boxes[m])], [])

    def test_classes_of_slip_rates_are_shares_of_the_walls(self):
        faults = [[k, 1000.0 * k, -100.0 * n, rate] for k, rate in enumerate((0.02, 0.07, 0.3)) for n in (1, 2)]
        for rate, words in ((0.01, ["slip < 0.5 mm/a", "slip 0.5–1 mm/a", "slip > 1 mm/a"]),
                            (0.001, ["slip < 0.05 mm/a", "slip 0.05–0.1 mm/a", "slip > 0.1 mm/a"]),
                            (0.0002, ["slip < 0.01 mm/a", "slip 0.01–0.02 mm/a", "slip > 0.02 mm/a"])):
            frame = self.frame({"rate_m_per_a": rate}, faults=[[*row[:3], 1000.0 * rate * row[3]] for row in faults])
            [ax, *_] = sections.draw_figure(frame, ["strain"], 20).axes
            legend = [text.get_text() for text in ax.get_legend().get_texts()]
            self.assertEqual([text for text in legend if text.startswith("slip")], words)

    def test_the_window_of_strain_has_its_own_ends(self):
        for meta, words in (({}, "last 500 m of extension"), ({"extension_m": 2000.02}, "last 500 m of extension"),
                            ({"extension_m": 1999.98}, "last 500 m of extension"),
                            ({"extension_m": 2300.0}, "1.5 to 2 km of extension"),
                            ({"extension_m": 499.0}, "since the start"), ({"extension_m": 0.0}, "since the start"),
                            ({"extension_m": 300.0, "strain_until_m": 0.0}, "since the start"),
                            ({"extension_m": 2000.0, "strain_until_m": 1500.0}, "1 to 1.5 km of extension"),
                            ({"extension_m": 1000.0, "way_m": 9000.0}, "last 500 m of the way"),
                            ({"extension_m": 1000.0, "way_m": 9100.0}, "8.5 to 9 km of the way")):
            frame = self.frame(meta, faults=[[0.0, 1000.0, -500.0, 2.0], [0.0, 1500.0, -900.0, 2.0]])
            self.assertEqual(page.window_text(frame), words, meta)
        [ax, _] = sections.draw_figure(frame, ["strain"], 20).axes
        self.assertIn(f"Shear strain, {words}", [text.get_text() for text in ax.texts])
        told = caption.caption(["strain"], None, frame, plot.Order())
        self.assertIn(f"maximum shear strain, {words}.", told)
        self.assertIn("faults active since the previous snapshot", told)   # which may be any way before

    def test_strain_says_what_it_is_without(self):
        for remark in (" without settling", " with settling", None):
            frame = self.frame({"strain_remark": remark})
            [ax, _] = sections.draw_figure(frame, ["strain"], 20).axes
            self.assertIn(f"Shear strain{remark or ''}, last 500 m of extension", [text.get_text() for text in ax.texts])
            self.assertIn(f"maximum shear strain{remark or ''}, last 500 m of extension",
                          caption.caption(["strain"], None, frame, plot.Order()))

    def test_weakened_rock_of_no_fault_has_a_colour_of_its_own(self):
        frame = self.frame(discs_behaviour=np.array([0, 2, 4, 4], dtype=np.int32))
        figure = sections.draw_figure(frame, ["behaviour"], 20)
        labels = [text.get_text() for legend in figure.legends + [ax.get_legend() for ax in figure.axes] if legend
                  for text in legend.get_texts()]
        self.assertIn("weakened elsewhere", labels)
        self.assertNotIn("unconsolidated sediment", labels)   # there is none

    def test_the_footer_says_what_was_computed(self):
        frame = self.frame({"accuracy": "draft", "seed": 3, "effects": ["one", "two"],
                            "mean_radius_m": 186.2})
        self.assertEqual(page.footer(frame), ["scene lis1  ·  4 discs, mean radius 186 m  ·  "
                                              "accuracy draft  ·  seed 3  ·  effects: one, two"])
        self.assertIn("effects: none", page.footer(self.frame({"effects": []}))[0])

    def test_a_long_description_loses_its_source_then_what_follows_its_colon_then_words(self):
        def shown(title):
            return page.title_of(self.frame({"title": title}))
        short = "LIS1: 90-degree listric detachment, 10 km of extension [paper, experiment I]"
        self.assertEqual(shown(short), short.removesuffix(" [paper, experiment I]"))
        self.assertEqual(shown("RFR: ramp, flat at 7 km and second ramp, 10 km of extension [paper, experiment III]"),
                         "RFR: ramp, flat at 7 km and second ramp, 10 km of extension")
        self.assertEqual(shown("LIS1 filled with mud: " + 8 * "overpressure "), "LIS1 filled with mud")
        self.assertEqual(shown(8 * "overpressure "), " ".join(6 * ["overpressure"]) + "…")

    def test_a_headline_with_a_long_moment_fits_on_the_page(self):
        title = "Inversion of LIS2: 5 km of extension, then 4 km of shortening"
        frame = self.frame({"title": title, "extension_m": 4600.0, "way_m": 5400.0, "extension_km": "5.4"})
        figure = sections.draw_figure(frame, ["strata"], 20)
        headline = next(text for text in figure.texts if text.get_weight() == "bold")
        self.assertTrue(headline.get_text().startswith("Inversion of LIS2: 4.6 km of net extension after"))
        self.assertLess(headline.get_window_extent().x1, figure.bbox.x1)
        self.assertIn(title, page.footer(frame)[0])   # in full

    def test_a_section_has_equal_scales_and_fits(self):
        frame = self.frame()
        width, height = page.panel_size(frame)
        self.assertAlmostEqual(width / height, frame.span / frame.rise)
        self.assertLessEqual(height, page.MAX_PANEL_HEIGHT)
        self.assertLessEqual(width, page.PANEL_WIDTH + 1e-9)

    def test_an_image_shows_the_disc_that_covers_a_cell(self):
        frame = self.frame(discs_radius=[20.0] * 4)
        owner = discs.owner_map(frame)
        self.assertEqual(set(np.unique(owner)), {-1, 0, 1, 2, 3})
        cell = frame.span / owner.shape[1]
        for index, (x, y) in enumerate(zip(frame.x, frame.y)):
            self.assertEqual(owner[int((frame.view[3] - y) / cell), int((x - frame.view[0]) / cell)], index)

    def test_lines_are_painted_from_end_to_end(self):
        image = np.zeros((10, 10, 4), dtype=np.uint8)
        discs.paint_lines(image, np.array([[0.5, 9.5, 9.5, 9.5]]), "#ffffff", 0.0, 10.0, 1.0)
        self.assertTrue((image[0] == 255).all())
        self.assertTrue((image[1:] == 0).all())

    def test_layers_change_colour_with_start_depth(self):
        rgb = vocabulary.layer_colours(np.array([0.5, 1.5, 2.5, np.nan]))
        np.testing.assert_array_equal(rgb[0], rgb[2])
        np.testing.assert_array_equal(rgb[0], rgb[3])
        self.assertTrue((rgb[0] != rgb[1]).any())

    def test_a_curve_is_cut_where_it_jumps(self):
        curve = np.array([[0.0, 0.0], [0.1, 0.0], [2.0, 0.0], [2.1, 0.0], [5.0, 0.0]])
        self.assertEqual([len(piece) for piece in panels.pieces(curve, 0.5)], [2, 2])

    def test_labels_are_moved_below_each_other(self):
        self.assertEqual(panels.free_height([], 0.0, -1.0, 2.0, 0.5), -1.0)
        self.assertEqual(panels.free_height([(0.5, -1.0)], 0.0, -1.0, 2.0, 0.5), -1.5)
        self.assertEqual(panels.free_height([(3.0, -1.0)], 0.0, -1.0, 2.0, 0.5), -1.0)

    def test_kinematics_are_drawn_where_they_are_known(self):
        overview = ["strata", "bonds", "behaviour", "strain", "sediment"]
        self.assertEqual(list(sections.figures_of(self.frame())), [*overview, "overview"])
        known = sections.figures_of(self.frame(predicted_shear=[[0.0, 0.0], [1.0, 1.0]]))
        self.assertEqual(list(known), [*overview, "kinematics", "overview"])
        self.assertEqual(known["overview"], overview)

    def test_tops_after_a_turn_are_drawn_against_the_regional(self):
        tops = [[0.0, 0.0, 0.0, -800.0], [0.0, 0.0, 3000.0, -200.0], [1.0, 1.0, 0.0, -100.0], [1.0, 1.0, 3000.0, 600.0],
                [-1.0, 2.0, 0.0, -2400.0], [-1.0, 2.0, 3000.0, -1900.0]]  # heights above the regional
        meta = {"level_m": -100.0, "said": ["null point: laid down at 1.23 km of extension"]}
        frame = self.frame(meta, tops=tops)
        self.assertEqual(sections.figures_of(frame)["inversion"], ["strata", "inversion"])
        self.assertNotIn("inversion", sections.figures_of(self.frame()))
        [ax, _] = sections.draw_figure(frame, ["inversion"], 20).axes
        heights = sorted(tuple(line.get_ydata()) for line in ax.lines if len(line.get_ydata()) == 2)
        np.testing.assert_allclose(heights, [(-2.4, -1.9), (-0.8, -0.2), (-0.1, 0.6), (0.0, 0.0)], atol=1e-9)
        self.assertIn("null point: laid down at 1.23 km of extension", "\n".join(text.get_text() for text in ax.texts))
        self.assertIn("Null point: laid down at 1.23 km of extension.",
                      caption.caption(["inversion"], None, frame, plot.Order(software="Listric 9")))

    def test_every_figure_can_be_drawn_of_little_and_of_much(self):
        much = {"layer_marked": [0.0, 1.0, 0.5, 0.0], "discs_behaviour": np.array([0, 2, 1, 1], dtype=np.int32),
                "bonded": [[500.0, -500.0, 1500.0, -500.0, 0.0]],
                "faults": [[0.0, 1000.0, -500.0, 2.0], [0.0, 1500.0, -900.0, 2.0]],
                "profile": [[1000.0, -200.0, np.nan], [2000.0, -400.0, 400.0]],
                "depocentres": [[2000.0, 400.0, 300.0]],
                "layer_water": [[0.0, -50.0, 0.0], [4000.0, -50.0, 0.0]],
                "layer_shore": [[0.0, -50.0], [4000.0, -150.0]],
                "predicted_shear": [[0.0, 0.0], [4000.0, -300.0]],
                "predicted_normals": [[0.0, 0.0], [300.0, -300.0]],
                "tops": [[0.0, 0.0, 0.0, -900.0], [0.0, 0.0, 3000.0, -300.0]]}
        for arrays in ({}, much):
            meta = {"layers": [WATER, SHORE, MARKED] if arrays else []}
            frame = self.frame(meta, **arrays)
            known = [name for name in panels.PANELS if name not in ("underlay", "seismic", "seismic-depth")]
            self.assertEqual(len(sections.draw_figure(frame, known, 20).axes), 14)
            rows = 4 if arrays else 2
            self.assertEqual(len(sheet.draw_sheet([frame, self.frame(meta, **arrays)]).axes), 4 * rows)


    def test_layers_of_effects_are_drawn_by_their_kind(self):
        frame = self.frame({"layers": [WATER, SHORE, MARKED]}, layer_marked=[0.0, 1.0, 0.0, 0.0],
                           layer_water=[[0.0, -50.0, 300.0], [4000.0, -50.0, 300.0]],
                           layer_shore=[[0.0, -1300.0], [4000.0, -1300.0]],
                           detachment=[[0.0, 0.0], [1000.0, -2000.0], [4000.0, -2000.0]],
                           bonded=[[500.0, -500.0, 1500.0, -500.0, 0.0]])
        for panel, places in (("strata", {WATER["ink"]: (2.0, 0.03), SHORE["ink"]: (2.0, -1.3)}),
                              ("bonds", {MARKED["ink"]: (1.5, -0.7)})):
            figure = sections.draw_figure(frame, [panel], dpi=100)
            figure.canvas.draw()
            pixels = np.asarray(figure.canvas.buffer_rgba())
            for ink, place in places.items():
                across, up = figure.axes[0].transData.transform(place)
                found = pixels[pixels.shape[0] - 1 - int(up), int(across), :3] / 255.0
                np.testing.assert_allclose(found, plot.matplotlib.colors.to_rgb(ink), atol=0.3)   # edges are soft
            legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
            labels = {layer["label"] for layer in (WATER, SHORE, MARKED) if layer["ink"] in places}
            self.assertLessEqual(labels, set(legend))

    def test_flow_of_water_is_a_mean_of_squares_of_four_discs(self):
        x = [100.0, 900.0, 100.0, 900.0, 7100.0, 7900.0, 7100.0]    # squares of 1 km; the second has three discs
        y = [-100.0, -100.0, -900.0, -900.0, -100.0, -100.0, -900.0]
        per_s = 1.0 / frames.MM_PER_A
        frame = self.frame({"layers": [{"name": "layer_overpressure", "kind": "discs", "label": "overpressure ratio", "ink": "#b71c1c",
                                        "arrows": "flow of water"}]},
                           layer_overpressure=[0.5] * 7, discs_x=x, discs_y=y, discs_radius=[400.0] * 7, discs_stratum=[1] * 7,
                           discs_start_depth=[float("nan")] * 7, discs_shear_strain=[0.0] * 7,
                           layer_overpressure_arrows=[[k * per_s, per_s] for k in range(7)])
        frame.view = (0.0, 40.0, -5.0, 0.0)
        np.testing.assert_allclose(panels.mean_velocities(frame, frame.layers[0].arrows), [[0.5, -0.5, 1.5, 1.0]])
        figure = sections.draw_figure(frame, ["layer-overpressure"], dpi=60)
        legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        self.assertIn("flow of water, up to 1.8 mm/a (lengths by its root)", legend)
        marked = {**MARKED, "arrows": "drift"}
        still = self.frame({"layers": [marked]}, layer_marked=[0.5] * 4, layer_marked_arrows=np.zeros((0, 2)))
        self.assertIsNone(still.layers[0].arrows)
        self.assertEqual(len(panels.mean_velocities(still, None)), 0)
        with self.assertRaisesRegex(plot.InputError, "layer_marked_arrows.npy has 1 rows, discs_x.npy 4"):
            self.frame({"layers": [marked]}, layer_marked=[0.5] * 4, layer_marked_arrows=[[0.0, 0.0]])

    def test_a_users_words_are_no_formulas(self):
        space = "{http://www.w3.org/2000/svg}"
        all_words = ("from $PROJ\\north\\line12 to $OUT", "$WORK_/lis and ${HOME}^/lis",
                     "$\\alpha_{fault$ plane", "costs $5 and $6", "a \\$ b", "<&>")
        draws = (lambda frame: sections.draw_figure(frame, ["kinematics"], 20),
                 lambda frame: sheet.draw_sheet([frame]), lambda frame: sheet.draw_gallery([frame]),
                 lambda frame: sheet.draw_multiples([frame]))
        with mock.patch.object(sheet, "ON_SHEET", ("kinematics",)), \
                mock.patch.object(sheet, "IN_GALLERY", ("kinematics",)):
            for k, words in enumerate(all_words):
                frame = self.frame(meta={"title": words, "scene": "a$b_c$"})
                for draw in draws if k == 0 else draws[:1]:
                    plot.save(draw(frame), self.folder, "words", plot.Order(("svg",)))
                    tree = xml.etree.ElementTree.parse(self.path("words.svg"))
                    text = " ".join("".join(node.itertext()) for node in tree.iter(f"{space}text"))
                    self.assertIn(words, " ".join(text.split()))

    def test_characters_that_no_font_has_are_blanks(self):
        frame = self.frame(meta={"title": "a\x1b[31mb\u202ec\nd"})
        plot.save(sections.draw_figure(frame, ["strain"], 20), self.folder, "x", plot.Order(("svg",)))
        self.assertIn("a [31mb c d", Path(self.path("x.svg")).read_text(encoding="utf-8"))

    def test_powers_of_ten_are_plain_text(self):
        figure = plot.new_figure(3, 3, 40)
        ax = figure.subplots()
        ax.plot([1e-6, 2e3], [3.0, 8.0])
        ax.set(xscale="log", yscale="log")
        plot.name_powers(ax)
        figure.draw_without_rendering()
        labels = {text.get_text() for text in ax.get_xticklabels() + ax.get_yticklabels(which="both")}
        self.assertLess({"10²", "4×10⁰"}, labels)
        self.assertTrue([label for label in labels if label.startswith("10⁻")])  # which, Matplotlib decides
        self.assertFalse([label for label in labels if "$" in label])


PRINTED = {"profile": [[1000.0, -200.0, np.nan], [2000.0, -400.0, 400.0], [3000.0, -300.0, 300.0]],
           "depocentres": [[2000.0, 400.0, 300.0]],
           "discs_behaviour": np.array([0, 2, 1, 3], dtype=np.int32),
           "bonded": [[500.0, -500.0, 1500.0, -500.0, 0.0]],
           "predicted_shear": [[0.0, 0.0], [4000.0, -300.0]],
           "predicted_normals": [[0.0, 0.0], [300.0, -300.0]],
           "tops": [[0.0, 0.0, 0.0, -900.0], [0.0, 0.0, 30000.0, -300.0], [1.0, 1.0, 0.0, -200.0], [1.0, 1.0, 30000.0, 500.0]],
           "faults": [[0.0, 1000.0, -500.0, 2.0], [0.0, 1500.0, -900.0, 2.0]],
           "seismic": np.outer(np.ones(40), np.sin(np.linspace(0, 20, 50))), "seismic_axes": [50.0, 100.0, 0.0, 25.0, 0.02, 0.0],
           "seismic_depth": np.outer(np.ones(40), np.sin(np.linspace(0, 20, 50))),
           "seismic_depth_axes": [50.0, 100.0, 0.0, 25.0, 20.0, 0.0]}
ALL_PANELS = ("strata", "bonds", "behaviour", "strain", "sediment", "kinematics", "inversion", "seismic", "seismic-depth")


def texts(figure):
    """Texts that are seen, with their boxes in pixels."""
    figure.draw_without_rendering()
    renderer = figure.canvas.get_renderer()
    shown = [text for text in figure.findobj(plot.matplotlib.text.Text) if text.get_visible() and text.get_text().strip()]
    off = [label for ax in figure.axes if not ax.axison for label in ax.findobj(plot.matplotlib.text.Text)]
    off += [label for ax in figure.axes if ax.axison for axis in (ax.xaxis, ax.yaxis) for tick in axis.get_major_ticks() + axis.get_minor_ticks()
            for label in (tick.label1, tick.label2) if not axis.get_view_interval().min() - 1e-9 <= tick.get_loc() <= axis.get_view_interval().max() + 1e-9]
    return [(text, text.get_window_extent(renderer)) for text in shown if text not in off and text.get_window_extent(renderer).width > 0]


class Print(Folder):
    def order(self, width, **words):
        return plot.Order(width_mm=width, dpi=200, provenance='{"commit": "abc", "scene_hash": "123"}', software="Listric 9", **words)

    def wide(self, **meta):
        """A frame of the shape of the shipped sections, which are three times as long as deep."""
        return self.frame({"right_wall_x_m": 40000.0, "strata_a": [50000.0, 100000.0], "mean_radius_m": 93.1, "seed": 1, "accuracy": "standard",
                           "title": "LIS1: 90-degree listric detachment, 10 km of extension", **meta}, **{
                               **PRINTED, "detachment": [[0.0, 0.0], [4000.0, -11000.0], [15000.0, -15000.0], [40000.0, -15000.0]]})

    def test_text_has_six_points_or_more_and_lies_on_the_page(self):
        with plot.matplotlib.rc_context(plot.STYLE):
            for width in (85.0, 180.0):
                for plain in (False, True) if width < 100.0 else (False,):
                    figure, said = journal.draw_print(self.wide(), ALL_PANELS, self.order(width, plain=plain))
                    self.assertAlmostEqual(25.4 * figure.get_size_inches()[0], width, 6)
                    self.assertEqual(len(said), len(ALL_PANELS))
                    seen, page_box = texts(figure), figure.bbox
                    self.assertGreater(len(seen), 60)
                    for text, box in seen:
                        self.assertGreaterEqual(text.get_fontsize(), 6.0, text.get_text())
                        self.assertLessEqual(text.get_fontsize(), 8.0, text.get_text())
                        for inner, outer in ((page_box.x0, box.x0), (page_box.y0, box.y0), (box.x1, page_box.x1), (box.y1, page_box.y1)):
                            self.assertLessEqual(inner, outer + 2.0, (width, text.get_text()))   # of 670 pixels
                    words = [text.get_text() for text, _ in seen]
                    self.assertLessEqual(set("abcdefghi"), set(words))
                    self.assertEqual("LIS1" in " ".join(words), not plain)

    def model(self, depth, **meta):
        """A frame of a model of that depth (m), 40 km long, with twenty strata and many depocentres."""
        ages = [50000.0 * (k + 1) for k in range(20)]
        return self.frame({"right_wall_x_m": 40000.0, "strata_a": ages, "strata": 20, "strain_end": 0.12, "mean_radius_m": 93.1, "seed": 1,
                           "accuracy": "standard", "strain_remark": " without compaction", "extension_m": 2250.0, **meta}, **{
                               **PRINTED, "discs_stratum": [0, 0, 10, 20], "discs_shear_strain": [0.0, 0.1, 0.51, np.nan],
                               "depocentres": [[x, 400.0, 300.0] for x in (2000.0, 9000.0, 9800.0, 31000.0)],
                               "detachment": [[0.0, 0.0], [0.3 * depth, -0.7 * depth], [depth, -depth], [40000.0, -depth]]})

    LONG = "A detachment picked from a line across the Northern North Sea, its name as long as descriptions of users' own sections are"

    def test_every_text_lies_on_the_page_and_none_over_another(self):
        for width in (85.0, 120.0, 180.0):
            for depth in (15000.0, 2500.0):
                for title, plain in ((self.LONG, False), ("LIS1", True)):
                    with self.subTest(width=width, depth=depth, plain=plain), plot.matplotlib.rc_context(plot.STYLE):
                        figure, _ = journal.draw_print(self.model(depth, title=title), ALL_PANELS, plot.Order(width_mm=width, plain=plain, dpi=144))
                        seen, page_box = texts(figure), figure.bbox
                        self.assertGreater(len(seen), 60)
                        outside = [text.get_text() for text, box in seen
                                   if box.x0 < page_box.x0 - 1 or box.y0 < page_box.y0 - 1 or box.x1 > page_box.x1 + 1 or box.y1 > page_box.y1 + 1]
                        self.assertEqual(outside, [])
                        over = [(one.get_text(), other.get_text()) for n, (one, box) in enumerate(seen) for other, other_box in seen[:n]
                                if min(box.x1, other_box.x1) - max(box.x0, other_box.x0) > 2 and
                                min(box.y1, other_box.y1) - max(box.y0, other_box.y0) > 2]   # of letters 16 pixels high
                        self.assertEqual(over, [])

    def test_what_is_not_at_equal_scales_says_so(self):
        figure, said = journal.draw_print(self.wide(), ("strata", "sediment"), self.order(85.0))
        self.assertIn("(no vertical exaggeration)", said[0])
        [told] = [text.get_text() for text, _ in texts(figure) if text.get_text().startswith("heights × ")]
        [ax] = [ax for ax in figure.axes if ax.axison and len(ax.lines) > 2 and ax.get_ylim()[0] > -5.0]
        (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
        box = ax.get_window_extent()
        true = box.height / (high - low) / (box.width / (right - left))
        self.assertAlmostEqual(float(told.split()[-1]), true, delta=0.051)
        self.assertIn(told, said[1])
        # A page's panels are narrow where the section is high.
        high = self.frame({"right_wall_x_m": 12000.0}, **{name: PRINTED[name] for name in ("profile", "tops")},
                          detachment=[[0.0, 0.0], [4000.0, -11000.0], [12000.0, -15000.0]])
        for frame in (self.wide(), high):
            for name in ("sediment", "inversion"):
                page_figure = sections.draw_figure(frame, [name], 50)
                told = " ".join(text.get_text() for text, _ in texts(page_figure))
                ax, box = page_figure.axes[0], page_figure.axes[0].get_window_extent()
                true = box.height / abs(np.diff(ax.get_ylim())[0]) / (box.width / abs(np.diff(ax.get_xlim())[0]))
                self.assertIn(f"heights × {true:.1f}", told)

    def test_captions_of_pages_tell_all_panels_and_their_scales(self):
        for only in ((), ("inversion", "sediment", "overview")):
            with mock.patch.object(sections, "save"):
                sections.save_sections([self.wide()], self.folder, self.order(0.0, only=only, caption=True))
            told = dict(re.findall(r"(\S+)-2\.0km-200dpi\n(.*)\n", Path(self.path("caption.txt")).read_text(encoding="utf-8")))
            self.assertRegex(told["inversion"], r"syn-rift strata .* \(no vertical exaggeration\); below it height above the regional .* \(heights × ")
            self.assertIn("Black lines: faults", told["inversion"])
            self.assertRegex(told["sediment"], r"mean over 1 km.*\(heights × ")
            self.assertEqual(told["overview"].count("; below it "), 4)

    def test_seismic_images_tell_their_polarity(self):
        for name in ("seismic", "seismic-depth"):
            ax = sections.draw_figure(self.wide(), [name], 20).axes[0]
            self.assertIn("rock below is harder", [text.get_text() for text in ax.get_legend().get_texts()])
            self.assertIn("Black: the rock below is harder.", caption.caption([name], None, self.wide(), self.order(0.0)))
            if name == "seismic-depth":   # the footwall's name can be read on the image
                [words] = [text for text in ax.texts if text.get_text() == "footwall"]
                self.assertEqual(words.get_bbox_patch().get_facecolor(), plot.matplotlib.colors.to_rgba(axes.FOOTWALL))

    def test_fonts_of_a_pdf_are_embedded(self):
        sections.save_sections([self.wide()], self.folder, self.order(85.0, formats=("pdf",), only=("strata", "strain")))
        [name] = [name for name in os.listdir(self.folder) if name.endswith(".pdf")]
        self.assertEqual(name, "strata-strain-2.0km-85mm-200dpi.pdf")
        text = Path(self.path(name)).read_bytes()
        self.assertEqual(text.count(b"/Type /FontDescriptor"), text.count(b"/FontFile2"))
        self.assertGreater(text.count(b"/FontFile2"), 0)
        self.assertNotIn(b"/Type3", text)

    def test_captions_tell_what_is_shown_and_how_it_was_made(self):
        order = self.order(0.0, only=("strata", "seismic"), caption=True, errors="Errors by recorded runs: tilt: 0.1.")
        sections.save_sections([self.wide()], self.folder, order)
        text, origin = (Path(self.path(name)).read_text(encoding="utf-8") for name in ("caption.txt", "origin.txt"))
        for words in ("strata-2.0km-200dpi\n", "seismic-2.0km-200dpi\n", "LIS1: 90-degree listric detachment", "0.20 Myr", "1 cm/yr", "Listric 9", "25 Hz",
                      "neither migration nor noise"):
            self.assertIn(words, text)
        for words in ("strata-2.0km-200dpi\n", "4 discs", "93.1 m", "seed 1", "commit abc", "scene hash 123", "Listric 9", "Wyllie", "tilt: 0.1"):
            self.assertIn(words, origin)
            self.assertNotIn("commit", text)
        self.assertNotIn("tilt", text)
        usual = caption.caption(journal.DEFAULT, ["x (no vertical exaggeration)"] * 2, self.wide(), self.order(85.0))
        self.assertLess(len(usual), 500)
        self.assertEqual(sorted(name for name in os.listdir(self.folder) if name.endswith(".png")),
                         ["seismic-2.0km-200dpi.png", "strata-2.0km-200dpi.png"])
        with self.assertRaisesRegex(plot.InputError, "none of kinematics; it has strata"):
            sections.save_sections([self.frame()], self.folder, self.order(0.0, only=("kinematics",)))

    def test_names_hold_options_and_captions_of_other_calls_stay(self):
        frame = self.wide(underlay={"image": "/a/line 7.png", "name": "line_7-0123abcd", "corners_m": [0.0, -500.0, 40000.0, 15000.0]})
        frame.horizons = np.array([[0.0, 0.0, -0.9], [0.0, 0.5, -0.9]])
        for width, words in ((0.0, {}), (0.0, {"plain": True}), (85.0, {}), (85.0, {"plain": True}), (85.5, {})):
            sections.save_sections([frame], self.folder, plot.Order(width_mm=width, only=("strata",), caption=True, **words))
        with mock.patch.object(panels, "read_picture", return_value=(np.ones((2, 2, 3)), (0.0, 0.0, 1.0, 1.0))):
            sections.save_sections([frame], self.folder, plot.Order(only=("underlay",), caption=True))
        names = {"strata-2.0km", "strata-2.0km-plain", "strata-2.0km-85mm", "strata-2.0km-85mm-plain", "strata-2.0km-85.5mm",
                 "underlay-2.0km-line_7-0123abcd"}
        self.assertEqual({name for name in os.listdir(self.folder) if name.endswith(".png")}, {f"{name}.png" for name in names})
        told = caption.read_captions(self.path("caption.txt"))
        self.assertEqual(set(told), names)
        self.assertIn("(line 7.png, x from 0 to 40000 m, depth from -500 to 15000 m)", told["underlay-2.0km-line_7-0123abcd"])
        os.remove(self.path("strata-2.0km-plain.png"))
        sections.save_sections([frame], self.folder, plot.Order(only=("strata",), caption=True))
        self.assertEqual(set(caption.read_captions(self.path("caption.txt"))), names - {"strata-2.0km-plain"})

    def test_a_seismic_image_begins_above_the_original_surface_where_rock_does(self):
        for name, first, interval in (("seismic", -0.4, 0.02), ("seismic-depth", -400.0, 20.0)):
            arrays = {name.replace("-", "_"): np.zeros((40, 50), np.float32),
                      name.replace("-", "_") + "_axes": [50.0, 100.0, first, 25.0, interval, 0.0]}
            [drawn] = sections.draw_figure(self.frame(**arrays), [name], dpi=50).axes[0].images
            ends = np.array([first + 49.5 * interval, first - 0.5 * interval])
            np.testing.assert_allclose(drawn.get_extent()[2:], ends if name == "seismic" else -ends / 1000.0, atol=1e-9)

    def test_harder_rock_below_is_dark_in_the_seismic_image(self):
        image = np.zeros((40, 50))
        image[:, 20], image[:, 35] = 1.0, -1.0
        frame = self.frame(seismic=image, seismic_axes=[50.0, 100.0, 0.0, 25.0, 0.02, 0.0])
        figure = sections.draw_figure(frame, ["seismic"], dpi=150)
        figure.canvas.draw()
        pixels = np.asarray(figure.canvas.buffer_rgba())[:, :, :3].mean(axis=2)
        grey = []
        for sample in (20, 28, 35):
            across, up = figure.axes[0].transData.transform((2.0, 0.02 * sample))
            grey.append(pixels[pixels.shape[0] - 1 - int(up), int(across)])
        self.assertLess(grey[0], 60)
        self.assertTrue(100 < grey[1] < 160, grey)
        self.assertGreater(grey[2], 215)


# Linear sRGB as somebody sees it who lacks one kind of cones (Machado, Oliveira & Fernandes 2009).
SEEN_BY = {
    "everybody": np.eye(3),
    "protanope": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranope": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanope": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}


def seen(colours, eye):
    """CIE L*a*b* of sRGB colours (n x 3, to 1)."""
    colours = np.atleast_2d(colours)
    linear = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    linear = np.clip(linear @ np.array(SEEN_BY[eye]).T, 0.0, 1.0)
    xyz = linear @ np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]).T
    ratio = xyz / np.array([0.9505, 1.0, 1.089])
    f = np.where(ratio > 0.008856, np.cbrt(ratio), 7.787 * ratio + 16 / 116)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


def least_difference(colours, eye):
    """Least colour difference (CIE 1976) of any two; 2.3 is just noticeable."""
    places = [seen(colour, eye)[0] for colour in colours]
    return min(np.linalg.norm(a - b) for n, a in enumerate(places) for b in places[:n])


class ColourBlind(unittest.TestCase):
    def test_order_of_every_palette_shows_in_lightness(self):
        for name in vocabulary.VOCABULARY["palettes"]:
            for eye in SEEN_BY:
                lightness = seen(vocabulary.palette(name), eye)[:, 0]
                steps = np.diff(lightness[::8])   # of 32 steps
                self.assertTrue((steps > 0.4).all() or (steps < -0.4).all(), (name, eye))
                self.assertGreater(abs(lightness[-1] - lightness[0]), 65.0, (name, eye))

    def test_classes_and_neighbours_differ(self):
        to_rgb = plot.matplotlib.colors.to_rgb
        for eye in SEEN_BY:
            self.assertGreater(least_difference([to_rgb(rock["colour"]) for rock in vocabulary.ROCK_CLASSES], eye), 20.0)
            self.assertGreater(least_difference([to_rgb(colour) for colour in vocabulary.LAYER_COLOURS], eye), 15.0)
            for strata in (5, 10, 20):
                places = seen(vocabulary.stratum_colours(strata), eye)
                self.assertGreater(np.linalg.norm(np.diff(places, axis=0), axis=1).min(), 2.3, (eye, strata))
            # Lines that are read against each other: the model's, and what was picked.
            self.assertGreater(least_difference([to_rgb(vocabulary.INKS[name]) for name in ("faults", "horizons", "picks")], eye), 35.0)


class Animation(Folder):
    def film(self, name, formats=("png",), frames=1):
        os.mkdir(self.path(name))
        with mock.patch.object(animation, "ANIMATION_DPI", 10), \
                mock.patch.object(animation, "SHOWN", ("strain",)):
            animation.save_animation([self.frame({"extension_m": 1000.0 * (n + 1)}) for n in range(frames)], self.path(name), plot.Order(formats))
        return sorted(os.listdir(self.path(name)))

    def test_a_gif_has_one_palette_and_dots_of_no_other_colour(self):
        self.assertEqual(self.film("gif", ("gif",), 3), ["animation-3.0km.gif"])
        with Image.open(self.path("gif/animation-3.0km.gif")) as film:
            self.assertEqual(film.n_frames, 3)
            footwall = []
            for n in range(film.n_frames):
                film.seek(n)
                pixels = np.asarray(film.convert("RGB"))
                corner = pixels[-40:-25, 20:60]   # footwall below the section, of one colour
                footwall.append(set(map(tuple, corner.reshape(-1, 3))))
        self.assertEqual(footwall[0], footwall[1])
        self.assertEqual(footwall[1], footwall[2])

    def test_every_picture_shows_what_any_of_them_shows(self):
        walls = (4000.0, 5500.0, 4500.0)   # out and back
        shown = [self.frame({"right_wall_x_m": wall}, discs_y=[-500.0, -500.0, -500.0, highest])
                 for wall, highest in zip(walls, (-100.0, 0.0, 500.0))]
        views = [frame.view for frame in shown]
        with mock.patch.object(animation, "ANIMATION_DPI", 10), mock.patch.object(animation, "SHOWN", ("strain",)):
            self.assertEqual(len(animation.draw_pictures(shown, self.folder)), 3)
        whole = (views[0][0], views[1][1], views[0][2], views[2][3])
        self.assertEqual([frame.view for frame in shown], [whole] * 3)

    def test_a_webp_holds_every_frame(self):
        self.assertEqual(self.film("webp", ("webp",), 3), ["animation-3.0km.webp"])
        with Image.open(self.path("webp/animation-3.0km.webp")) as film:
            self.assertEqual(film.n_frames, 3)

    @unittest.skipUnless(animation.shutil.which("ffmpeg"), "no ffmpeg")
    def test_the_name_of_a_folder_is_no_pattern(self):
        for name in ("slip-50%", "-y", "%d 'a\"\n:é"):
            self.assertEqual(self.film(name), ["animation-1.0km.mp4"], name)

    def test_without_ffmpeg_it_is_a_gif_and_one_that_fails_is_named(self):
        with mock.patch.object(animation.shutil, "which", lambda _: None):
            self.assertEqual(self.film("alone"), ["animation-1.0km.gif"])
            with self.assertRaisesRegex(plot.InputError, "--format mp4: needs ffmpeg"):
                self.film("film", ("mp4",))
        Path(self.path("ffmpeg")).write_text("#!/bin/sh\necho no encoder >&2\nexit 3\n")
        os.chmod(self.path("ffmpeg"), 0o755)
        with mock.patch.dict(os.environ, {"PATH": f"{self.folder}:{os.environ['PATH']}"}), \
                self.assertRaisesRegex(plot.InputError, "ffmpeg fails .no encoder, exit code 3."):
            self.film("failing")
        self.assertEqual(os.listdir(self.path("failing")), [])


class Surroundings(Folder):
    """Scripts do what they do whatever the caller has set."""

    def call(self, options, **changes):
        data, out = self.path("data"), self.path("out")
        if not os.path.isdir(data):
            os.makedirs(data)
            self.frame()   # in a folder of its own beside
            for name in os.listdir(self.folder):
                if name.startswith("tmp"):
                    os.rename(self.path(name), os.path.join(data, "0"))
        place = self.path("place")
        os.makedirs(place, exist_ok=True)
        for name in ("numpy.py", "json.py", "plot.py", "matplotlib.py", "csv.py", "script.py"):
            Path(place, name).write_text("raise SystemExit('wrong file')\n")
        Path(place, "matplotlibrc").write_text("text.usetex: True\naxes.formatter.use_locale: True\n"
                                               "backend: nonsense\nfigure.facecolor: red\n")
        program = Path(script.__file__).parent / "figures.py"
        given = {name: value for name, value in changes.items() if value is not None}
        with mock.patch.dict(os.environ, given):
            for name in changes.keys() - given.keys():
                del os.environ[name]
            return subprocess.run(["/usr/bin/python3", *options, program, "multiples", data, out],
                                  cwd=place, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  check=False)

    def pixels(self, folder):
        with Image.open(self.path(folder + "/multiples.png")) as image:
            return image.convert("RGB").tobytes()

    def test_nothing_of_them_is_seen(self):
        place = self.path("place")
        hostile = {"PYTHONSAFEPATH": "1", "PYTHONPATH": place, "PYTHONHOME": "/nowhere",
                   "PYTHONSTARTUP": "/nowhere", "PYTHONOPTIMIZE": "2", "PYTHONWARNINGS": "error",
                   "PYTHONIOENCODING": "ascii:strict", "MPLBACKEND": "module://nonsense",
                   "MATPLOTLIBRC": place, "MPLCONFIGDIR": "/dev/null/none", "LC_ALL": "de_DE.UTF-8",
                   "HOME": None, "MPLSTYLE": "dark_background"}
        ended = self.call(["-I", "-X", "utf8"], **hostile)
        self.assertEqual((ended.returncode, ended.stdout), (0, ""))
        figures.main("multiples", self.path("data"), self.path("plain"))
        self.assertEqual(self.pixels("out"), self.pixels("plain"))

    def test_called_by_hand_it_finds_its_modules(self):
        ended = self.call([], PYTHONSAFEPATH="1", LC_ALL="C")
        self.assertEqual((ended.returncode, ended.stdout), (0, ""))


class Effects(Folder):
    HEAD = "measure,term,effect,standard_error,degrees_of_freedom,p,low_95,high_95\n"

    def test_what_may_be_chance_is_pale_and_bars_are_of_95_percent(self):
        # Two and a half standard errors with one degree of freedom are nothing.
        self.write("effects.csv", self.HEAD + "m,a.x,-0.068,0.025,1,0.224,-0.386,0.25\n"
                                              "m,a.y,3,0.5,10,0.0001,1.9,4.1\nn,a.x,2,,,,,\n")
        measures = effects.load(self.folder)
        self.assertEqual([e.term for e in measures["m"]], ["a.y", "a.x"])
        self.assertEqual([e.is_clear for e in measures["m"]], [True, False])
        self.assertFalse(measures["n"][0].is_clear)
        figure = plot.new_figure(4, 3, 50)
        ax = figure.subplots()
        effects.draw_panel(ax, "m", measures["m"], {"a.x": "x", "a.y": "y"})
        colours = [plot.matplotlib.colors.to_hex(bar.get_facecolor()) for bar in ax.patches]
        self.assertEqual(colours, [effects.CLEAR, effects.UNCLEAR])
        ends = [segment[:, 0].tolist() for container in ax.containers[1::2]
                for segment in container[2][0].get_segments()]
        np.testing.assert_allclose(ends, [[1.9, 4.1], [-0.386, 0.25]])
        effects.main(self.folder)
        self.assertTrue(os.path.exists(self.path("effects.png")))


class SmallScripts(Folder):
    def test_moments_of_the_base_ascend_and_keep_their_nodes(self):
        self.write("base.csv", "extension_m,x_m,y_m,ux_m,uy_m\n"
                               "500,0,0,0,2\n500,9,-1,0,3\n0,0,0,0,0\n0,9,-1,0,0\n")
        clock, moments = base.load(self.folder)
        self.assertEqual((clock, list(moments)), ("extension", [0.0, 500.0]))
        np.testing.assert_array_equal(moments[500.0], [[0, 0, 0, 2], [9, -1, 0, 3]])

    def test_with_stages_moments_are_told_apart_by_the_travel(self):
        self.write("base.csv", "travel_m,extension_m,x_m,y_m,ux_m,uy_m\n400,400,0,0,0,2\n600,400,0,0,0,1\n")
        self.write("footwall.csv", "travel_m,extension_m,x_m,uplift_m\n400,400,-5,2\n600,400,-5,1\n")
        for reader in (base, footwall):
            clock, moments = reader.load(self.folder)
            self.assertEqual((clock, list(moments)), ("travel", [400.0, 600.0]))
            self.assertEqual([rows[0, -1] for rows in moments.values()], [2.0, 1.0])
        figure = base.draw(*base.load(self.folder))
        self.assertEqual(figure.axes[2].get_xlabel(), "travel, km")

    def test_a_base_that_does_not_deform_has_no_figure(self):
        self.write("base.csv", "extension_m,x_m,y_m,ux_m,uy_m\n")
        with self.assertRaisesRegex(plot.InputError, "does not deform"):
            base.load(self.folder)

    def test_a_run_of_a_kilometre_ends_at_1_km(self):
        self.assertEqual([plot.moment_label(way, 999.9999) for way in (500.0, 999.9999)], ["0.5 km", "1.0 km"])
        self.assertEqual([plot.moment_label(way, 999.0) for way in (250.0, 999.0)], ["250 m", "999 m"])

    def test_about_five_moments_are_shown_and_the_last(self):
        self.assertEqual(base.shown([1.0, 2.0]), [1.0, 2.0])
        shown = base.shown([float(k) for k in range(21)])
        self.assertEqual(shown, [0.0, 4.0, 8.0, 12.0, 16.0, 20.0])

    def test_uplift_is_exaggerated_up_to_five_kilometres(self):
        self.assertEqual([footwall.exaggeration(m) for m in (1e4, 4e3, 500.0, 1.0)],
                         [1, 1, 10, 100])

    def test_a_section_of_a_footwall_ends_with_its_mesh(self):
        def patch(left, right, relaxed, top, bottom):
            corners = [v for x, y in ((left, bottom), (right, bottom), (right, top), (left, top))
                       for v in (x, y, 0.0, 1.0)]
            return [*corners, 1e6, 0.0, 0.0, relaxed]

        rows = np.array([[0.0, 1.0], [4000.0, -2.0]])  # none on the surface: a mesh with relief
        grains = np.array([[2000.0, -500.0, 60.0, 0.0, -500.0]])
        for reach, relaxed, left, right in ((30e3, 1.0, -30.0, 27.0), (90e3, 0.0, -60.0, 27.0),
                                            (9e3, 1.0, -9.0, 9.0)):
            patches = np.array([patch(-reach, reach, 0.0, 0.0, -1000.0),
                                patch(-reach, 0.5 * reach, relaxed, -1000.0, -6000.0)])
            axes = footwall.draw("extension", {40.0: rows}, patches, 1.0, grains).axes[0]
            self.assertEqual(axes.get_xlim(), (left, right))
            labels = {text.get_text(): text.get_position() for text in axes.texts}
            self.assertEqual("relaxed rock" in labels, relaxed > 0.0)
            if relaxed:
                self.assertAlmostEqual(labels["relaxed rock"][0], 0.5 * left)
                self.assertAlmostEqual(labels["relaxed rock"][1], -3.5)

    def test_runs_of_one_thickness_are_averaged_over_seeds(self):
        rows = [{"elastic_thickness_m": t, "uplift_m": u}
                for t, u in (("5000", "3"), ("2000", "1"), ("2000", "2"))]
        fill = isostasy.Fill("water", rows)
        self.assertEqual(fill.nominal, [2.0, 5.0])
        self.assertEqual(fill.uplift, [1.5, 3.0])
        self.assertEqual(fill.at("uplift_m", 2.0), [0.75, 1.5])

    def test_points_of_a_study_are_sorted_into_panels_and_curves(self):
        self.write("study.json", "{}")
        self.write("study.csv", "method,parameter,quantity,error,wall_s,disc_steps\n"
                                "A: fast,n=10,width,0,1,100\nA: fast,n=20,width,nan,2,104\n"
                                "slow,n=5,depth,0.5,1,0\n")
        _, found = study.load(self.folder)
        self.assertEqual({panel: list(curves) for panel, curves in found.items()},
                         {"A": [("fast", "width")], "": [("slow", "depth")]})
        first, second = found["A"]["fast", "width"]
        self.assertEqual((first["error"], first["work"]), (study.ZERO, 100.0))
        self.assertFalse(first["failed"])
        self.assertTrue(second["failed"])
        self.assertEqual(found[""]["slow", "depth"][0]["work"], 5.0)
        self.assertTrue(study.costs_the_same(found["A"]))
        self.assertFalse(study.costs_the_same({}))

    def test_a_curve_is_named_by_what_tells_it_from_the_others(self):
        self.assertEqual(study.curve_name("a", "q", {("a", "q"): []}), "a")
        self.assertEqual(study.curve_name("a", "q", {("a", "q"): [], ("b", "q"): []}), "a")
        self.assertEqual(study.curve_name("a", "q", {("a", "q"): [], ("a", "r"): []}), "q")
        self.assertEqual(study.curve_name("a", "q", {("a", "q"): [], ("b", "r"): []}), "a, q")


class Laboratory(Folder):
    def test_colours_go_from_light_to_dark(self):
        self.assertEqual(laboratory.colour(0, 1), laboratory.COLOURS[0])
        self.assertEqual(laboratory.colour(4, 5), laboratory.COLOURS[-1])

    def test_seeds_are_interpolated_where_they_have_rows(self):
        table = {"seed": np.array([1.0, 1.0, 2.0, 3.0]),
                 "shear_strain": np.array([0.0, 1.0, 0.0, 0.0])}
        values = np.array([0.0, 2.0, 7.0, 9.0])
        found = laboratory.by_strain(np.array([0.5]), table, values, table["seed"] < 3.0)
        np.testing.assert_allclose(found, [[1.0], [7.0]])

    def test_envelopes_are_read_where_they_are(self):
        self.write("envelopes.csv", "confining_pa,byerlee_axial_pa\n0,1\n2,3\n")
        np.testing.assert_array_equal(
            laboratory.envelopes(self.folder)["byerlee_axial_pa"], [1.0, 3.0])

    def test_what_is_no_laboratory_test_is_refused(self):
        self.write("summary.json", '{"test": "other"}')
        with self.assertRaisesRegex(plot.InputError, "not the summary of a laboratory test"):
            laboratory.load_summary(self.folder)


if __name__ == "__main__":
    unittest.main()
