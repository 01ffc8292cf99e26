#!/usr/bin/env python3
"""Writes the measured numbers of the book anew: the blocks between `<!-- begin: NAME -->` and `<!-- end -->`.

    docs/numbers.py [--programs DIRECTORY] [BLOCK]...      the blocks given; without any, all that are not "by name"
    docs/numbers.py --list                                 every block, its pages and its time
    docs/numbers.py --check                                fails if a page has a block that is not known, or none for it

Each block is the output of the command that its page names. Blocks "by name" hold processor times, for which the
machine must be idle, or take minutes. The programs are those in DIRECTORY; without it they are built first, to
${CARGO_TARGET_DIR:-target}/release. Standard library only.
"""

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True

from blocks.common import ROOT, blocks

MARKED = re.compile(r"(<!-- begin: ([\w-]+) -->\n).*?(<!-- end -->)", re.DOTALL)


def pages():
    found = [*sorted((ROOT / "docs/src").rglob("*.md")), ROOT / "README.md", ROOT / "examples/peers/README.md"]
    return {page: page.read_text() for page in found}


def check():
    """Blocks by page; ends with a message if pages and blocks do not agree."""
    places, wrong = {}, []
    for page, text in pages().items():
        name = page.relative_to(ROOT)
        if text.count("<!-- begin: ") != len(MARKED.findall(text)) or text.count("<!-- end -->") != text.count(
            "<!-- begin: "
        ):
            wrong.append(f"{name}: a block without end")
        for _, found, _ in MARKED.findall(text):
            places.setdefault(found, []).append(str(name))
    wrong += [f"{', '.join(places[name])}: no block is called {name}" for name in places if name not in blocks]
    wrong += [f"no page has the block {name}" for name in blocks if name not in places]
    if wrong:
        raise SystemExit("\n".join(wrong))
    return places


def write(name):
    function, _, _ = blocks[name]
    begun = os.times()
    content = function()
    for page, text in pages().items():
        changed = MARKED.sub(lambda m: f"{m[1]}\n{content}\n{m[3]}" if m[2] == name else m[0], text)
        if changed != text:
            page.write_text(changed)
    ended = os.times()
    spent = sum(ended[:4]) - sum(begun[:4])
    print(f"{name:<16} {spent:6.1f} s of processor time, {ended[4] - begun[4]:6.1f} s of wall time", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("blocks", nargs="*", metavar="BLOCK", help="see --list")
    parser.add_argument("--programs", type=Path)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.blocks if name not in blocks]
    if unknown:
        parser.error(f"no block is called {', '.join(unknown)}; --list prints them")
    places = check()
    if arguments.list:
        for name, (function, seconds, by_name) in blocks.items():
            print(f"{name:<16} {seconds:4} s{', by name' if by_name else '':<9}  {', '.join(places[name])}")
    if arguments.list or arguments.check:
        return
    if arguments.programs:
        programs = arguments.programs.resolve()
    else:
        subprocess.run(
            ["cargo", "build", "--locked", "--release", "--workspace", "--bins", "--examples"], cwd=ROOT, check=True
        )
        programs = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release"
    os.environ["ASPERITY_PROGRAMS"] = str(programs)
    for name in arguments.blocks or [name for name, (_, _, by_name) in blocks.items() if not by_name]:
        write(name)


if __name__ == "__main__":
    sys.exit(main())
