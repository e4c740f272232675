#!/usr/bin/python3
"""site/collect.py FOLDER: puts the pages of the site into a folder, which is laid out as the repository, so that every link
between them holds: the README, what it and docs/ lead to, and a page for each scene that a film was made of."""

import html
import os
import re
import shutil
import sys
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parent.parent
LINK = re.compile(r'(\]\(|(?:src|href|srcset)=")([^)"\s#]+)')
FENCE = re.compile(r"^(```|~~~).*?^\1\s*$", re.MULTILINE | re.DOTALL)
PAGES = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "ARCHITECTURE.md"]


def targets(text):
    """The files and folders that a page leads to, as it names them."""
    for _, target in LINK.findall(FENCE.sub("", text)):
        if "://" not in target and not target.startswith(("#", "mailto:")):
            yield unquote(target)


def copy_with_links(page, folder, done):
    """Copies a page and whatever it leads to. Of a folder of the sources a page that lists it is made."""
    if page in done:
        return
    done.add(page)
    to = folder / page
    to.parent.mkdir(parents=True, exist_ok=True)
    if page.suffix != ".md":
        shutil.copyfile(ROOT / page, to)
        return
    text = (ROOT / page).read_text(encoding="utf-8")
    for target in sorted(set(targets(text)), key=len, reverse=True):
        found = Path(os.path.normpath(page.parent / target))
        if (ROOT / found).is_dir():
            # Scenes are in the gallery; other folders are of the sources, which the site has not.
            gallery = os.path.relpath("gallery.md", page.parent)
            if found.parts[:1] == ("scenes",) and not {"hard", "validation"} & set(found.parts):
                text = text.replace(f"]({target})", f"]({gallery})")
            else:
                text = re.sub(r"\[([^\]]*)\]\(" + re.escape(target) + r"\)", r"\1", text)
        elif found.parts[:1] == ("scenes",) and found.suffix == ".toml":
            text = text.replace(f"]({target})", f"]({os.path.relpath(found.with_suffix('.md'), page.parent)})")
        elif (ROOT / found).is_file():
            copy_with_links(found, folder, done)
    to.write_text(text, encoding="utf-8")


def picture_of(scene):
    """The film's picture: its animation where docs/ has one, else the middle one of its golden frames."""
    film = ROOT / "docs" / "images" / f"{scene.stem}.gif"
    if film.exists():
        return film
    frames = sorted(scene.with_suffix(".golden").glob("frames/*.png"))
    return frames[len(frames) // 2] if frames else None


def described(text):
    """A scene's first comment, as paragraphs."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        if not line.startswith("#:"):  # what an editor reads
            lines.append(line[1:].strip())
    return [" ".join(p.split()) for p in "\n".join(lines).split("\n\n") if p.strip()]


def scene_pages(folder):
    """A page for each scene of a film, with its file, and the gallery that leads to them. Returns the pages' names."""
    gallery = ["# Gallery\n\nEvery scene that drape comes with. A picture leads to the scene's file.\n"]
    pages = []
    for group, title in (("showcase", "What can act on a cloth"), ("homework", "One cloth, five methods")):
        gallery.append(f'\n## {title}\n\n<div class="gallery">\n')
        for scene in sorted((ROOT / "scenes" / group).glob("*.toml")):
            text = scene.read_text(encoding="utf-8")
            about = described(text)
            name = scene.relative_to(ROOT / "scenes").with_suffix("")
            page = Path("scenes") / name.with_suffix(".md")
            picture = picture_of(scene)
            image = Path("gallery") / f"{name.parent}-{name.name}{picture.suffix}" if picture else None
            (folder / page).parent.mkdir(parents=True, exist_ok=True)
            if picture:
                (folder / image).parent.mkdir(exist_ok=True)
                shutil.copyfile(picture, folder / image)
            shutil.copyfile(scene, folder / page.with_suffix(".toml"))
            shown = f"![{name}](../../{image})\n\n" if picture else ""
            (folder / page).write_text(
                f"# {name}\n\n" + "\n\n".join(about) + f"\n\n{shown}```sh\ndrape render scenes/{name}.toml\n```\n\n"
                f"The file, [{name.name}.toml]({name.name}.toml); [its keys](../../docs/reference/scene-format.md#reference):\n\n"
                f"```toml\n{text.rstrip()}\n```\n", encoding="utf-8")
            link = page.with_suffix(".html")
            first = html.escape(re.split(r"(?<=[.]) ", about[0])[0]) if about else ""
            drawn = f'<img src="{image}" alt="{name.name}" loading="lazy">' if picture else ""
            gallery.append(f'<figure><a href="{link}">{drawn}</a><figcaption><a href="{link}"><b>{name.name}</b></a>: '
                           f"{first}</figcaption></figure>\n")
            pages.append(page)
        gallery.append("</div>\n")
    (folder / "gallery.md").write_text("".join(gallery), encoding="utf-8")
    return pages


def title_of(page, folder):
    text = (folder / page).read_text(encoding="utf-8")
    found = re.search(r"^# (.+)$", text, re.MULTILINE)
    return found.group(1).replace('"', "'") if found else page.stem


SECTIONS = {"start": "Start", "cookbook": "Cookbook", "reference": "Reference", "notes": "Notes"}


def navigation(folder, docs, scenes):
    """mkdocs' nav: a section for each folder of docs/, in the order of the links of docs/README.md and of its own README.md."""
    def entries(pages, indent):
        return "".join(f'{indent}- "{title_of(p, folder)}": {p}\n' for p in pages if (folder / p).exists())

    text = '  - "drape": README.md\n  - "All pages": docs/README.md\n  - "Gallery": gallery.md\n'
    for name, title in SECTIONS.items():
        own = Path("docs") / name
        listed = [Path(os.path.normpath(index.parent / target))
                  for index in (Path("docs/README.md"), own / "README.md") if index in docs
                  for target in targets((ROOT / index).read_text(encoding="utf-8"))]
        pages = [p for p in docs if p.parent == own]
        pages.sort(key=lambda p: (listed.index(p) if p in listed else len(listed), p))
        text += f'  - "{title}":\n' + entries(pages, "    ")
    project = [Path(p) for p in PAGES[1:]] + [Path("bench/README.md")]
    return ("nav:\n" + text + '  - "Scenes":\n' + entries(scenes, "    ") + '  - "Project":\n' + entries(project, "    "))


def main():
    folder = Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    docs = sorted(p.relative_to(ROOT) for p in (ROOT / "docs").rglob("*.md"))
    done = set()
    for page in [Path(p) for p in PAGES] + docs:
        copy_with_links(page, folder, done)
    scenes = scene_pages(folder)
    shutil.copyfile(ROOT / "site" / "site.css", folder / "site.css")
    settings = (ROOT / "site" / "mkdocs.yml").read_text(encoding="utf-8")
    (folder.parent / "site-mkdocs.yml").write_text(
        settings.replace("../build/", "") + navigation(folder, docs, scenes), encoding="utf-8")


main()
