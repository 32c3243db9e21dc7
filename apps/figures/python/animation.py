"""An animation of a run: one picture per frame, all at the last one's scale."""
import os
import shutil
import subprocess
import tempfile
from collections.abc import Sequence

from frame import Frame
from page import extension_text
from plot import InputError, Order
from scales import share_scales
from sections import draw_figure

SHOWN = ("strata", "strain")
ANIMATION_DPI = 80
FRAME_MS, LAST_FRAME_MS = 250, 2000


def save_animation(frames: Sequence[Frame], folder: str, _: Order) -> None:
    """animation-<extension>km.mp4 with ffmpeg, else .gif"""
    with tempfile.TemporaryDirectory(dir=folder, prefix=".listric-") as temporary:
        pictures = draw_pictures(frames, temporary)
        path = make_mp4(temporary) if shutil.which("ffmpeg") else make_gif(pictures, temporary)
        name = f"animation-{extension_text(frames[-1])}km" + os.path.splitext(path)[1]
        os.replace(path, os.path.join(folder, name))


def draw_pictures(frames: Sequence[Frame], folder: str) -> list[str]:
    """Paths of one PNG per frame."""
    share_scales(frames)
    pictures = []
    for frame in frames:
        frame.view = frames[-1].view
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


def make_gif(pictures: Sequence[str], folder: str) -> str:
    try:
        from PIL import Image
    except ImportError as failure:
        raise InputError("an animation needs ffmpeg or Pillow (python3-pil)") from failure
    # One palette, so that a colour means the same in every frame; the last has them all.
    with Image.open(pictures[-1]) as image:
        palette = image.convert("RGB").quantize(256, method=Image.Quantize.MAXCOVERAGE)
    images = []
    for picture in pictures:
        with Image.open(picture) as image:
            images.append(image.convert("RGB").quantize(palette=palette,
                                                        dither=Image.Dither.NONE))
    path = os.path.join(folder, "animation.gif")
    images[0].save(path, save_all=True, append_images=images[1:], loop=0, optimize=False,
                   duration=[FRAME_MS] * (len(images) - 1) + [LAST_FRAME_MS])
    return path
