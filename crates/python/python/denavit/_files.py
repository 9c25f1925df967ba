"""Files that are written together."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ._errors import FileError


def write(folder: Path, files: Mapping[str, str], overwrite: bool) -> None:
    """Writes all files or, if one would be overwritten, none."""
    targets = {folder.joinpath(*path.split("/")): text for path, text in files.items()}
    try:
        for path, text in targets.items():
            there = path.exists() and (path.is_dir() or path.read_text("utf-8", "replace") != text)
            if there and (path.is_dir() or not overwrite):
                raise FileError(
                    f"{path} is there already, with other contents; overwrite=True replaces files"
                )
        for path, text in targets.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text.encode("utf-8"))
    except OSError as why:
        if isinstance(why, FileError):
            raise
        raise FileError(f"{why.filename}: {why.strerror}") from None
