"""An animation of a run: one picture per frame, all of one view."""
import os
import shutil
import subprocess
import tempfile
from collections.abc import Sequence

from frame import Frame, share_view
from page import extension_text
from plot import InputError, Order
from scales import share_scales
from sections import draw_figure

SHOWN = ("strata", "strain")
FILMS = ("mp4", "gif", "webp")
ANIMATION_DPI = 80
FRAME_MS, LAST_FRAME_MS = 250, 2000


def save_animation(frames: Sequence[Frame], folder: str, order: Order) -> None:
    """animation-<extension>km in the order's format; in none: .mp4 with ffmpeg, else .gif"""
    films = [kind for kind in order.formats if kind in FILMS]
    wanted = films[0] if films else "mp4" if shutil.which("ffmpeg") else "gif"
    if wanted == "mp4" and not shutil.which("ffmpeg"):
        raise InputError("--format mp4: needs ffmpeg, which is not installed; gif and webp need Pillow alone")
    with tempfile.TemporaryDirectory(dir=folder, prefix=".listric-") as temporary:
        pictures = draw_pictures(frames, temporary)
        path = make_mp4(temporary) if wanted == "mp4" else make_film(pictures, temporary, wanted)
        name = f"animation-{extension_text(frames[-1])}km" + os.path.splitext(path)[1]
        os.replace(path, os.path.join(folder, name))


def draw_pictures(frames: Sequence[Frame], folder: str) -> list[str]:
    """Paths of one PNG per frame."""
    share_scales(frames)
    share_view(frames)
    pictures = []
    for frame in frames:
        figure = draw_figure(frame, SHOWN, ANIMATION_DPI)
        pictures.append(os.path.join(folder, f"{len(pictures):05d}.png"))
        figure.savefig(pictures[-1])
        frame.owner = None     # large
    return pictures


def make_mp4(folder: str) -> str:
    """Film of the folder's numbered pictures; sides must be even. ffmpeg works within the folder,
    whose name it would take for a pattern or a protocol."""
    made = subprocess.run(
        ["ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-framerate", f"{1000 / FRAME_MS:g}",
         "-i", "%05d.png", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p",
         "animation.mp4"], cwd=folder, check=False, stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if made.returncode:
        said = made.stderr.decode(errors="replace").strip().splitlines() or ["no message"]
        raise InputError(f"ffmpeg fails ({said[-1]}, exit code {made.returncode}); mend it, or take "
                         "it off PATH for an animation without it, as .gif")
    return os.path.join(folder, "animation.mp4")


def make_film(pictures: Sequence[str], folder: str, kind: str) -> str:
    """GIF of one palette without dithering, so that a colour is the same in every frame, or WebP without loss."""
    try:
        from PIL import Image, features
    except ImportError as failure:
        raise InputError("an animation needs ffmpeg or Pillow (python3-pil)") from failure
    if kind == "webp" and not features.check("webp_anim"):
        raise InputError("--format webp: this Pillow writes no animated WebP; take gif or mp4")
    images = []
    for picture in pictures:
        with Image.open(picture) as image:
            images.append(image.convert("RGB"))
    path = os.path.join(folder, f"animation.{kind}")
    durations = [FRAME_MS] * (len(images) - 1) + [LAST_FRAME_MS]
    if kind == "webp":
        images[0].save(path, save_all=True, append_images=images[1:], loop=0, duration=durations, lossless=True, method=4)
        return path
    palette = images[-1].quantize(256, method=Image.Quantize.MAXCOVERAGE)   # the last has all colours
    images = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    images[0].save(path, save_all=True, append_images=images[1:], loop=0, optimize=False, duration=durations)
    return path
