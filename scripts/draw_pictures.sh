#!/usr/bin/env bash
# Draws the pictures of the documents (doc/pictures/*.svg) from the Python files beside them; needs nothing but python3.
# --check compares instead of writing, and ends with 1 where a picture and its source differ.
set -euo pipefail
exec /usr/bin/python3 "$(dirname "${BASH_SOURCE[0]}")/../doc/pictures/draw.py" "$@"
