#!/bin/bash
# Writes docs/reference/parameters.md and the measures of docs/reference/measures.md from the program's own declarations. LISTRIC names another
# program than that of build/native.
cd "$(dirname "$0")/.." || exit
[[ $LISTRIC ]] || ./listric scenes >/dev/null || exit # builds it
listric=${LISTRIC:-${LISTRIC_BUILD:-build}/${LISTRIC_PRESET:-native}/listric}
cmake -D program="$listric" -D folder=build/declarations -D sources=apps -P apps/declarations.cmake &&
    python3 -B docs/parameters.py && python3 -B docs/measures.py
