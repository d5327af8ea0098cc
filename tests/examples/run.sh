#!/bin/sh
# Runs a program and checks that it exits with 0 and prints a line that matches PATTERN.
# Usage: run.sh PATTERN PROGRAM ARGUMENT...
set -eu
pattern=$1
shift
printed=$("$@")
printf '%s\n' "$printed"
printf '%s\n' "$printed" | grep -q -e "$pattern"
