# A suite that tries the wheel in another program, in a virtual environment of its own. Sourced after these are set:
#   suite   its name, for messages
#   source  the source tree
# Takes the options of the suite. Sets `wheel`, the folder `work`, which goes with the suite, and pip.
# Needs a build of the preset `test`, whose libraries make the wheel, or a wheel.

wheel=""
case "$#=${1:-}" in
    0=) ;;
    2=--wheel) wheel=$(realpath "$2") ;;
    *) echo "usage: tests/run.sh --suite $suite [--wheel FILE]" >&2 && exit 2 ;;
esac
skip() {
    echo "skipped: the suite $suite needs $1"
    exit 0
}
"$source/cmake/install-packages.sh" "$suite" || skip "packages of Debian"
work=$(mktemp -d "${TMPDIR:-/tmp}/faqem-$suite.XXXXXX")
trap 'rm -rf "$work"' EXIT INT TERM
if [ -z "$wheel" ]; then
    build=$source/build/test
    wheel=$(python3 -B "$source/src/python/backend/faqem_backend.py" wheel "$work" \
        --library "$build/src/capi/libfaqem_c.so" --command "$build/bin/faqem")
fi
python3 -m venv "$work/env"
pip() { "$work/env/bin/pip" install --quiet --disable-pip-version-check --no-cache-dir "$@"; }
