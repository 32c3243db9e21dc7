"""A picture of a section, in no more pixels than it is drawn with: memory is the panel's, not the file's."""
import math
import struct
import zlib

from plot import InputError, np

from PIL import Image, ImageOps

TURNED = (5, 6, 7, 8)   # orientations of Exif that exchange width and height
Image.MAX_IMAGE_PIXELS = None   # the program has looked at the size (apps/support/files/picture.hpp)


def read_picture(path: str, size: tuple[float, float] = (math.inf, math.inf),
                 part: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)) -> tuple[np.ndarray, tuple[float, ...]]:
    """Part of a picture as RGB, perhaps with opacity, of 8 bits, and the part that it is; a grey picture's greys
    are its own.

    A JPEG is turned as its camera says (Exif), as browsers do.
    size: pixels across and down, at most, that the whole picture would have where it is drawn
    part: left, upper, right and lower edge, shares of the picture; whole pixels around it are taken
    """
    try:
        with open(path, "rb") as file:
            is_jpeg = file.read(3) == b"\xff\xd8\xff"   # whatever the file's name ends with
        with Image.open(path, formats=("JPEG" if is_jpeg else "PNG",)) as picture:
            if is_jpeg and math.isfinite(max(size)):
                across, down = size[::-1] if picture.getexif().get(0x0112) in TURNED else size
                picture.draft("RGB", (math.ceil(across), math.ceil(down)))
            picture.load()
            turned = ImageOps.exif_transpose(picture) if is_jpeg else picture
            box = pixels_of(part, turned.size)
            piece = turned if box == (0, 0, *turned.size) else turned.crop(box)
            return np.asarray(colours(piece, size, turned.size)), tuple(edge / turned.size[k % 2] for k, edge in enumerate(box))
    except (OSError, ValueError, SyntaxError, EOFError, KeyError, IndexError, struct.error,
            zlib.error) as failure:
        raise InputError(f"{path}: cannot be read as PNG or JPEG ({failure})") from failure


def pixels_of(part: tuple[float, float, float, float], size: tuple[int, int]) -> tuple[int, int, int, int]:
    """The pixels that a part of a picture touches, one at least."""
    edges = [min(max(share, 0.0), 1.0) * size[k % 2] for k, share in enumerate(part)]
    first = [min(math.floor(edge), size[k] - 1) for k, edge in enumerate(edges[:2])]
    return *first, *(max(math.ceil(edge), first[k] + 1) for k, edge in enumerate(edges[2:]))


def colours(picture: Image.Image, size: tuple[float, float], whole: tuple[int, int]) -> Image.Image:
    """As read_picture has them. Greys and opacity are made smaller as they are, which takes less memory."""
    has_opacity = picture.mode in ("LA", "RGBA") or "transparency" in picture.info
    if picture.mode.startswith("I"):   # 16 bits, which Pillow would cut off at 255
        picture = Image.fromarray((np.asarray(picture) / np.float32(257.0)).round().astype(np.uint8))
    elif picture.mode not in ("L", "RGB", "RGBA") or has_opacity:
        picture = picture.convert("RGBA" if has_opacity else "RGB")
    smaller = [max(1, min(n, math.ceil(n * most / of))) if math.isfinite(most) else n for n, most, of in zip(picture.size, size, whole)]
    if tuple(smaller) != picture.size:
        picture = picture.resize(smaller, Image.Resampling.BOX)
    return picture if picture.mode in ("RGB", "RGBA") else picture.convert("RGB")
