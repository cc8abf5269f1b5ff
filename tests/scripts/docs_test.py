#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The documentation of the project at SOURCE_DIR: with `links` each link within it leads somewhere, with
`commands` the commands of README.md do what they should. Exit code 77: the model is not there."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

LINK = re.compile(r"\]\((?!https?://)([^)#]*)(?:#([^)]*))?\)")


def pages(source_dir):
    listed = subprocess.run(["git", "-C", source_dir, "ls-files", "*.md"], check=True, capture_output=True, text=True)
    return [source_dir / name for name in listed.stdout.split()]


def without_code(text):
    return re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.S)


def anchors(page):
    """Of the headings, as GitHub names them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(page):
    for path, anchor in LINK.findall(without_code(page.read_text())):
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            yield f"{page}: {path} is not there"
        elif anchor and anchor not in anchors(target):
            yield f"{page}: {path or page.name} has no heading #{anchor}"


def check_links(source_dir):
    found = pages(source_dir)
    assert len(found) > 10, found
    broken = [problem for page in found for problem in broken_links(page)]
    if broken:
        sys.exit("\n".join(broken))


def commands_of(readme):
    block = re.search(r"<!-- commands: tiny -->\n```\n(.*?)```", readme.read_text(), flags=re.S)
    commands = [line[2:] for line in block.group(1).splitlines() if line.startswith("$ ")]
    assert len(commands) == 3, commands
    return commands


def check_commands(source_dir, apps_dir):
    data = pathlib.Path(os.environ.get("XDG_DATA_HOME", pathlib.Path.home() / ".local/share"))
    model = data / "mrpt-fild/mobilenet_v2_objectron.onnx"
    if not model.exists():
        print(f"{model} is missing")
        sys.exit(77)
    apps = [str(path) for path in apps_dir.iterdir() if path.is_dir()]
    environment = {**os.environ, "PATH": os.pathsep.join([*apps, os.environ["PATH"]])}
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(source_dir / "config-ini", f"{folder}/config-ini")
        for command in commands_of(source_dir / "README.md"):
            print(f"$ {command}", flush=True)
            run = subprocess.run(command, shell=True, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True)
            print(run.stdout)
            assert run.returncode == 0, run.returncode
        assert re.search(r"^precision +1\.000 ", run.stdout, flags=re.M)
        assert os.path.getsize(f"{folder}/town-results/report.html") > 100_000


if __name__ == "__main__":
    source = pathlib.Path(sys.argv[2]).resolve()
    if sys.argv[1] == "links":
        check_links(source)
    else:
        check_commands(source, pathlib.Path(sys.argv[3]).resolve())
