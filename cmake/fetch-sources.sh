#!/bin/sh
# Unpacks the sources of Debian's source packages, of the release of this system, with Debian's patches: each to the folder
# of its name. Needs apt-get and dpkg-dev, but not root: lists and packages are kept in a temporary folder.
# Usage: fetch-sources.sh FOLDER PACKAGE...
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM

mirror=$(. /etc/os-release && apt-get indextargets --format '$(ORIGIN) $(CODENAME) $(REPO_URI)' 'Created-By: Packages' |
    sed -n "s/^Debian $VERSION_CODENAME //p" | head -n 1)
[ -n "$mirror" ] || { echo "fetch-sources.sh: there is no Debian mirror in apt's sources" >&2; exit 1; }
mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/source"
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $release main" >"$work/sources.list"
cd "$work/source"
apt() {
    apt-get -qq -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts=/dev/null \
        -o Dir::State::lists="$work/lists" -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root "$@"
}
apt update
for package in "$@"; do
    apt source "$package"
    rm -rf "${folder:?}/$package"
    mv "$package"-*/ "$folder/$package"
done
