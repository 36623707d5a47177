"""MP4 files from pictures: H.264 by ffmpeg, there whole or not at all."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from hoap2.errors import UserError


class VideoFile:
    """A video under way."""

    def __init__(self, encoder: subprocess.Popen) -> None:
        self._encoder, self.wanted = encoder, True

    def write(self, picture: np.ndarray) -> None:
        """The next picture, (height, width, 3) uint8."""
        self._encoder.stdin.write(picture.data)

    def discard(self) -> None:
        """Leave no file when the writing ends."""
        self.wanted = False


def _encoder(path: Path, size: tuple[int, int], fps: float, errors) -> subprocess.Popen:
    program = shutil.which("ffmpeg")
    if program is None:
        raise UserError("no video: ffmpeg is not installed", "apt-get install ffmpeg, or run with --no-video",
                        exit_code=3)  # fmt: skip
    command = [
        program, "-hide_banner", "-loglevel", "error", "-nostdin", "-y",
        "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}", "-r", f"{fps:g}", "-i", "-",
        "-an", "-c:v", "libx264", "-preset", "veryfast", "-crf", "23", "-pix_fmt", "yuv420p",
        "-movflags", "+faststart", str(path),
    ]  # fmt: skip
    # A session of its own: Ctrl-C is for us, the encoder ends when its input does.
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=errors,
                            start_new_session=True)  # fmt: skip


@contextmanager
def writing(path: Path, size: tuple[int, int], fps: float) -> Iterator[VideoFile]:
    """A video of this size (width, height; both even) for as long as the block lasts; then it gets its name."""
    part = path.with_name(f".{path.stem}.part-{os.getpid()}.mp4")
    with tempfile.TemporaryFile() as errors:
        encoder = _encoder(part, size, fps, errors)
        try:
            video = VideoFile(encoder)
            yield video
            encoder.stdin.close()
            if encoder.wait() != 0:
                raise BrokenPipeError
            if video.wanted:
                part.replace(path)
        except BrokenPipeError:
            errors.seek(0)
            text = errors.read().decode(errors="replace").strip().splitlines()
            raise UserError(f"no video: ffmpeg failed: {text[-1] if text else 'no message'}", exit_code=3) from None
        finally:
            if encoder.poll() is None:
                encoder.kill()
                encoder.wait()
            part.unlink(missing_ok=True)
