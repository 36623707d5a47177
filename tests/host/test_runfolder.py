"""Run folders are whole or not there, and nothing is ever overwritten."""

from __future__ import annotations

import json
import os

import numpy as np
import pytest

from hoap2 import runfolder
from hoap2.errors import UserError
from hoap2.runfolder import RunFolder


def test_nothing_shows_before_it_is_finished(tmp_path):
    folder = RunFolder(tmp_path / "out" / "walk" / "first")
    folder.json("summary.json", {"ok": True})
    assert not folder.path.exists()
    assert folder.finish() == tmp_path / "out" / "walk" / "first"
    assert os.listdir(folder.path) == ["summary.json"] and os.listdir(folder.path.parent) == ["first"]
    assert (folder.path.stat().st_mode & 0o777) == (tmp_path / "out" / "walk").stat().st_mode & 0o777


@pytest.mark.parametrize("kind", ["folder", "file", "broken link"])
def test_what_is_there_is_left_alone(tmp_path, kind):
    path = tmp_path / "first"
    path.mkdir() if kind == "folder" else path.write_text("mine") if kind == "file" else path.symlink_to("nowhere")
    with pytest.raises(UserError, match="nothing was overwritten.*--out"):
        RunFolder(path)
    assert os.listdir(tmp_path) == ["first"]


def test_a_name_taken_in_the_meantime(tmp_path):
    folder = RunFolder(tmp_path / "first")
    (tmp_path / "first").mkdir()
    assert folder.finish().name == "first-2" and not os.listdir(tmp_path / "first")


def test_an_unwritable_place(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot write to .*file.*--out"):
        RunFolder(tmp_path / "file" / "run")
    with pytest.raises(UserError, match="cannot write to /proc"):
        RunFolder(runfolder.target("walk", "/proc/hoap2/run"))


def test_discard_leaves_no_trace(tmp_path):
    folder = RunFolder(tmp_path / "first")
    folder.text("a", "b")
    folder.discard()
    assert os.listdir(tmp_path) == []


def test_names(tmp_path):
    assert runfolder.target("walk", "a", tmp_path) == tmp_path / "out" / "walk" / "a"
    assert str(runfolder.target("walk", "elsewhere/a", tmp_path)) == "elsewhere/a"
    stamped = runfolder.target("walk", None, tmp_path)
    stamped.mkdir(parents=True)
    other = runfolder.target("walk", None, tmp_path)
    assert other != stamped


def test_json_has_no_numbers_that_json_does_not_know():
    text = json.dumps(runfolder.jsonable({"a": float("nan"), "b": [np.float64(1.5), np.int32(2), float("inf")]}))
    assert text == '{"a": null, "b": [1.5, 2, null]}'
