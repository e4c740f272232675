import re
import shutil
import textwrap

import drape
from conftest import SOURCE

PAGE = (SOURCE / "docs/reference/python.md").read_text()


def test_the_page_says_what_happens(tmp_path, monkeypatch, capsys):
    """Runs the page's cells one after another, as a notebook: what a cell prints is what stands below it."""
    monkeypatch.chdir(tmp_path)
    cells = re.findall(r"```python\n(.*?)```(?:\n+```text\n(.*?)```)?", PAGE, re.S)
    assert len(cells) >= 5
    names = {}
    for code, said in cells:
        exec(compile(code, "docs/reference/python.md", "exec"), names)
        assert capsys.readouterr().out == said, code


def test_the_first_example_works(tmp_path, monkeypatch):
    shutil.copy(SOURCE / "scenes/homework/4.toml", tmp_path / "scene.toml")
    monkeypatch.chdir(tmp_path)
    module = textwrap.dedent(re.search(r"    import drape\n.*?\n\n(?=\w)", drape.__doc__, re.S).group(0))
    names = {}
    exec(module, names)
    assert names["lowest"] < 0 and names["picture"].ndim == 3
