#!/bin/sh
# Builds the wheel on an empty Debian 12, also from the source distribution, which must give the same bytes; checks its
# size and platform tag; installs it on empty Debian 12 and 13, with different numpy, and tries it there: the README and
# the tests of tests/python. The page docs/python.md and the notebook are executed. Also with Python 3.9, if this machine has it.
# Usage: tests/run.sh --suite wheel
# The systems are those of tests/support/debian_root.sh.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
[ $# -eq 0 ] || { echo "usage: tests/run.sh --suite wheel" >&2; exit 2; }
suite=wheel
. "$here/../support/debian_root.sh"
check_release bookworm
check_release trixie

build() {
    cp -a "$work/bookworm" "$work/build"
    in_root "$work/build" "faqem/src/python/build_wheel.sh wheels"
    mkdir "$work/wheels"
    cp "$work"/build/root/wheels/*.whl "$work/wheels/"
}

from_source() {
    install_in build python3-venv
    in_root "$work/build" "python3 -m venv env; python3 faqem/src/python/backend/faqem_backend.py sdist sdist"
    in_root "$work/build" "env/bin/pip wheel --no-index --no-deps --wheel-dir again sdist/faqem-*.tar.gz"
    cmp "$work"/build/root/again/*.whl "$work"/wheels/*.whl
}

tag_and_size() {
    set -- "$work"/wheels/*.whl
    [ "$(stat -c %s "$1")" -le 15000000 ]
    in_root "$work/build" "env/bin/pip install -q auditwheel; env/bin/auditwheel show wheels/*.whl" | tee "$work/shown"
    tr -s '\n ' ' ' <"$work/shown" | grep -F "$(basename "$1") is consistent with the following platform tag: \"manylinux_2_34_x86_64\""
}

peers() {
    in_root "$work/build" "env/bin/pip install -q fast-simplification trimesh pillow scipy pyvista wheels/*.whl"
    in_root "$work/build" "env/bin/python faqem/tests/wheel/peers.py; env/bin/python faqem/tests/wheel/with_trimesh.py"
    in_root "$work/build" "env/bin/python faqem/tests/wheel/with_pyvista.py"
    in_root "$work/build" "env/bin/python faqem/tests/python/run_page.py faqem/docs/python.md"
}

notebook() {
    in_root "$work/build" "env/bin/pip install -q nbformat nbclient ipykernel"
    in_root "$work/build" "env/bin/python faqem/tests/wheel/notebook.py faqem/examples/python.ipynb"
}

random_calls() {
    in_root "$work/build" "timeout 60 env/bin/python -W error faqem/tests/python/fuzz_arrays.py"
}

types() {
    in_root "$work/build" "env/bin/pip install -q mypy"
    in_root "$work/build" "mkdir typed; cp faqem/tests/wheel/typed.py typed; cd typed; ../env/bin/mypy --strict typed.py"
    in_root "$work/build" "env/bin/python faqem/tests/python/run_page.py faqem/docs/python.md --print > typed/page.py"
    in_root "$work/build" "cd typed; ../env/bin/mypy --strict page.py"
    # A wrong keyword: at most 4,500 bytes, which list all options twice, not once for each kind of argument.
    in_root "$work/build" "cd typed; echo 'import faqem; faqem.simplify([[0.0]], [[0]], rato=1)' >wrong.py &&
                           test \$(../env/bin/mypy wrong.py | wc -c) -le 4500"
}

# In a folder with the installed wheel, README.md, tests and try.py.
try='
    export FAQEM_ENVIRONMENT=$PWD/env PATH=$PWD/env/bin:$PATH FAQEM_EXPECTED_VERSION=$(cat version)
    python try.py README.md
    sed -n "/^\`\`\`sh/,/^\`\`\`/{/^\`\`\`/d;p}" README.md >commands.sh
    sh -eux commands.sh
    FAQEM_COMMAND=$(python -c "import faqem, os; print(os.path.dirname(faqem.__file__))")/faqem
    export FAQEM_COMMAND
    cd tests && PYTHONWARNINGS=error python -m unittest discover'

# prepare FOLDER: copies what the trial needs.
prepare() {
    mkdir -p "$1/tests"
    cp "$here/try.py" "$source/src/python/README.md" "$work"/wheels/*.whl "$1/"
    cp "$source"/tests/python/test_*.py "$1/tests/"
    set -- "$1" "$work"/wheels/*.whl
    basename "$2" | cut -d - -f 2 >"$1/version"
}

# installed RELEASE NUMPY: NUMPY is a requirement for pip, or `debian` for Debian's package.
installed() {
    release=$1 numpy=$2 packages="python3 python3-venv" options=""
    [ "$numpy" != debian ] || packages="$packages python3-numpy" options=--system-site-packages numpy=numpy
    rm -rf "$work/user"
    cp -a "$work/$release" "$work/user"
    rm -r "$work/user/root/faqem"
    install_in user "$packages"
    prepare "$work/user/root/trial"
    in_root "$work/user" "cd trial; python3 -m venv $options env; env/bin/pip install '$numpy' faqem-*.whl; $try"
}

old_python() {
    prepare "$work/old"
    cd "$work/old"
    "$python39" -m venv env
    env/bin/pip install faqem-*.whl
    sh -eu -c "$try"
}

echo "wheel: Debian 12 and 13 from $mirror"
step "an empty Debian 12" make_root bookworm bookworm
end
step "the wheel, from the sources alone" build
end
step "the same bytes from the source distribution" from_source
step "platform tag and size" tag_and_size
step "with fast-simplification, trimesh and pyvista" peers
step "the notebook" notebook
step "10,000 calls with random arrays" random_calls
step "types of a program that uses it" types
step "Debian 12, newest numpy" installed bookworm numpy
step "Debian 12, numpy 1" installed bookworm "numpy<2"
step "Debian 12, its own numpy" installed bookworm debian
step "an empty Debian 13" make_root trixie trixie
step "Debian 13, newest numpy" installed trixie numpy
step "Debian 13, its own numpy" installed trixie debian
python39=""
for candidate in python3.9 "$HOME"/.pyenv/versions/3.9.*/bin/python3.9; do
    ! "$candidate" -c "import venv" 2>/dev/null || python39=$candidate
done
if [ -n "$python39" ]; then
    step "Python 3.9" old_python
else
    echo "skipped Python 3.9, which this machine does not have"
fi
ls -l "$work"/wheels | awk 'NF > 5 { print $NF, $5, "bytes" }'
end
