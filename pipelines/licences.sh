#!/usr/bin/env bash
# Licences of what is linked into the tools: copies into folder $1 those of each crate that standard input names, as
# `cargo tree --prefix none --format '{p} {l}'` does, and a list of them. Fails where a crate has none.
set -euo pipefail
sources=(${CARGO_HOME:-$HOME/.cargo}/registry/src/*)
mkdir -p "$1"
# Crates of this repository have their path behind the version; ` (*)` marks those that were named before.
sed 's/ (\*)$//' | grep -v -e ' (/' -e '^$' | sort -u >"$1/crates.txt"
while read -r name version _; do
    crate=$name-${version#v}
    texts=()
    for folder in "${sources[@]/%//$crate}"; do
        mapfile -t -O "${#texts[@]}" texts < <(find "$folder" -maxdepth 1 -type f \
            \( -iname 'licen[cs]e*' -o -iname 'copying*' -o -iname 'unlicense*' -o -iname 'notice*' \) 2>/dev/null)
    done
    if [ ${#texts[@]} -eq 0 ]; then
        echo "$crate has no file of its licence" >&2
        exit 1
    fi
    mkdir -p "$1/$crate" && cp "${texts[@]}" "$1/$crate"
done <"$1/crates.txt"
