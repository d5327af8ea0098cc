#!/bin/sh
# Runs a program that must end with 0 and print a line that matches. Usage: run.sh PATTERN PROGRAM ARGUMENT...
set -eu
pattern=$1
shift
printed=$("$@")
printf '%s\n' "$printed"
printf '%s\n' "$printed" | grep -q -e "$pattern"
