#!/bin/sh
# Downloads the source of Basis Universal's transcoder, in C++, as the crate basisu_c_sys carries it. Needs cargo 1.85 or
# newer, which compiles nothing.
# Usage: fetch_basisu.sh FOLDER
set -eu
folder=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM

cat >"$work/Cargo.toml" <<'END'
[package]
name = "fetch_basisu"
version = "0.0.0"
edition = "2024"
[lib]
path = "/dev/null"
[dependencies]
basisu_c_sys = { version = "=0.9.1", default-features = false }
END
cd "$work"
# With the packages of one platform; the sources are the same on all.
manifest=$(cargo metadata --quiet --format-version 1 --filter-platform x86_64-unknown-linux-gnu |
    grep -o '"manifest_path":"[^"]*/basisu_c_sys-[^"]*"' | cut -d '"' -f 4)
rm -rf "$folder"
mkdir -p "$folder"
cp -R "${manifest%/*}/vendored/basis_universal/transcoder" "${manifest%/*}/vendored/basis_universal/zstd" "$folder"
