#!/bin/bash
# Writes the schemas of scenes and materials and the dictionary of measures from the program's own declarations,
# and of these docs/parameters.md and the measures of docs/measures.md and docs/validation-measures.md.
cd "$(dirname "$0")/.." || exit
listric=${LISTRIC:-./listric}
scene=$("$listric" schema) && material=$("$listric" schema --material) && plan=$("$listric" schema --flexure) && measures=$("$listric" schema --measures) || exit
echo "$scene" >apps/scene.schema.json
echo "$material" >apps/material.schema.json
echo "$plan" >apps/flexure.schema.json
echo "$measures" >apps/python/listric/dictionary.json
python3 -B docs/parameters.py && python3 -B docs/measures.py
