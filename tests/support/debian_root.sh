# Empty Debian systems for suites: folders made by debootstrap. Mirror, proxy, keys and name resolution are those of this
# machine, and the compiler cache is shared with it. Sourced after these variables are set:
#   suite   its name, for messages
#   source  the source tree, which becomes the folder /root/faqem of a system
# Needs root, network and the right to mount; the suite is skipped otherwise.

skip() {
    echo "skipped: the suite $suite needs $1"
    exit 0
}
[ "$(id -u)" -eq 0 ] || skip "root"
command -v apt-get >/dev/null || skip "a Debian system (apt-get)"
"$source/cmake/install-packages.sh" fresh || skip "the package debootstrap"
unshare --mount --pid --fork true 2>/dev/null || skip "the right to mount file systems"
mirror=$(. /etc/os-release && apt-get indextargets --format '$(ORIGIN) $(CODENAME) $(REPO_URI)' 'Created-By: Packages' |
    sed -n "s/^Debian $VERSION_CODENAME //p" | head -n 1)
mirror=${mirror%/}
[ -n "$mirror" ] || skip "a Debian mirror in apt's sources"
for scheme in http https; do
    proxy=""
    eval "$(apt-config shell proxy "Acquire::$scheme::Proxy")"
    [ -z "$proxy" ] || export "${scheme}_proxy=$proxy"
done

# check_release RELEASE: skips the suite if the mirror does not have it.
check_release() {
    wget -q -O /dev/null "$mirror/dists/$1/InRelease" || skip "the mirror $mirror with $1"
}

# Mounts are made in a mount namespace of each command, so that none is left when the command ends or is killed.
work=$(mktemp -d "${TMPDIR:-/tmp}/faqem-$suite.XXXXXX")
remove_work() {
    if grep -qF " $work/" /proc/self/mountinfo; then
        echo "$work is kept, because file systems are mounted below it" >&2
    else
        rm -rf --one-file-system "$work"
    fi
}
trap remove_work EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

cache=${CCACHE_DIR:-$(ccache --get-config cache_dir 2>/dev/null || echo "$work/ccache")}
mkdir -p "$cache"

# in_root ROOT COMMAND...: runs a command in a root, in its folder /root.
in_root() {
    root=$1
    shift
    unshare --mount --pid --fork --kill-child sh -c '
        root=$1 cache=$2
        shift 2
        mkdir -p "$root/ccache"
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        mount --bind "$cache" "$root/ccache"
        exec chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 CCACHE_DIR=/ccache \
            CCACHE_BASEDIR=/root/faqem CCACHE_NOHASHDIR=1 DEBIAN_FRONTEND=noninteractive \
            ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
            PIP_CERT=/root/certificates.crt npm_config_cafile=/root/certificates.crt PIP_DISABLE_PIP_VERSION_CHECK=1 \
            sh -eu -c "cd /root; $*"' sh "$root" "$cache" "$@"
}

# step NAME FUNCTION ARGUMENT...: runs a function, and prints the end of its output if it fails.
failed=""
step() {
    name=$1 start=$(date +%s)
    shift
    set +e  # errors inside a condition would not end the function
    (set -eu; "$@") >"$work/log" 2>&1 </dev/null
    status=$?
    set -e
    if [ $status -eq 0 ]; then
        echo "ok      $name ($(($(date +%s) - start)) s)"
    else
        echo "FAILED  $name ($(($(date +%s) - start)) s); the end of its output:"
        tail -n 30 "$work/log" | sed 's/^/    /'
        failed="$failed
    $name"
    fi
}

install_in() { in_root "$work/$1" "apt-get install -y -qq --no-install-recommends $2"; }

# make_root RELEASE ROOT: an empty system with the compiler cache and the sources.
make_root() {
    debootstrap --variant=minbase "$1" "$work/$2" "$mirror"
    cp /etc/resolv.conf /etc/hosts "$work/$2/etc/"
    apt-config dump | grep -E '^Acquire::(https?|ftp|Check-[A-Za-z-]+)(::[^ ]+)? "[^"]+";$' \
        >"$work/$2/etc/apt/apt.conf.d/00host" || true
    cp -n /etc/apt/trusted.gpg.d/* "$work/$2/etc/apt/trusted.gpg.d/" 2>/dev/null || true
    cp -L /etc/ssl/certs/ca-certificates.crt "$work/$2/root/certificates.crt"
    printf '#!/bin/sh\nexit 101\n' >"$work/$2/usr/sbin/policy-rc.d"
    chmod +x "$work/$2/usr/sbin/policy-rc.d"
    in_root "$work/$2" "apt-get update -qq"
    install_in "$2" ccache
    mkdir "$work/$2/root/faqem"
    cd "$source"
    if git rev-parse --git-dir >/dev/null 2>&1; then
        git ls-files -z -co --exclude-standard
    else
        find . -path ./build -prune -o -type f -print0
    fi | tar --null --files-from=- --ignore-failed-read -c | tar -x -C "$work/$2/root/faqem" --no-same-owner
}

# Stops if a step failed.
end() {
    [ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
}
