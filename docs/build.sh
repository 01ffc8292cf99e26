#!/usr/bin/env bash
# Builds the book: target/book/index.html. Formulae are LaTeX in the Markdown and MathML in the pages; one that does
# not parse ends the build.
#
# With the mdbook that is in the PATH, if it is of the version below; else with one that is installed to
# target/mdbook first (150 s of processor time). Nothing but Rust is needed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mkdir -p target
version=0.5.4
mdbook=mdbook
if [ "$($mdbook --version 2>/dev/null)" != "mdbook v$version" ]; then
    mdbook=target/mdbook/bin/mdbook
    if [ "$($mdbook --version 2>/dev/null)" != "mdbook v$version" ]; then
        # Without search and server, which bring half of its dependencies.
        cargo install mdbook --locked --version $version --no-default-features --root target/mdbook
    fi
fi
formulae=(--quiet --locked --release --manifest-path docs/formulae/Cargo.toml --target-dir target/formulae)
cargo build "${formulae[@]}"
cargo test "${formulae[@]}" > target/formulae.log
# A warning is a link or an include that leads nowhere.
$mdbook build docs 2>&1 | tee target/book.log
if grep -qE 'WARN|ERROR' target/book.log; then
    echo "error: the book does not build without warnings" >&2
    exit 1
fi
target/formulae/release/formulae check target/book
