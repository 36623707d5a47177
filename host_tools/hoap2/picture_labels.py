"""Text in pictures: simulated time, legend of the marks."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

# The colours of sim/render/marks.cpp.
COM, COM_DARK, COP, CP = (250, 199, 20), (26, 26, 31), (219, 31, 36), (5, 158, 92)
RIGHT, LEFT, PUSH = (232, 107, 26), (26, 102, 219), (184, 26, 148)
# Of sim/render/passes.cpp: full sinkage, half, untouched, half raised, fully raised; the rise has a fifth of the scale.
SOIL = ((24, 50, 100), (92, 122, 152), (205, 180, 138), (232, 214, 176), (255, 246, 222))
SOIL_RISE_SHARE = 0.2
INK, PANEL = (32, 38, 46, 255), (255, 255, 255, 190)


@lru_cache(maxsize=8)
def _font(size_px: int) -> ImageFont.FreeTypeFont:
    return ImageFont.load_default(size=size_px)


def _symbol(draw: ImageDraw.ImageDraw, kind: str, x: float, y: float, r: float) -> None:
    box = (x - r, y - r, x + r, y + r)
    if kind == "com":
        for start, colour in ((180, COM), (270, COM_DARK), (0, COM), (90, COM_DARK)):
            draw.pieslice(box, start, start + 90, fill=colour)
    elif kind == "cop":
        draw.ellipse(box, fill=COP)
    elif kind == "cp":
        draw.ellipse(box, outline=CP, width=max(1, round(0.35 * r)))
        draw.ellipse((x - 0.35 * r, y - 0.35 * r, x + 0.35 * r, y + 0.35 * r), fill=CP)
    elif kind in ("right", "left"):
        colour = RIGHT if kind == "right" else LEFT
        draw.rounded_rectangle((x - 1.1 * r, y - 0.7 * r, x + 1.1 * r, y + 0.7 * r), 0.4 * r, outline=colour,
                               fill=(*colour, 60), width=max(1, round(0.3 * r)))  # fmt: skip
    elif kind == "push":
        draw.line((x - 1.2 * r, y, x, y), fill=PUSH, width=max(1, round(0.6 * r)))
        draw.polygon([(x, y - 0.8 * r), (x + 1.2 * r, y), (x, y + 0.8 * r)], fill=PUSH)


LEGEND = (("com", "CoM"), ("cop", "CoP"), ("cp", "capture point"), ("right", "right foot"), ("left", "left foot"))


def _panel(image: Image.Image, scale: int) -> tuple[np.ndarray, np.ndarray]:
    """An image drawn `scale` times too large as premultiplied colours and the share of the picture that stays."""
    image = image.resize((image.width // scale, image.height // scale), Image.Resampling.BOX)
    data = np.asarray(image, dtype=np.float32)
    alpha = data[:, :, 3:] / 255.0
    return data[:, :, :3] * alpha, 1.0 - alpha


@lru_cache(maxsize=16)
def _legend(text_px: int, with_push: bool) -> tuple[np.ndarray, np.ndarray]:
    """Marks and their names."""
    scale = 4  # drawn large and shrunk: Pillow does not smooth shapes
    font = _font(text_px * scale)
    entries = LEGEND + ((("push", "push"),) if with_push else ())
    pad, symbol, gap = 0.7 * text_px * scale, 1.7 * text_px * scale, 0.9 * text_px * scale
    width = 2 * pad - gap + sum(symbol + font.getlength(text) + gap for _, text in entries)
    height = 2.0 * text_px * scale
    size = (scale * round(width / scale), scale * round(height / scale))
    image = Image.new("RGBA", size, (0, 0, 0, 0))
    draw = ImageDraw.Draw(image, "RGBA")
    draw.rounded_rectangle((0, 0, size[0] - 1, size[1] - 1), 0.5 * text_px * scale, fill=PANEL)
    x = pad
    for kind, text in entries:
        _symbol(draw, kind, x + 0.45 * symbol, 0.5 * height, 0.5 * text_px * scale)
        draw.text((x + symbol, 0.5 * height), text, fill=INK, font=font, anchor="lm")
        x += symbol + font.getlength(text) + gap
    return _panel(image, scale)


def _paste(rgb: np.ndarray, panel: tuple[np.ndarray, np.ndarray], left: int, top: int) -> None:
    colours, stays = panel
    height, width = min(colours.shape[0], rgb.shape[0] - top), min(colours.shape[1], rgb.shape[1] - left)
    if height <= 0 or width <= 0:
        return
    part = rgb[top : top + height, left : left + width]
    part[...] = (colours[:height, :width] + part * stays[:height, :width] + 0.5).astype(np.uint8)


def _text_panel(text: str, text_px: int) -> tuple[np.ndarray, np.ndarray]:
    font = _font(text_px)
    width, height = round(font.getlength(text) + 1.4 * text_px), round(1.8 * text_px)
    image = Image.new("RGBA", (width, height), (0, 0, 0, 0))
    draw = ImageDraw.Draw(image)
    draw.rounded_rectangle((0, 0, width - 1, height - 1), 0.45 * text_px, fill=PANEL)
    draw.text((0.7 * text_px, 0.5 * height), text, fill=INK, font=font, anchor="lm")
    return _panel(image, 1)


def text_size_px(rgb: np.ndarray) -> int:
    """A size of text that suits the picture."""
    return max(9, round(min(rgb.shape[0] / 36, rgb.shape[1] / 56)))


def caption(rgb: np.ndarray, text: str) -> None:
    """Text in the top left corner, in place."""
    size = text_size_px(rgb)
    _paste(rgb, _text_panel(text, size), round(0.8 * size), round(0.8 * size))


def legend(rgb: np.ndarray, with_push: bool = False) -> None:
    """The meaning of the marks, in the bottom left corner, in place; left out where it does not fit."""
    size = text_size_px(rgb)
    panel = _legend(size, with_push)
    if panel[0].shape[1] + size > rgb.shape[1]:
        return
    _paste(rgb, panel, round(0.8 * size), rgb.shape[0] - panel[0].shape[0] - round(0.8 * size))


@lru_cache(maxsize=16)
def _sinkage_panel(text_px: int, full_scale_m: float) -> tuple[np.ndarray, np.ndarray]:
    """A bar of the soil's colours with millimetres below it."""
    scale = 4
    px = text_px * scale
    ink = {"fill": INK, "font": _font(px)}
    length, full_mm = 11.0 * px, 1e3 * full_scale_m
    size = (scale * round((length + 2.6 * px) / scale), scale * round(3.9 * px / scale))
    image = Image.new("RGBA", size, (0, 0, 0, 0))
    draw = ImageDraw.Draw(image, "RGBA")
    draw.rounded_rectangle((0, 0, size[0] - 1, size[1] - 1), 0.5 * px, fill=PANEL)
    left = 0.5 * (size[0] - length)
    draw.text((left, 0.95 * px), "sunk (mm)", anchor="lm", **ink)
    draw.text((left + length, 0.95 * px), "raised", anchor="rm", **ink)
    place = np.linspace(0.0, len(SOIL) - 1.0, round(length))
    colours = np.stack([np.interp(place, range(len(SOIL)), channel) for channel in zip(*SOIL)], axis=1)
    bar = np.broadcast_to(np.round(colours).astype(np.uint8), (round(0.8 * px), len(place), 3))
    image.paste(Image.fromarray(np.ascontiguousarray(bar)), (round(left), round(1.7 * px)))
    for k, share in enumerate((1.0, 0.5, 0.0, 0.5 * SOIL_RISE_SHARE, SOIL_RISE_SHARE)):
        text = f"{'+' if k > 2 else ''}{share * full_mm:g}"
        draw.text((left + 0.25 * k * length, 3.1 * px), text, anchor="mm", **ink)
    return _panel(image, scale)


def sinkage_scale(rgb: np.ndarray, full_scale_m: float) -> None:
    """The meaning of the soil's colours, in the top right corner, in place; left out where it does not fit."""
    size = text_size_px(rgb)
    panel = _sinkage_panel(size, full_scale_m)
    if panel[0].shape[1] + 22 * size > rgb.shape[1]:  # the caption stands on the left
        return
    _paste(rgb, panel, rgb.shape[1] - panel[0].shape[1] - round(0.8 * size), round(0.8 * size))
